#include "lcmtypes/contacts_message.h"

#include <algorithm>

#include "common/math/in_space.h"
#include "lcmtypes/message.h"

namespace talus {

using talus_lcm::talus_contacts;

namespace {

constexpr std::size_t contact_values = 9;

template <int Dim>
void append(const ContactForce<Dim>& contact, talus_contacts& message) {
  message.a.push_back(contact.a);
  message.b.push_back(contact.b);
  message.kept.push_back(contact.kept ? 1 : 0);
  for (const Vec<Dim>& vector : {contact.point, contact.normal_force, contact.friction_force})
    for (const double part : in_space(vector)) message.values.push_back(static_cast<float>(part));
}

}  // namespace

template <int Dim>
std::vector<talus_contacts> to_contacts(std::span<const ContactForce<Dim>> contacts) {
  constexpr std::span fields = layout<talus_contacts>;
  constexpr std::size_t at_most = room<talus_contacts> / (bytes_per_entry(fields, "contact_count") +
                                                          contact_values * bytes_per_entry(fields, "value_count"));
  std::vector<talus_contacts> messages;
  do {
    talus_contacts& message = messages.emplace_back();
    for (const ContactForce<Dim>& contact : contacts.first(std::min(contacts.size(), at_most)))
      append(contact, message);
    message.contact_count = static_cast<std::int32_t>(message.a.size());
    message.value_count = static_cast<std::int32_t>(message.values.size());
    contacts = contacts.subspan(message.a.size());
  } while (!contacts.empty());
  return numbered(std::move(messages));
}
template std::vector<talus_contacts> to_contacts(std::span<const ContactForce<2>>);
template std::vector<talus_contacts> to_contacts(std::span<const ContactForce<3>>);

void append_contacts(const talus_contacts& message, std::vector<ContactForce<3>>& contacts) {
  for (std::size_t i = 0; i < message.a.size(); ++i) {
    const auto vector = [&](std::size_t number) {
      return Eigen::Map<const Eigen::Vector3f>(&message.values[contact_values * i + 3 * number]).cast<double>();
    };
    contacts.push_back({.a = message.a[i],
                        .b = message.b[i],
                        .point = vector(0),
                        .normal_force = vector(1),
                        .friction_force = vector(2),
                        .kept = message.kept[i] != 0});
  }
}

std::string_view range_fault(const talus_contacts& m) {
  if (!header_holds(m) || !parts_hold(m)) return "header out of range";
  if (m.value_count != static_cast<std::int32_t>(contact_values) * m.contact_count)
    return "values do not match contacts";
  if (std::ranges::any_of(m.a, is_negative)) return "negative body";
  return {};
}

}  // namespace talus
