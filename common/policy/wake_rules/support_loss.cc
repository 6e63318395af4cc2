#include "common/policy/wake_rules/support_loss.h"

#include <algorithm>
#include <utility>

namespace talus {
namespace {

/// Largest vertical part of a contact normal that points from the sleeping to the awake body for the contact to count
/// as a support: up to 17 degrees above the horizontal the sleeping body may lean on the awake one; above, the awake
/// body lies on top. Chosen, not measured.
constexpr double max_normal_height = 0.3;

}  // namespace

template <int Dim>
SupportLoss<Dim>::SupportLoss(const RuleSetup<Dim>& setup)
    : slack_(setup.params.support_slack * setup.typical.extent) {}

template <int Dim>
void SupportLoss<Dim>::update(const RuleInput<Dim>& in, RuleOutput<Dim>& out) {
  resize(in);
  remember_new(in);
  for (const BodyIndex supporter : in.world.awake()) {
    for (const Support& support : supports_[supporter]) {
      if (!in.asleep(support.supported) || in.states().removed[support.supported] != 0) continue;
      const Vec<Dim> now = in.world.pose_near(supporter, support.point) * support.local;
      if ((now - support.point).norm() > slack_)
        out.wakes.try_emplace(support.supported, Wake{.cause = SleepCause::lost_support});
    }
  }
}

template <int Dim>
void SupportLoss<Dim>::resize(const RuleInput<Dim>& in) {
  supports_.resize(in.states().asleep.size());
  supporters_of_.resize(supports_.size());
}

/// What has come to support a body that slept already.
template <int Dim>
void SupportLoss<Dim>::remember_new(const RuleInput<Dim>& in) {
  for (const Contact<Dim>& contact : in.contacts) {
    if (contact.b < 0 || !in.asleep(contact.b)) continue;
    if (in.asleep(contact.a) || in.rise(contact.normal) > max_normal_height) continue;
    add(in, contact.a, contact.b, contact.point);
  }
}

template <int Dim>
void SupportLoss<Dim>::note_falling_asleep(const RuleInput<Dim>& in, std::span<const BodyIndex> bodies) {
  if (bodies.empty()) return;
  resize(in);
  for (const Contact<Dim>& contact : in.contacts) {
    if (contact.b < 0) continue;
    const double lift = in.rise(contact.normal_impulse * contact.normal + contact.friction_impulse);
    const auto [lower, upper] = lift > 0.0 ? std::pair(contact.b, contact.a) : std::pair(contact.a, contact.b);
    if (lift != 0.0 && std::ranges::binary_search(bodies, upper)) add(in, lower, upper, contact.point);
  }
}

/// Of the points of a contact the first one counts.
template <int Dim>
void SupportLoss<Dim>::add(const RuleInput<Dim>& in, BodyIndex supporter, BodyIndex supported, const Vec<Dim>& point) {
  std::vector<BodyIndex>& supporters = supporters_of_[supported];
  if (std::ranges::find(supporters, supporter) != supporters.end()) return;
  supporters.push_back(supporter);
  const Pose<Dim> pose = in.world.pose_near(supporter, point);
  supports_[supporter].push_back({supported, point, pose.rotation.inverse() * (point - pose.position)});
}

template <int Dim>
bool SupportLoss<Dim>::watches(const World<Dim>& world, BodyIndex sleeper) const {
  return sleeper < std::ssize(supporters_of_) && std::ranges::any_of(supporters_of_[sleeper], [&](BodyIndex supporter) {
           return world.states().asleep[supporter] == 0 && world.states().removed[supporter] == 0;
         });
}

template <int Dim>
void SupportLoss<Dim>::note_awake(BodyIndex body) {
  if (body >= std::ssize(supporters_of_)) return;
  for (const BodyIndex supporter : supporters_of_[body])
    std::erase_if(supports_[supporter], [body](const Support& support) { return support.supported == body; });
  supporters_of_[body].clear();
}

template <int Dim>
void SupportLoss<Dim>::forget(BodyIndex body) {
  if (body >= std::ssize(supports_)) return;
  note_awake(body);
  for (const Support& support : supports_[body]) std::erase(supporters_of_[support.supported], body);
  supports_[body].clear();
}

template class SupportLoss<2>;
template class SupportLoss<3>;

}  // namespace talus
