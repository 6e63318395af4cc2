#pragma once

namespace CLI {
class App;
}

namespace talus {

/// Adds `talus record`, which writes what goes over a bus into LCM event logs. A failure is thrown as an exception.
void add_record_command(CLI::App& app);

}  // namespace talus
