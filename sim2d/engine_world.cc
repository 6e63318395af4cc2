#include "sim2d/engine_world.h"

#include <algorithm>
#include <cmath>

#include "sim2d/body_template.h"
#include "sim2d/conversions.h"

namespace talus::box2d {
namespace {

constexpr float ground_reach = 2e4F;  // [m] to both sides; bodies are added within 1e4 m
constexpr double milliseconds = 1e-3;

/// Collects the bodies that Box2D finds in a box.
class Finder final : public b2QueryCallback {
 public:
  explicit Finder(std::vector<BodyIndex>& found) : found_(&found) {}
  bool ReportFixture(b2Fixture* fixture) override {
    if (const BodyIndex owner = owner_of(*fixture); owner >= 0) found_->push_back(owner);
    return true;
  }

 private:
  std::vector<BodyIndex>* found_;
};

bool is_finite(const b2Body& body) {
  // One sum instead of six tests: it is finite only if every term is.
  return std::isfinite(body.GetPosition().x + body.GetPosition().y + body.GetAngle() + body.GetLinearVelocity().x +
                       body.GetLinearVelocity().y + body.GetAngularVelocity());
}

// Thawed bodies must be where they were, bit for bit: the engine's floats come back unchanged through our doubles, and
// the angle is kept as an angle, not as sine and cosine.
b2Transform stored_pose(const Pose<2>& pose) {
  return {to_engine(pose.position), b2Rot(static_cast<float>(pose.rotation.angle()))};
}

/// See Image. Box2D lets two fixtures meet that are each in a category of the other's mask.
b2Filter filter_of(int sides) {
  b2Filter filter;
  filter.categoryBits = static_cast<std::uint16_t>(1U << static_cast<unsigned>(sides));
  if (sides == 0) return filter;
  filter.maskBits = 0;
  for (int others = 0; others < 4; ++others)
    if ((sides & others) == 0) filter.maskBits |= static_cast<std::uint16_t>(1U << static_cast<unsigned>(others));
  return filter;
}

/// Of ground and obstacles, which images do not meet.
b2Filter filter_of_fixed() {
  b2Filter filter;
  filter.categoryBits = 1U << 4U;
  return filter;
}

/// Removing one walks the list of its host, so a thaw costs more with more of them. Box2D's own step visits all hosts,
/// so it costs more with fewer: at 128 a step of 100 awake bodies costs the same over 100,000 frozen ones as over
/// 1,000; at 64 it costs 7 % more, at 16 75 %. The steps of SmallSteps visit none.
int sleepers_in_a_host(const WorldDescription<2>& description) {
  if (description.debug.keep_sleepers) return 1;
  return description.solver.small_steps() ? 8 : 128;
}

void give_velocity(b2Body& body, const Vec<2>& velocity, const Spin<2>& spin) {
  body.SetLinearVelocity(to_engine(velocity));
  body.SetAngularVelocity(static_cast<float>(spin[0]));
}

}  // namespace

EngineWorld::EngineWorld(const WorldDescription<2>& description)
    : RingWorld<2>(description, {fastest_speed<2>(description.dt), fastest_spin(description.dt)}),
      world_(to_engine(description.gravity_vector())),
      hosts_(world_, sleepers_in_a_host(description)),
      continuous_(description),
      listener_(warm_start_, continuous_) {
  for (const Shape<2>& shape : description.shapes) templates_.push_back(make_body_template(shape, description.solver));
  if (description.solver.small_steps()) small_steps_.emplace(description, ring_);
  world_.SetAllowSleeping(description.engine_sleep);
  world_.SetAutoClearForces(false);  // there are none
  world_.SetContactListener(&listener_);
  world_.SetContactFilter(&continuous_);
  if (description.ground.present) add_ground();
  for (int k = 0; k < std::ssize(obstacles()); ++k) obstacles_.push_back(make_obstacle(k));
}

void EngineWorld::add_ground() {
  const auto z = static_cast<float>(description().ground.height);
  b2EdgeShape line;
  line.SetTwoSided({-ground_reach, z}, {ground_reach, z});
  b2FixtureDef fixture = fixture_of(description().ground.material, description().solver);
  fixture.shape = &line;
  fixture.filter = filter_of_fixed();
  fixture.userData = to_user_data(make_tag(ground_index, 0));
  const b2BodyDef fixed;
  world_.CreateBody(&fixed)->CreateFixture(&fixture);
}

b2Body* EngineWorld::make_obstacle(int number) {
  const Obstacle<2>& obstacle = obstacles()[number];
  b2BodyDef fixed;
  if (obstacle.moves) fixed.type = b2_kinematicBody;
  fixed.position = to_engine(obstacle.pose.position);
  fixed.angle = engine_angle(obstacle.pose.rotation.angle());
  b2Body* body = world_.CreateBody(&fixed);
  b2FixtureDef fixture = fixture_of(obstacle.shape.material, description().solver);
  fixture.filter = filter_of_fixed();
  attach(*body, fixture, engine_pieces(obstacle.shape, description().solver), first_obstacle - number);
  return body;
}

Pose<2> EngineWorld::engine_add(BodyIndex body, const BodyDef<2>& def) {
  check_memory();
  Pose<2> pose{from_engine(to_engine(def.pose.position)), Rotation<2>(engine_angle(def.pose.rotation.angle()))};
  b2Body* made = create(body, def.shape, pose, def.image ? def.image->sides : 0);
  give_velocity(*made, def.velocity, def.spin);
  bodies_.push_back({made, nullptr});
  proxies_moved_ = true;
  return pose;
}

b2Body* EngineWorld::create(BodyIndex index, int shape, const Pose<2>& pose, int sides) {
  const BodyTemplate& from = template_of(shape);
  b2BodyDef def;
  def.userData.pointer = static_cast<std::uintptr_t>(shape);  // for ContinuousCollision
  def.type = b2_dynamicBody;
  def.position = to_engine(pose.position);
  def.angle = static_cast<float>(pose.rotation.angle());
  b2Body* body = world_.CreateBody(&def);
  b2FixtureDef fixture = from.material;
  fixture.filter = filter_of(sides);
  attach(*body, fixture, from.pieces, index);
  body->SetMassData(&from.mass);
  return body;
}

void EngineWorld::engine_remove(std::span<const BodyIndex> bodies) {
  find_new_contacts();
  for (const BodyIndex body : bodies) {
    if (at(body).frozen != nullptr)
      hosts_.remove(at(body).frozen, template_of_body(body));
    else
      world_.DestroyBody(at(body).body);
    at(body) = {};
    warm_start_.forget(body);
    if (ring_) ring_->forget(body);
  }
}

Pose<2> EngineWorld::engine_place(BodyIndex body, const Pose<2>& pose) {
  b2Body& placed = *at(body).body;
  placed.SetTransform(to_engine(pose.position), engine_angle(pose.rotation.angle()));
  proxies_moved_ = true;
  return {from_engine(placed.GetPosition()), Rotation<2>(placed.GetAngle())};
}

void EngineWorld::engine_set_velocity(BodyIndex body, const Vec<2>& velocity, const Spin<2>& spin) {
  give_velocity(*at(body).body, velocity, spin);
}

EngineTimes EngineWorld::engine_step() {
  warm_start_.start_step(states().asleep, !ring_);
  const bool own = !small_steps_;
  listener_.start_step(own && !description().debug.sweep_slow_bodies && hosts_.hosts() > 0, own && records_contacts());
  if (!description().debug.step_when_idle && idle()) {
    if (ring_) ring_->start();
    return {};
  }
  check_memory();
  const EngineTimes times = own ? box2d_step() : small_step();
  warm_start_.end_step();
  return times;
}

/// Whether nothing moves in the coming step.
bool EngineWorld::idle() const { return awake().empty() && (!ring_ || ring_->idle(moving_obstacles_)); }

EngineTimes EngineWorld::box2d_step() {
  find_new_contacts();
  for (const BodyIndex body : awake()) continuous_.note_body(*at(body).body, states().shape[body]);
  continuous_.start_step();
  world_.Step(static_cast<float>(description().dt), description().solver.velocity_iterations,
              description().solver.position_iterations);
  continuous_.end_step();
  proxies_moved_ = false;
  const b2Profile& profile = world_.GetProfile();
  return {.collide = milliseconds * static_cast<double>(profile.collide + profile.broadphase),
          .solve = milliseconds * static_cast<double>(profile.solve - profile.broadphase + profile.solveTOI)};
}

EngineTimes EngineWorld::small_step() {
  stepped_.clear();
  for (const BodyIndex body : awake()) stepped_.push_back(at(body).body);
  small_steps_->drift(stepped_, step_input());
  proxies_moved_ = true;
  find_new_contacts();
  const EngineTimes times = small_steps_->step(world_, step_input(), stepped_);
  proxies_moved_ = true;
  return times;
}

std::optional<BodyIndex> EngineWorld::engine_read(BodyStates<2>& states) {
  const auto broken = std::ranges::find_if(awake(), [this](BodyIndex body) { return !is_finite(*at(body).body); });
  if (broken != awake().end()) return *broken;
  for (const BodyIndex index : awake()) {
    const b2Body& body = *at(index).body;
    states.pose[index].position = from_engine(body.GetPosition());
    states.pose[index].rotation.angle() = body.GetAngle();
    states.velocity[index] = from_engine(body.GetLinearVelocity());
    states.spin[index][0] = body.GetAngularVelocity();
  }
  return std::nullopt;
}

void EngineWorld::engine_contacts(std::vector<Contact<2>>& contacts) const {
  if (small_steps_)
    small_steps_->gather(states(), contacts);
  else
    listener_.gather(states().asleep, contacts);
}

bool EngineWorld::engine_awake(BodyIndex body) const { return at(body).body != nullptr && at(body).body->IsAwake(); }

void EngineWorld::engine_move_obstacle(int number, const Pose<2>& /*to*/, const Vec<2>& velocity, const Spin<2>& spin) {
  give_velocity(*obstacles_[number], velocity, spin);
  moving_obstacles_.push_back(first_obstacle - number);
  continuous_.note_moving_obstacle();
}

void EngineWorld::engine_place_obstacle(int number, const Pose<2>& at) {
  if (!small_steps_) contacts();  // Box2D measures them from where the obstacle is
  b2Body& body = *obstacles_[number];
  body.SetTransform(to_engine(at.position), engine_angle(at.rotation.angle()));
  give_velocity(body, Vec<2>::Zero(), Spin<2>::Zero());
  moving_obstacles_.clear();
  proxies_moved_ = true;
}

void EngineWorld::engine_remove_obstacle(int number) {
  find_new_contacts();
  world_.DestroyBody(obstacles_[number]);
  std::erase(moving_obstacles_, first_obstacle - number);
  obstacles_[number] = nullptr;
  warm_start_.forget(first_obstacle - number);
  if (ring_) ring_->forget(first_obstacle - number);
}

void EngineWorld::engine_restore_obstacle(int number) {
  obstacles_[number] = make_obstacle(number);
  proxies_moved_ = true;
}

void EngineWorld::engine_freeze(std::span<const BodyIndex> bodies) {
  keep_contacts(bodies);
  // All are destroyed before the first is made again, last first: so every fixture gets its old number in the broad
  // phase again, which decides the side that Box2D measures a contact from.
  find_new_contacts();
  for (std::size_t i = bodies.size(); i-- > 0;) world_.DestroyBody(at(bodies[i]).body);
  for (const BodyIndex body : bodies) {
    const Pose<2>& pose = states().pose[body];
    at(body) = {nullptr, hosts_.add(body, template_of_body(body), stored_pose(pose), filter_of(images()[body].sides))};
  }
  proxies_moved_ = true;
}

/// Before they are destroyed: of the contacts of awake bodies that fall asleep.
void EngineWorld::keep_contacts(std::span<const BodyIndex> bodies) {
  for (const BodyIndex body : bodies)
    for (const b2ContactEdge* edge = at(body).body->GetContactList(); edge != nullptr; edge = edge->next)
      warm_start_.save(*edge->contact);
  if (!ring_) return;
  find_new_contacts();
  stepped_.clear();
  for (const BodyIndex body : bodies) stepped_.push_back(at(body).body);
  small_steps_->freeze(world_, step_input(), bodies, stepped_);
}

/// A body that felt forces in its sleep wakes where these have moved it.
void EngineWorld::resume(BodyIndex body) {
  const SolverBody<2> state = small_steps_->thaw(body, warm_start_);
  BodyStates<2>& all = writable_states();
  all.pose[body].position += state.way.cast<double>();
  all.pose[body].rotation.angle() += static_cast<double>(state.turn[0]);
  all.velocity[body] = state.velocity.cast<double>();
  all.spin[body] = state.spin.cast<double>();
}

void EngineWorld::engine_thaw(std::span<const BodyIndex> bodies) {
  for (const BodyIndex body : bodies) {
    warm_start_.wake(body);
    if (at(body).body != nullptr) at(body).body->SetAwake(true);  // asleep by the engine's own rule
  }
  std::vector<b2Fixture*> fixtures = fixtures_of(bodies);
  for (const auto& [contact, owner] : hosts_.contacts_around(fixtures))
    if (states().asleep[owner] == 0) warm_start_.save(*contact);
  find_new_contacts();
  std::ranges::reverse(fixtures);  // see engine_freeze()
  for (b2Fixture* fixture : fixtures) hosts_.remove(fixture, template_of_body(owner_of(*fixture)));
  for (const BodyIndex body : bodies)
    if (ring_ && ring_->has(body)) resume(body);
  create_thawed(bodies);
  proxies_moved_ = true;
}

/// The first fixture of each frozen body of `bodies`.
std::vector<b2Fixture*> EngineWorld::fixtures_of(std::span<const BodyIndex> bodies) const {
  std::vector<b2Fixture*> fixtures;
  for (const BodyIndex body : bodies)
    if (at(body).frozen != nullptr) fixtures.push_back(at(body).frozen);
  return fixtures;
}

/// Creates a Box2D body for each of `bodies` that has none yet.
void EngineWorld::create_thawed(std::span<const BodyIndex> bodies) {
  for (const BodyIndex body : bodies)
    if (at(body).body == nullptr) {
      at(body) = {create(body, states().shape[body], states().pose[body], images()[body].sides), nullptr};
      give_velocity(*at(body).body, states().velocity[body], states().spin[body]);
    }
}

void EngineWorld::check_memory() const { reserve_.check(bodies_.size(), world_.GetContactCount()); }

void EngineWorld::find_new_contacts() {
  if (proxies_moved_) {
    // Step() would do just this first. Box2D gives access to its contact manager for reading only.
    const_cast<b2ContactManager&>(world_.GetContactManager()).FindNewContacts();  // NOLINT(*-const-cast)
    proxies_moved_ = false;
  }
}

void EngineWorld::engine_query_box(const Box<2>& box, std::vector<BodyIndex>& found) const {
  Finder finder(found);
  const auto bounded = [](const Vec<2>& corner) { return to_engine(corner.cwiseMax(-1e30).cwiseMin(1e30)); };
  world_.QueryAABB(&finder, {bounded(box.min()), bounded(box.max())});
}

}  // namespace talus::box2d
