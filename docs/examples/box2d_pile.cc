// A game on Box2D with a sleeper: bodies come and go, one is teleported, a platform carries some, the state is saved
// and loaded.
#include <talus/box2d.h>

#include <cstdio>
#include <vector>

namespace {

b2Body& add_box(b2World& world, b2BodyType type, b2Vec2 at, float width, float height) {
  b2BodyDef def;
  def.type = type;
  def.position = at;
  b2Body& body = *world.CreateBody(&def);
  b2PolygonShape shape;
  shape.SetAsBox(0.5F * width, 0.5F * height);
  body.CreateFixture(&shape, 100.0F);
  return body;
}

/// What a saved game has of a body: its place, and whether it slept.
struct Saved {
  std::vector<talus::SavedSleep> sleep;
  std::vector<b2Transform> places;
};

Saved save(const talus::Box2dSleeper& sleeper) {
  Saved saved{sleeper.snapshot(), {}};
  for (const talus::SavedSleep& one : saved.sleep) saved.places.push_back(sleeper.body(one.body).GetTransform());
  return saved;
}

void load(talus::Box2dSleeper& sleeper, const Saved& saved) {
  for (std::size_t i = 0; i < saved.places.size(); ++i)
    sleeper.body(saved.sleep[i].body).SetTransform(saved.places[i].p, saved.places[i].q.GetAngle());
  sleeper.restore(saved.sleep);
}

}  // namespace

int main() {
  b2World world(b2Vec2(0.0F, -10.0F));
  add_box(world, b2_staticBody, {0.0F, -1.0F}, 100.0F, 2.0F);
  b2Body& platform = add_box(world, b2_kinematicBody, {6.0F, 0.5F}, 4.0F, 0.5F);
  talus::Box2dSleeper sleeper(world);
  sleeper.add_all();
  const auto play = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      sleeper.before_step();
      world.Step(1.0F / 60.0F, 8, 3);
      sleeper.after_step(1.0 / 60.0);
    }
  };

  std::vector<b2Body*> boxes;
  for (int i = 0; i < 60; ++i) {  // spawn
    const float x = i % 3 == 0 ? 6.0F : 0.1F * static_cast<float>(i % 5);
    boxes.push_back(&add_box(world, b2_dynamicBody, {x, 12.0F}, 1.0F, 0.6F));
    sleeper.add(*boxes.back());
    play(20);
  }
  play(900);
  std::printf("poured: %d awake\n", sleeper.awake());
  const Saved saved = save(sleeper);

  platform.SetLinearVelocity({0.0F, 0.5F});  // what lies on it wakes and rises
  play(60);
  platform.SetLinearVelocity(b2Vec2_zero);
  boxes[1]->SetTransform({-20.0F, 1.0F}, 0.0F);  // teleport, perhaps from under others
  sleeper.moved(*boxes[1]);
  play(300);

  platform.SetTransform({6.0F, 0.5F}, 0.0F);
  load(sleeper, saved);
  std::printf("loaded: %d awake\n", sleeper.awake());

  sleeper.about_to_remove(*boxes[2]);  // before it goes: what lay on it wakes
  world.DestroyBody(boxes[2]);
  play(600);
  std::printf("after a removal: %d of %d awake\n", sleeper.awake(), sleeper.size());
}
