#include "sim2d/engine_world.h"

#include <algorithm>
#include <chrono>

#include "common/math/require.h"
#include "sim2d/materials.h"

namespace talus::box2d {
namespace {

constexpr float ground_reach = 2e4F;  // [m] to both sides; bodies are added within 1e4 m
constexpr double milliseconds = 1e-3;

/// Collects whom Box2D finds in a box.
class Finder final : public b2QueryCallback {
 public:
  explicit Finder(std::vector<BodyIndex>& found) : found_(&found) {}
  bool ReportFixture(b2Fixture* fixture) override {
    if (const BodyIndex owner = owner_of(*fixture); owner >= 0) {
      found_->push_back(owner);
    }
    return true;
  }

 private:
  std::vector<BodyIndex>* found_;
};

}  // namespace

EngineWorld::EngineWorld(const WorldDescription<2>& description)
    : description_(description),
      world_(b2Vec2(0.0F, -static_cast<float>(description.gravity))),
      freezer_(world_, description.skips.sleepers),
      listener_(description, warm_start_) {
  for (const Shape<2>& shape : description_.shapes) {
    blueprints_.push_back({engine_shapes(shape), fixture_of(shape.material, description_.solver), engine_mass(shape)});
  }
  world_.SetAllowSleeping(description_.engine_sleep);
  world_.SetAutoClearForces(false);  // there are none
  world_.SetContactListener(&listener_);
  add_fixed_bodies();
}

void EngineWorld::add_fixed_bodies() {
  if (description_.ground.present) {
    const auto z = static_cast<float>(description_.ground.height);
    b2EdgeShape line;
    line.SetTwoSided({-ground_reach, z}, {ground_reach, z});
    b2FixtureDef fixture = fixture_of(description_.ground.material, description_.solver);
    fixture.shape = &line;
    fixture.userData = to_user_data(make_tag(ground_index, 0));
    const b2BodyDef fixed;
    world_.CreateBody(&fixed)->CreateFixture(&fixture);
  }
  BodyIndex index = first_obstacle;
  for (const Obstacle<2>& obstacle : description_.obstacles) {
    b2BodyDef fixed;
    fixed.position = to_engine(obstacle.pose.position);
    fixed.angle = engine_angle(obstacle.pose.rotation.angle());
    b2Body& body = *world_.CreateBody(&fixed);
    b2FixtureDef fixture = fixture_of(obstacle.shape.material, description_.solver);
    int piece = 0;
    for (const EngineShape& shape : engine_shapes(obstacle.shape)) {
      fixture.shape = &base(shape);
      fixture.userData = to_user_data(make_tag(index, piece++));
      body.CreateFixture(&fixture);
    }
    --index;
  }
}

BodyIndex EngineWorld::add(const BodyDef<2>& body) {
  check(body, description_);
  check_memory();
  const BodyIndex index = states_.size();
  const Pose<2> pose{from_engine(to_engine(body.pose.position)), Rotation<2>(engine_angle(body.pose.rotation.angle()))};
  states_.shape.push_back(body.shape);
  states_.pose.push_back(pose);
  states_.velocity.push_back(body.velocity);
  states_.spin.push_back(body.spin);
  states_.asleep.push_back(0);
  states_.removed.push_back(0);
  bodies_.push_back({create(index, body.velocity, body.spin), nullptr});
  proxies_moved_ = true;
  awake_.push_back(index);
  return index;
}

b2Body* EngineWorld::create(BodyIndex index, const Vec<2>& velocity, const Spin<2>& spin) {
  const Pose<2>& pose = states_.pose[static_cast<std::size_t>(index)];
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.position = to_engine(pose.position);
  def.angle = static_cast<float>(pose.rotation.angle());
  def.linearVelocity = to_engine(velocity);
  def.angularVelocity = static_cast<float>(spin[0]);
  b2Body* body = world_.CreateBody(&def);
  const Blueprint& blueprint = blueprint_of(index);
  b2FixtureDef fixture = blueprint.material;
  int piece = 0;
  for (const EngineShape& shape : blueprint.shapes) {
    fixture.shape = &base(shape);
    fixture.userData = to_user_data(make_tag(index, piece++));
    body->CreateFixture(&fixture);
  }
  body->SetMassData(&blueprint.mass);
  return body;
}

void EngineWorld::check_memory() const {
  reserve_.check(bodies_.size(), static_cast<std::size_t>(world_.GetContactCount()));
}

void EngineWorld::check_index(BodyIndex body) const {
  require(body >= 0 && body < states_.size(), "body", body, "must be the number of a body added before, from 0 on");
  require(states_.removed[static_cast<std::size_t>(body)] == 0, "body", body, "must not have been removed");
}

const EngineWorld::Blueprint& EngineWorld::blueprint_of(BodyIndex body) const {
  return blueprints_[static_cast<std::size_t>(states_.shape[static_cast<std::size_t>(body)])];
}

void EngineWorld::remove(BodyIndex body) {
  check_index(body);
  gather_contacts();
  look_for_contacts();
  const auto i = static_cast<std::size_t>(body);
  if (bodies_[i].frozen != nullptr) {
    freezer_.thaw(bodies_[i].frozen, blueprint_of(body).shapes.size());
  } else {
    world_.DestroyBody(bodies_[i].body);
  }
  bodies_[i] = {};
  warm_start_.forget(body);
  states_.removed[i] = 1;
  std::erase(awake_, body);
  note_engine_sleep();
}

void EngineWorld::set_velocity(BodyIndex body, const Vec<2>& velocity, const Spin<2>& spin) {
  check_index(body);
  const auto i = static_cast<std::size_t>(body);
  require(states_.asleep[i] == 0, "body", body, "must be awake to be given a velocity");
  check(BodyDef<2>{states_.shape[i], {}, velocity, spin}, description_);
  bodies_[i].body->SetLinearVelocity(to_engine(velocity));
  bodies_[i].body->SetAngularVelocity(static_cast<float>(spin[0]));
  states_.velocity[i] = velocity;
  states_.spin[i] = spin;
}

void EngineWorld::step() {
  if (failure_) {
    throw *failure_;
  }
  ++steps_;
  warm_start_.start_step(states_.asleep);
  listener_.start_step(description_.skips.continuous && freezer_.hosts() > 0, contacts_wanted_);
  contacts_gathered_ = false;
  times_ = {};
  if (description_.skips.idle && awake_.empty()) {
    return;
  }
  check_memory();
  world_.Step(static_cast<float>(description_.dt), description_.solver.velocity_iterations,
              description_.solver.position_iterations);
  warm_start_.end_step();
  proxies_moved_ = false;
  const auto solved = std::chrono::steady_clock::now();
  if (const auto broken = first_not_finite(bodies_, awake_)) {
    failure_.emplace(steps_, *broken);
    throw *failure_;
  }
  read_states(bodies_, awake_, states_);
  note_engine_sleep();
  const b2Profile& profile = world_.GetProfile();
  times_.collide = milliseconds * static_cast<double>(profile.collide + profile.broadphase);
  times_.solve = milliseconds * static_cast<double>(profile.solve - profile.broadphase + profile.solveTOI);
  times_.read = std::chrono::duration<double>(std::chrono::steady_clock::now() - solved).count();
}

std::span<const Contact<2>> EngineWorld::contacts() {
  contacts_wanted_ = true;
  gather_contacts();
  return contacts_;
}

void EngineWorld::gather_contacts() {
  if (!contacts_wanted_ || contacts_gathered_) {
    return;
  }
  contacts_gathered_ = true;
  contacts_.clear();
  for (const BodyIndex body : awake_) {
    listener_.gather(*bodies_[static_cast<std::size_t>(body)].body, body, contacts_);
  }
}

void EngineWorld::near(const Box<2>& box, std::vector<BodyIndex>& found) const {
  require(!box.min().hasNaN() && !box.max().hasNaN(), "box", "NaN", "must have corners that are numbers");
  const auto known = static_cast<std::ptrdiff_t>(found.size());
  Finder finder(found);
  const auto bounded = [](const Vec<2>& corner) { return to_engine(corner.cwiseMax(-1e30).cwiseMin(1e30)); };
  world_.QueryAABB(&finder, {bounded(box.min()), bounded(box.max())});
  std::sort(found.begin() + known, found.end());
  found.erase(std::unique(found.begin() + known, found.end()), found.end());
}

}  // namespace talus::box2d
