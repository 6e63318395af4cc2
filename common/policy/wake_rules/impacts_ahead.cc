#include "common/policy/wake_rules/impacts_ahead.h"

#include <optional>

#include "common/shape/rigid_impulse.h"

namespace talus {
namespace {

constexpr Wake before_impact{.cause = SleepCause::momentum, .before_impact = true};

/// Horizontal unit vector from the body towards `other`; none for what lies more than 45 degrees below, since that has
/// supports that take up the impact, and for what lies straight above.
template <int Dim>
std::optional<Vec<Dim>> direction_aside(const RuleInput<Dim>& in, BodyIndex body, BodyIndex other) {
  const Vec<Dim>& from = in.pose_of(body).position;
  const Vec<Dim> to = in.world.pose_near(other, from).position - from;
  const auto across = along_plane<Vec<Dim>>(to, in.world.down());
  const double aside = across.norm();
  if (in.rise(to) <= -aside || aside <= 0.0) return std::nullopt;
  return across / aside;
}

/// Largest speed of a point of the body in a horizontal direction [m/s]: max over r of v . d + r . (d x w).
template <int Dim>
double speed_towards(const RuleInput<Dim>& in, BodyIndex body, const Vec<Dim>& direction) {
  const Spin<Dim>& spin = in.states().spin[body];
  double turn = 0.0;
  if constexpr (Dim == 2)
    turn = spin.norm();
  else
    turn = direction.cross(spin).norm();
  return in.states().velocity[body].dot(direction) + 0.5 * in.shape_of(body).extent * turn;
}

/// That of the direction in which it is largest, or more [m/s].
template <int Dim>
double speed_aside(const RuleInput<Dim>& in, BodyIndex body) {
  const double reach = 0.5 * in.shape_of(body).extent;
  return along_plane<Vec<Dim>>(in.states().velocity[body], in.world.down()).norm() +
         reach * in.states().spin[body].norm();
}

}  // namespace

template <int Dim>
ImpactsAhead<Dim>::ImpactsAhead(const RuleSetup<Dim>& setup)
    : wake_height_(setup.params.wake_height * setup.typical.extent),
      heavy_mass_(setup.params.heavy_impact * setup.typical.mass) {}

template <int Dim>
void ImpactsAhead<Dim>::update(const RuleInput<Dim>& in, RuleOutput<Dim>& out) {
  if (in.world.awake().size() == in.states().shape.size()) return;
  wake_speed_ = speed_to_rise(in.world.gravity_size(), wake_height_);
  add_pushes(in);
  for (const BodyIndex body : in.world.awake()) {
    const double mass = in.shape_of(body).mass;
    const double momentum = mass * in.states().velocity[body].norm();
    if (momentum > wake_speed_ * (mass + heavy_mass_))
      wake_driven(in, body, out);
    else if (pushes_[body] != Vec<Dim>::Zero() && 0.5 * speed_aside(in, body) > wake_speed_)
      wake_path(in, body, out);
  }
  clear_pushes(in);
}

template <int Dim>
void ImpactsAhead<Dim>::add_pushes(const RuleInput<Dim>& in) {
  pushes_.resize(in.states().asleep.size(), Vec<Dim>::Zero());
  for (const Contact<Dim>& contact : in.contacts) {
    if (contact.b < 0 || in.asleep(contact.b)) continue;
    const Vec<Dim> impulse = contact.normal_impulse * contact.normal + contact.friction_impulse;
    pushes_[contact.a] += impulse;
    pushes_[contact.b] -= impulse;
  }
}

template <int Dim>
void ImpactsAhead<Dim>::clear_pushes(const RuleInput<Dim>& in) {
  for (const Contact<Dim>& contact : in.contacts) {
    pushes_[contact.a].setZero();
    if (contact.b >= 0) pushes_[contact.b].setZero();
  }
}

/// The path is two steps long: a decision takes effect in the next step, and bodies reached during that step must be
/// awake when it begins.
template <int Dim>
void ImpactsAhead<Dim>::find_path(const RuleInput<Dim>& in, BodyIndex body) {
  Box<Dim> path = in.world.bounds_of(body);
  path.extend(Box<Dim>(path).translate(2.0 * in.world.dt() * in.states().velocity[body]));
  path_.clear();
  in.world.query_box(path, path_);
}

template <int Dim>
void ImpactsAhead<Dim>::wake_path(const RuleInput<Dim>& in, BodyIndex body, RuleOutput<Dim>& out) {
  find_path(in, body);
  for (const BodyIndex other : path_) {
    if (!in.asleep(other)) continue;
    const std::optional<Vec<Dim>> direction = direction_aside(in, body, other);
    if (!direction || pushes_[body].dot(*direction) <= 0.0) continue;
    // Of two equal bodies the one that is hit gets half of the speed.
    if (0.5 * speed_towards<Dim>(in, body, *direction) > wake_speed_) out.wakes.try_emplace(other, before_impact);
  }
}

/// Wakes ring by ring around the bodies in the path, until the woken bodies are together too heavy to reach the wake
/// speed.
template <int Dim>
void ImpactsAhead<Dim>::wake_driven(const RuleInput<Dim>& in, BodyIndex body, RuleOutput<Dim>& out) {
  double mass = in.shape_of(body).mass;
  const double momentum = mass * in.states().velocity[body].norm();
  reached_.resize(in.states().asleep.size(), 0);
  woken_.clear();
  find_path(in, body);
  while (!path_.empty() && momentum > wake_speed_ * mass) {
    next_ring_.clear();
    for (const BodyIndex other : path_) {
      if (!in.asleep(other) || reached_[other] != 0) continue;
      reached_[other] = 1;
      woken_.push_back(other);
      mass += in.shape_of(other).mass;
      in.world.query_box(in.world.bounds_of(other), next_ring_);
    }
    path_.swap(next_ring_);
  }
  for (const BodyIndex other : woken_) {
    reached_[other] = 0;
    out.wakes.try_emplace(other, before_impact);
  }
}

template class ImpactsAhead<2>;
template class ImpactsAhead<3>;

}  // namespace talus
