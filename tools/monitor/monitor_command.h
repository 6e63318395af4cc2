#pragma once

namespace CLI {
class App;
}

namespace talus {

/// Adds `monitor` to the program's sub-commands. When it was given, parsing runs it and then throws CLI::RuntimeError
/// with its exit code.
void add_monitor_command(CLI::App& app);

}  // namespace talus
