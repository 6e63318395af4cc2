#include "sim3d/engine_world.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>

#include "sim3d/bodies.h"
#include "sim3d/mass_scale.h"
#include "sim3d/plane.h"
#include "sim3d/states.h"

namespace talus::bullet {
namespace {

// What moves less in a step is never swept [m]: Bullet takes 0 for "nobody is swept".
constexpr btScalar shortest_sweep = 1e-6F;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

template <int Dim>
EngineWorld<Dim>::EngineWorld(const WorldDescription<Dim>& description)
    : description_(description),
      mass_scale_(mass_scale<Dim>(description.shapes)),
      engine_(description.gravity, description.solver, description.skips) {
  for (const Shape<Dim>& shape : description.shapes) {
    shapes_.push_back(make_engine_shape(shape, mass_scale_));
    if (!description.skips.continuous) {
      shapes_.back().sweep_from = shortest_sweep;
    }
  }
  if (description.ground.present) {
    add_ground();
  }
  add_obstacles();
  engine_.world.set_after_collision([this] { freezer_.restore_contacts(); });
}

// Bullet knows the bodies by address: they leave it before they go.
template <int Dim>
EngineWorld<Dim>::~EngineWorld() {
  engine_.world.set_bodies({});
  for (const std::unique_ptr<btCollisionObject>& object : objects_) {
    if (object != nullptr) {
      engine_.broadphase.destroyProxy(object->getBroadphaseHandle(), &engine_.dispatcher);
    }
  }
}

template <int Dim>
void EngineWorld<Dim>::add_ground() {
  const Ground& ground = description_.ground;
  ground_shape_ = std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), static_cast<btScalar>(ground.height));
  statics_.push_back(make_static_object(*ground_shape_, static_cast<btScalar>(std::sqrt(ground.material.friction)),
                                        static_cast<btScalar>(std::sqrt(ground.material.restitution)),
                                        btTransform::getIdentity(), ground_index));
  engine_.world.add_static(*statics_.back());
}

template <int Dim>
void EngineWorld<Dim>::add_obstacles() {
  for (const Obstacle<Dim>& obstacle : description_.obstacles) {
    const BodyIndex index = first_obstacle - static_cast<BodyIndex>(obstacle_shapes_.size());
    const EngineShape& shape = obstacle_shapes_.emplace_back(make_engine_shape(obstacle.shape));
    statics_.push_back(make_static_object(*shape.whole, shape.friction, shape.restitution,
                                          to_bullet(obstacle.pose, shape.frame), index));
    engine_.world.add_static(*statics_.back());
  }
}

template <int Dim>
BodyIndex EngineWorld<Dim>::add(const BodyDef<Dim>& body) {
  check(body, description_);
  const BodyIndex index = states_.size();
  const EngineShape& shape = shapes_[static_cast<std::size_t>(body.shape)];
  auto made = engine_.rigid_bodies.make(shape, to_bullet(body.pose, shape.frame), index, description_.engine_sleep);
  made->setLinearVelocity(to_bullet(body.velocity));
  made->setAngularVelocity(spin_to_bullet<Dim>(body.spin));
  engine_.world.addRigidBody(made.get());
  append_state(states_, body);
  listed_.push_back(index);
  rigid_.push_back(made.get());
  awake_.push_back(index);
  objects_.push_back(std::move(made));
  return index;
}

template <int Dim>
void EngineWorld<Dim>::remove(BodyIndex body) {
  const std::size_t i = known(body);
  freezer_.forget(body);
  engine_.broadphase.destroyProxy(objects_[i]->getBroadphaseHandle(), &engine_.dispatcher);
  states_.removed[i] = 1;
  if (rigid_body(i) != nullptr) {
    std::erase(listed_, body);
    relist();
  }
  objects_[i].reset();
}

template <int Dim>
void EngineWorld<Dim>::step() {
  if (failure_) {
    throw NonFiniteState(*failure_);
  }
  ++step_;
  contacts_.before_step(rigid_);
  if (description_.skips.idle && rigid_.empty()) {
    rest();
    return;
  }
  const auto start = Clock::now();
  engine_.world.stepSimulation(static_cast<btScalar>(description_.dt), 0);
  const double total = seconds_since(start);
  contacts_.after_step();
  strayed_known_ = false;
  const auto read = Clock::now();
  read_states();
  times_.collide = engine_.world.collide_seconds();
  times_.solve = total - times_.collide;
  times_.read = seconds_since(read);
}

// All that a step does with nobody in the lists is upkeep of the broadphase's trees. Their form decides the order of
// pairs, and so how a run goes on once somebody wakes.
template <int Dim>
void EngineWorld<Dim>::rest() {
  engine_.broadphase.calculateOverlappingPairs(&engine_.dispatcher);
  contacts_.after_step();
  times_ = {};
}

template <int Dim>
void EngineWorld<Dim>::read_states() {
  for (const btRigidBody* body : rigid_) {
    if (!is_sound(*body)) {
      failure_.emplace(step_, body->getUserIndex());
      throw NonFiniteState(*failure_);
    }
  }
  if (description_.engine_sleep) {
    awake_.clear();
  }
  for (const btRigidBody* body : rigid_) {
    const BodyIndex index = body->getUserIndex();
    read_state(*body, shape_of(static_cast<std::size_t>(index)), states_);
    if (description_.engine_sleep) {
      if (body->isActive()) {
        states_.asleep[static_cast<std::size_t>(index)] = 0;
        awake_.push_back(index);
      } else {
        put_to_sleep(states_, index);
      }
    }
  }
}

template <int Dim>
void EngineWorld<Dim>::set_velocity(BodyIndex body, const Vec<Dim>& velocity, const Spin<Dim>& spin) {
  const std::size_t i = known(body);
  if (states_.asleep[i] != 0) {
    throw std::invalid_argument("body: " + std::to_string(body) + " sleeps; only an awake body can be pushed");
  }
  check(BodyDef<Dim>{states_.shape[i], {}, velocity, spin}, description_);
  btRigidBody& pushed = *rigid_body(i);
  pushed.setLinearVelocity(to_bullet(velocity));
  pushed.setAngularVelocity(spin_to_bullet<Dim>(spin));
  states_.velocity[i] = velocity;
  states_.spin[i] = spin;
}

template <int Dim>
std::size_t EngineWorld<Dim>::known(BodyIndex body) const {
  if (body < 0 || body >= states_.size() || states_.removed[static_cast<std::size_t>(body)] != 0) {
    throw std::invalid_argument("body: " + std::to_string(body) + " is not in the world");
  }
  return static_cast<std::size_t>(body);
}

template class EngineWorld<2>;
template class EngineWorld<3>;

}  // namespace talus::bullet
