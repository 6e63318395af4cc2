#include "common/policy/adaptive/support_loss.h"

#include <algorithm>
#include <tuple>

namespace talus {
namespace {

/// Largest vertical part of a contact normal that points from the sleeping to the awake body for the contact to count
/// as a support: up to 17 degrees above the horizontal the sleeping body may lean on the awake one; above, the awake
/// body lies on top. Chosen, not measured.
constexpr double max_normal_height = 0.3;

template <typename SupportContact>
bool supports_before(const SupportContact& l, const SupportContact& r) {
  return std::tie(l.supporter, l.supported) < std::tie(r.supporter, r.supported);
}

}  // namespace

template <int Dim>
SupportLoss<Dim>::SupportLoss(const RuleSetup<Dim>& setup)
    : slack_(setup.params.support_slack * setup.typical.extent) {}

template <int Dim>
void SupportLoss<Dim>::update(const RuleInput<Dim>& in, RuleOutput<Dim>& out) {
  forget_ended(in);
  remember_new(in);
  for (const SupportContact& contact : contacts_) {
    const Vec<Dim> now = in.world.pose_near(contact.supporter, contact.point) * contact.local;
    if ((now - contact.point).norm() > slack_) out.wakes.add(contact.supported, {.cause = SleepCause::lost_support});
  }
}

template <int Dim>
void SupportLoss<Dim>::forget(BodyIndex body) {
  std::erase_if(contacts_, [body](const SupportContact& contact) {
    return contact.supporter == body || contact.supported == body;
  });
}

/// A support ends when its supporter falls asleep, when the supported body wakes, or when either leaves the world.
template <int Dim>
void SupportLoss<Dim>::forget_ended(const RuleInput<Dim>& in) {
  const std::vector<std::uint8_t>& removed = in.states().removed;
  std::erase_if(contacts_, [&](const SupportContact& contact) {
    return in.asleep(contact.supporter) || !in.asleep(contact.supported) || removed[contact.supporter] != 0 ||
           removed[contact.supported] != 0;
  });
}

template <int Dim>
void SupportLoss<Dim>::remember_new(const RuleInput<Dim>& in) {
  new_contacts_.clear();
  for (const Contact<Dim>& contact : in.contacts) {
    if (contact.b < 0 || !in.asleep(contact.b)) continue;
    if (in.asleep(contact.a) || in.rise(contact.normal) > max_normal_height) continue;
    const SupportContact support{.supporter = contact.a, .supported = contact.b};
    if (!new_contacts_.empty() && !supports_before(new_contacts_.back(), support)) continue;  // same pair, next point
    if (std::binary_search(contacts_.begin(), contacts_.end(), support, supports_before<SupportContact>)) continue;
    const Pose<Dim> pose = in.world.pose_near(contact.a, contact.point);
    const Vec<Dim> local = pose.rotation.inverse() * (contact.point - pose.position);
    new_contacts_.push_back({contact.a, contact.b, contact.point, local});
  }
  const auto old = static_cast<std::ptrdiff_t>(contacts_.size());
  contacts_.insert(contacts_.end(), new_contacts_.begin(), new_contacts_.end());
  std::inplace_merge(contacts_.begin(), contacts_.begin() + old, contacts_.end(), supports_before<SupportContact>);
}

template class SupportLoss<2>;
template class SupportLoss<3>;

}  // namespace talus
