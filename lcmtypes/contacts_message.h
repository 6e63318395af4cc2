#pragma once
// talus_contacts: contact points with their forces.

#include <span>
#include <string_view>
#include <vector>

#include "common/world/body.h"
#include "lcmtypes/channels.h"

namespace talus {

/// One message at least. Those of a plane scene lie in y = 0 then.
template <int Dim>
std::vector<talus_lcm::talus_contacts> to_contacts(std::span<const ContactForce<Dim>> contacts);

/// Appends the contacts of a message that decode() took.
void append_contacts(const talus_lcm::talus_contacts& message, std::vector<ContactForce<3>>& contacts);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_contacts& message);

}  // namespace talus
