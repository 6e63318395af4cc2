#include "common/sleeper/sleeping_world.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// Relative change of D that is worth another policy.
constexpr double new_extent = 0.1;
/// The share of the largest bodies that does not count for D.
constexpr double largest_left_out = 0.02;

template <int Dim>
TypicalBody typical_of(const std::vector<const Shape<Dim>*>& shapes) {
  TypicalBody mean{.bounding_volume = 0.0, .extent = 0.0, .mass = 0.0};
  std::vector<double> extents;
  const double share = 1.0 / static_cast<double>(shapes.size());
  for (const Shape<Dim>* shape : shapes) {
    mean.bounding_volume += share * shape->bounding_volume;
    mean.mass += share * shape->mass;
    extents.push_back(shape->extent);
  }
  std::ranges::sort(extents);
  mean.extent = extents[static_cast<std::size_t>((1.0 - largest_left_out) * static_cast<double>(extents.size() - 1))];
  return mean;
}

}  // namespace

template <int Dim>
SleepingWorld<Dim>::SleepingWorld(const Vec<Dim>& gravity, const SleeperOptions& options)
    : options_(options), world_(gravity) {}

template <int Dim>
BodyIndex SleepingWorld<Dim>::add(const Shape<Dim>& shape, const Pose<Dim>& pose, bool stays_awake) {
  if (const auto number = world_.free_number(); number && control_) control_->forget(*number);
  const BodyIndex body = world_.put(shape, pose);
  stays_awake_.resize(world_.states().asleep.size());
  near_sleep_.resize(stays_awake_.size());
  stays_awake_[body] = stays_awake ? 1 : 0;
  if (!stays_awake) ++came_;
  ++count_;
  return body;
}

template <int Dim>
void SleepingWorld<Dim>::remove(BodyIndex body) {
  --count_;
  if (stays_awake_[body] == 0) ++left_;
  if (control_)
    control_->remove({&body, 1});
  else
    world_.remove(body);
}

template <int Dim>
typename SleepingWorld<Dim>::Events SleepingWorld<Dim>::wake(std::span<const BodyIndex> bodies, SleepCause cause) {
  return control_ ? control_->wake(bodies, cause) : Events{};
}

template <int Dim>
typename SleepingWorld<Dim>::Events SleepingWorld<Dim>::wake_all() {
  return control_ ? control_->wake_all(SleepCause::user) : Events{};
}

template <int Dim>
typename SleepingWorld<Dim>::Events SleepingWorld<Dim>::freeze_saved(std::span<const BodyIndex> bodies, bool settled) {
  if (bodies.empty()) return {};
  if (!control_) {
    for (const BodyIndex body : bodies) {
      const double low = height<Dim>(world_.bounds_of(body).min());
      floor_ = std::min(floor_.value_or(low), low);
    }
    make_policy(typical_now());
  }
  for (const BodyIndex body : bodies) control_->note_touch(body);
  return control_->freeze(bodies, settled ? SleepCause::user : SleepCause::rest);
}

template <int Dim>
typename SleepingWorld<Dim>::Events SleepingWorld<Dim>::set_gravity(const Vec<Dim>& gravity) {
  world_.set_gravity(gravity);
  if (!gravity_ || !gravity_->wakes(gravity)) return {};
  gravity_->note_wake(gravity, time_);
  return wake_all();
}

template <int Dim>
typename SleepingWorld<Dim>::Events SleepingWorld<Dim>::set_moving(BodyIndex body, SleepCause cause) {
  Events woken = wake(std::vector{body}, cause);
  if (control_) control_->forget(body);
  return woken;
}

/// Of the bodies that may sleep, one at least.
template <int Dim>
TypicalBody SleepingWorld<Dim>::typical_now() {
  typical_count_ += came_ - left_;
  came_ = left_ = 0;
  std::vector<const Shape<Dim>*> shapes;
  for (BodyIndex body = 0; body < world_.states().size(); ++body)
    if (world_.states().removed[body] == 0 && stays_awake_[body] == 0) shapes.push_back(&world_.shape_of(body));
  TypicalBody typical = typical_of<Dim>(shapes);
  if (options_.extent) typical.extent = *options_.extent;
  return typical;
}

template <int Dim>
void SleepingWorld<Dim>::make_policy(const TypicalBody& typical) {
  typical_ = typical;
  WorldDescription<Dim> description;
  description.ground.present = false;
  description.ground.height = floor_.value_or(0.0);
  auto policy = std::make_unique<AdaptivePolicy<Dim>>(options_.adaptive, description, typical);
  policy_ = policy.get();
  control_ = std::make_unique<SleepControl<Dim>>(world_, std::move(policy), std::vector<PileParams<Dim>>(1), typical);
  gravity_.emplace(world_.gravity(), typical.extent);
  world_.sort_for(typical.extent);
}

template <int Dim>
typename SleepingWorld<Dim>::Events SleepingWorld<Dim>::prepare(std::span<const Contact<Dim>> contacts) {
  if (!floor_) {
    const auto touch = std::ranges::find_if(contacts, [](const Contact<Dim>& c) { return std::min(c.a, c.b) < 0; });
    if (touch == contacts.end()) return {};
    floor_ = height<Dim>(touch->point);
  }
  if (typical_count_ + came_ == left_) return {};  // none may sleep
  if (control_ && came_ < typical_count_ && 2 * left_ < typical_count_) return {};
  const TypicalBody now = typical_now();
  if (control_ && std::abs(now.extent - typical_.extent) < new_extent * typical_.extent) return {};
  Events woken = wake_all();
  make_policy(now);
  return woken;
}

template <int Dim>
void SleepingWorld<Dim>::end_motion(double dt) {
  time_ += dt;
  ++step_;
  world_.give_dt(dt);
  world_.step();
}

template <int Dim>
const Decision<Dim>& SleepingWorld<Dim>::decide(const std::vector<std::uint8_t>& follows) {
  if (!control_) return nothing_;
  control_->count_piles(world_.dt(), false);
  control_->decide({.step = step_,
                    .time = time_,
                    .world = world_,
                    .piles = control_->piles(),
                    .events = {},
                    .phases = {},
                    .policy = policy_,
                    .kept_awake = [&](BodyIndex body) {
                      return stays_awake_[body] != 0 || follows[body] != 0 || gravity_->keeps_awake(time_);
                    }});
  policy_->note_near_sleep(world_, near_sleep_);
  control_->apply(step_);
  return control_->decision();
}

template <int Dim>
Frame<Dim> SleepingWorld<Dim>::frame(std::span<const SleepEvent> events, std::span<const Warning> warnings) const {
  return {.step = step_,
          .time = time_,
          .world = world_,
          .piles = control_ ? control_->piles() : no_piles_,
          .events = events,
          .phases = {},
          .warnings = warnings,
          .bodies_planned = count_,
          .policy = policy_};
}

template <int Dim>
bool SleepingWorld<Dim>::needs_all_contacts() const {
  if (!control_) return !floor_;
  return any_asleep() || control_->piles().has_unplaced() || policy_->rules()->checks().tolerance() > 0.0;
}

template <int Dim>
bool SleepingWorld<Dim>::needs_contacts(BodyIndex body) const {
  return control_ && (near_sleep_[body] != 0 || !control_->piles().has_touched(body));
}

template class SleepingWorld<2>;
template class SleepingWorld<3>;

}  // namespace talus
