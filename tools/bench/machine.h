#pragma once

#include <string>
#include <utility>
#include <vector>

namespace talus {

/// On what a benchmark ran: date (UTC), talus and its commit, compiler and flags, processor, cores, memory, system.
std::vector<std::pair<std::string, std::string>> machine_facts();

}  // namespace talus
