#include "tools/record/log_repair.h"

#include <fmt/format.h>

#include <stdexcept>

#include "common/text/printable.h"
#include "lcmtypes/event_log.h"
#include "tools/output/output.h"

namespace talus {
namespace fs = std::filesystem;

void repair_log(const fs::path& file, const fs::path& out) {
  if (fs::exists(out)) throw std::invalid_argument(fmt::format("--out = {}: must not exist yet", out.string()));
  fs::create_directories(out);
  const fs::path scene = file.parent_path() / "scene.toml";
  if (fs::is_regular_file(scene)) fs::copy_file(scene, out / "scene.toml");
  EventLog log((out / "run.lcm").string());
  LogReader reader(file.string());
  std::int64_t copied = 0;
  for (LogEvent event; reader.next(event); ++copied) log.write(event);
  log.flush();
  print_result("{}: {} whole messages; {} damaged bytes in {} places left out\n", printable(out.string()), copied,
               reader.damage().bytes, reader.damage().places);
}

}  // namespace talus
