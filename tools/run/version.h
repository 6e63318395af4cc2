#pragma once

#include <string>

namespace talus {

/// Version and commit, as "0.2.0 (1a2b3c4d)"; a "+" behind the commit stands for uncommitted changes.
std::string version_text();

/// Compiler, its flags and build type.
std::string build_text();

}  // namespace talus
