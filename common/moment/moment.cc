#include "common/moment/moment.h"

#include <algorithm>

#include "common/math/in_space.h"

namespace talus {

void PoseList::resize(std::size_t poses) {
  const std::size_t before = size();
  values_.resize(poses * width_, 0.0F);
  if (dimension_ == 3)
    for (std::size_t i = before; i < poses; ++i) values_[i * width_ + 3] = 1.0F;
}

void PoseList::set(std::size_t i, std::span<const float> values) {
  std::copy_n(values.begin(), width_, values_.begin() + static_cast<std::ptrdiff_t>(i * width_));
}

template <int Dim>
void PoseList::set(std::size_t i, const Pose<Dim>& pose) {
  std::vector<float> values;
  append_pose<Dim>(pose, values);
  if constexpr (Dim == 2) values.back() = static_cast<float>(pose.rotation.angle());
  set(i, values);
}

Pose<3> PoseList::in_space(std::size_t i) const { return dimension_ == 2 ? talus::in_space(pose<2>(i)) : pose<3>(i); }

template <int Dim>
BodyStates<Dim> states_of(const Moment& moment) {
  const MomentBodies& bodies = moment.bodies;
  BodyStates<Dim> states;
  states.shape = bodies.shape;
  states.asleep = bodies.asleep;
  states.removed = bodies.removed;
  states.velocity.assign(bodies.shape.size(), Vec<Dim>::Zero());
  states.spin.assign(bodies.shape.size(), Spin<Dim>::Zero());
  states.pose.reserve(bodies.shape.size());
  for (std::size_t i = 0; i < bodies.shape.size(); ++i) states.pose.push_back(bodies.pose.pose<Dim>(i));
  return states;
}

template <int Dim>
std::vector<ContactForce<Dim>> contacts_of(const Moment& moment) {
  const auto in_plane = [](const Vec3& vector) -> Vec<Dim> {
    if constexpr (Dim == 3)
      return vector;
    else
      return {vector.x(), vector.z()};
  };
  std::vector<ContactForce<Dim>> contacts;
  for (const ContactForce<3>& each : moment.contacts)
    contacts.push_back(
        {each.a, each.b, in_plane(each.point), in_plane(each.normal_force), in_plane(each.friction_force), each.kept});
  return contacts;
}

template void PoseList::set<2>(std::size_t, const Pose<2>&);
template void PoseList::set<3>(std::size_t, const Pose<3>&);
template BodyStates<2> states_of<2>(const Moment&);
template BodyStates<3> states_of<3>(const Moment&);
template std::vector<ContactForce<2>> contacts_of<2>(const Moment&);
template std::vector<ContactForce<3>> contacts_of<3>(const Moment&);

}  // namespace talus
