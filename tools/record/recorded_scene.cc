#include "tools/record/recorded_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "common/scene/write_scene.h"
#include "lcmtypes/scene_message.h"
#include "lcmtypes/wire.h"
#include "tools/record/record_file.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// They stand before the first state.
std::vector<SceneFile> recorded_files(const fs::path& file) {
  LogReader log(file.string());
  SceneFilesReader reader;
  OneRun run;
  std::int64_t events = 0;
  for (LogEvent event; log.next(event); ++events) {
    run.see(event, file);
    refuse_other_format(event, file);
    talus_lcm::talus_scene message;
    if (event.channel == name_of(Channel::scene) && decode(event.data, message).empty()) reader.take(message);
    if (event.channel == name_of(Channel::bodies)) break;
  }
  if (events == 0 && log.damage().bytes > 0) throw no_event_log(file);
  return reader.files();
}

/// A new folder that goes with this object.
class ScratchFolder {
 public:
  ScratchFolder() : path_((fs::temp_directory_path() / "talus-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw std::system_error(errno, std::generic_category(), path_);
  }
  ~ScratchFolder() {
    std::error_code left_there;
    fs::remove_all(path_, left_there);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  fs::path path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

AnyScene scene_of_run(const fs::path& run) {
  const fs::path file = record_file(run);
  const std::vector<SceneFile> files = recorded_files(file);
  if (files.size() == 1) return parse_scene(files.front().text, (file / scene_file_name).string());
  if (files.empty()) {
    const fs::path beside = file.parent_path() / scene_file_name;
    if (fs::is_regular_file(beside)) return read_scene(beside);
    throw std::invalid_argument(
        fmt::format("{}: must be a record that `talus run` wrote: no scene is in it or beside it", file.string()));
  }
  const ScratchFolder folder;
  write_scene_files(files, folder.path());
  return read_scene(folder.path() / scene_file_name);
}

}  // namespace talus
