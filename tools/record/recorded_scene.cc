#include "tools/record/recorded_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <type_traits>
#include <vector>

#include "common/scene/write_scene.h"
#include "common/text/file.h"
#include "common/text/printable.h"
#include "lcmtypes/scene_message.h"
#include "lcmtypes/shapes_message.h"
#include "lcmtypes/wire.h"
#include "tools/record/record_file.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

struct RecordedFiles {
  std::vector<SceneFile> files;  // empty: not whole
  bool announced = true;         // that the run's messages say it writes them
};

/// They stand before the first state.
RecordedFiles recorded_files(const fs::path& file) {
  LogReader log(file.string());
  SceneFilesReader reader;
  OneRun run;
  RecordedFiles found;
  std::int64_t events = 0;
  for (LogEvent event; log.next(event); ++events) {
    run.see(event, file);
    refuse_other_format(event, file);
    talus_lcm::talus_scene message;
    if (event.channel == name_of(Channel::scene) && decode(event.data, message).empty()) reader.take(message);
    talus_lcm::talus_run identity;
    if (event.channel == name_of(Channel::run) && decode(event.data, identity).empty())
      found.announced = std::ranges::find(identity.channels, name_of(Channel::scene)) != identity.channels.end();
    if (event.channel == name_of(Channel::bodies)) break;
  }
  if (events == 0 && log.damage().bytes > 0) throw no_event_log(file);
  found.files = reader.files();
  return found;
}

/// The other way round than in_space().
template <int Dim>
Vec<Dim> in_own_dimension(const Vec3& vector) {
  if constexpr (Dim == 3)
    return vector;
  else
    return {vector.x(), vector.z()};
}

/// What the messages of a run tell of its scene.
class ToldScene {
 public:
  explicit ToldScene(const fs::path& file) {
    LogReader log(file.string());
    for (LogEvent event; log.next(event);)
      if (const auto channel = channel_named(event.channel))
        with_message_of(*channel, [&](auto message) {
          if (decode(event.data, message).empty()) take(message);
        });
  }

  AnyScene scene() const {
    if (identity_.dimension == 2) return scene_in<2>();
    return scene_in<3>();
  }

 private:
  void take(const talus_lcm::talus_run& message) { identity_ = message; }
  void take(const talus_lcm::talus_shapes& message) {
    (message.obstacle != 0 ? obstacles_ : shapes_).insert_or_assign(message.index, message);
  }
  void take(const talus_lcm::talus_bodies& message) {
    if (!message.body.empty()) bodies_ = std::max(bodies_, std::int64_t{message.body.back()} + 1);
    last_step_ = std::max(last_step_, message.step);
  }
  template <class Message>
  void take(const Message& /*message*/) {}

  Vec2 sides_along(int axis) const { return {identity_.side[axis], identity_.side[axis] + identity_.period[axis]}; }

  template <int Dim>
  Scene<Dim> scene_in() const {
    Scene<Dim> scene;
    scene.title = printable(identity_.title);
    scene.world.dt = identity_.dt;
    scene.world.ground.present = identity_.ground != 0;
    scene.world.ground.height = identity_.ground_height;
    if (identity_.period[0] > 0.0) scene.world.periodic_x = sides_along(0);
    if (identity_.period[1] > 0.0) scene.world.periodic_y = sides_along(1);
    scene.policy.kind = identity_.policy;
    scene.seed = static_cast<std::uint64_t>(identity_.seed);
    scene.world.set_gravity(in_own_dimension<Dim>(Vec3(identity_.gravity)));
    for (const auto& [index, message] : shapes_)
      if (message.dimension == Dim && index == std::ssize(scene.world.shapes))
        scene.world.shapes.push_back(to_shape<Dim>(message));
    for (const auto& [index, message] : obstacles_)
      if (message.dimension == Dim && index == std::ssize(scene.world.obstacles))
        scene.world.obstacles.push_back({to_shape<Dim>(message), pose_of<Dim>(message), true});
    scene.sources = {{.count = static_cast<int>(std::min<std::int64_t>(bodies_, most_bodies))}};
    scene.run.frames = last_step_ / std::max<std::int64_t>(1, scene.steps_per_frame()) + 1;
    return scene;
  }

  talus_lcm::talus_run identity_{};
  std::map<int, talus_lcm::talus_shapes> shapes_;
  std::map<int, talus_lcm::talus_shapes> obstacles_;
  std::int64_t bodies_ = 0;
  std::int64_t last_step_ = 0;
};

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

/// What `read` makes of the text and the name of a record's scene file, beside which its meshes are; nothing of a run
/// without a scene file.
template <class Read>
auto read_recorded(const fs::path& file, const Read& read)
    -> std::optional<std::invoke_result_t<Read, const std::string&, const std::string&>> {
  const auto [files, announced] = recorded_files(file);
  if (!announced) return std::nullopt;
  if (files.size() == 1) return read(files.front().text, (file / scene_file_name).string());
  if (files.empty()) {
    const fs::path beside = file.parent_path() / scene_file_name;
    if (const auto text = file_contents(beside)) return read(*text, beside.string());
    throw std::invalid_argument(
        fmt::format("{}: must be a record that `talus run` wrote: no scene is in it or beside it", file.string()));
  }
  const ScratchFolder folder;
  write_scene_files(files, folder.path());
  return read(files.front().text, (folder.path() / scene_file_name).string());
}

}  // namespace

AnyScene scene_of_run(const fs::path& run) {
  const fs::path file = record_file(run);
  const auto scene =
      read_recorded(file, [](const std::string& text, const std::string& name) { return parse_scene(text, name); });
  return scene ? *scene : ToldScene(file).scene();
}

SceneTexts scene_texts_of_run(const fs::path& run) {
  const auto read = [](const std::string& text, const std::string& name) -> SceneTexts {
    try {
      return {text, with_every_default(text, name)};
    } catch (const SceneErrors&) {
      return {text, ""};
    }
  };
  return read_recorded(record_file(run), read).value_or(SceneTexts());
}

}  // namespace talus
