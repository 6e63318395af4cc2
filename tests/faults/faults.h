#pragma once
// A run that a test can disturb: short, of this build's first engine, without telemetry.

#include <string>

#include "tests/process/process.h"

namespace talus {

/// `run` and its arguments, for about `frames` frames of the first example.
inline std::string short_run(int frames = 40) {
  return "run drop_in_a_pile_2d --no-telemetry --set run.frames=" + std::to_string(frames) + " ";
}

/// Shell: sets $in_namespace to a command that executes another in a mount namespace of its own, where it may mount;
/// to `false` where the system forbids that.
inline const std::string mount_namespace = R"(
in_namespace=false
for command in "unshare --mount" "unshare --user --map-root-user --mount"; do
  $command true 2>/dev/null && in_namespace=$command && break
done
)";

/// The shell script in an empty folder.
inline Outcome shell_in(const TemporaryFolder& folder, const std::string& script) {
  return shell("cd " + folder.path().string() + "\n" + script);
}

}  // namespace talus
