#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/export/exporter.h"
#include "tools/output/output.h"
#include "tools/record/recorded_run.h"

namespace talus {
namespace {

struct ExportOptions {
  std::string run;
  std::array<std::string, 6> files;  // in the order of formats()
  /// Simulated time that is exported [s].
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
  /// Every how many frames of output.
  int every = 1;
};

template <int Dim>
struct Format {
  std::function<std::unique_ptr<Exporter<Dim>>(const ExportInput<Dim>&)> make;
  /// Of its files; checked, since other programs go by it.
  std::string_view ending;
};

template <int Dim>
std::array<Format<Dim>, 6> formats() {
  return {{{make_csv_export<Dim>, ".csv"},
           {make_npz_export<Dim>, ".npz"},
           {make_ply_export<Dim>, ".ply"},
           {make_vtp_export<Dim>, ".pvd"},
           {make_glb_export<Dim>, ".glb"},
           {make_mcap_export<Dim>, ".mcap"}}};
}

constexpr int many_nodes = 2000;

/// Chooses among the frames of a record.
class FrameChoice {
 public:
  explicit FrameChoice(const ExportOptions& options) : options_(options) {}
  bool takes(double time) {
    constexpr double rounding = 1e-9;
    if (time < options_.from - rounding || time > options_.to + rounding) return false;
    return number_++ % options_.every == 0;
  }

 private:
  const ExportOptions& options_;
  int number_ = 0;
};

/// Visits the chosen frames; each has the sleep events since the one before.
template <int Dim, class Visit>
WalkDamage walk_chosen(const Scene<Dim>& scene, const ExportOptions& options, const Visit& visit) {
  LogReader log((std::filesystem::path(options.run) / "run.lcm").string());
  FrameChoice choice(options);
  std::vector<SleepEvent> events;
  const auto take = [&](const RecordedFrame<Dim>& frame) {
    events.insert(events.end(), frame.events.begin(), frame.events.end());
    if (frame.time < options.from) events.clear();
    if (!choice.takes(frame.time)) return;
    RecordedFrame<Dim> chosen = frame;
    chosen.events = events;
    visit(chosen);
    events.clear();
  };
  return walk_record<Dim>(scene, log, take).damage;
}

void report_damage(const WalkDamage& damage) {
  if (damage.none()) return;
  print_message("the record is damaged: {} bytes and {} messages left out; bodies of unknown pose count as absent",
                damage.bytes, damage.undecodable);
}

template <int Dim>
void export_as(const Format<Dim>& format, ExportInput<Dim> input, const ExportOptions& options) {
  if (format.ending == ".glb" && input.bodies > many_nodes) {
    print_message("{}: {} bodies are as many nodes; above {} most programs take minutes to open them (--npz does not)",
                  input.file.string(), input.bodies, many_nodes);
  }
  const auto exporter = format.make(input);
  walk_chosen<Dim>(input.scene, options, [&](const RecordedFrame<Dim>& frame) { exporter->add(frame); });
  exporter->finish();
  print_result("{}: {} frames, {} bodies, {:.0f} kB\n", printable(input.file.string()), input.frames, input.bodies,
               static_cast<double>(std::filesystem::file_size(input.file)) / 1e3);
}

template <int Dim>
void export_run(const ExportOptions& options, const Scene<Dim>& scene) {
  const auto kinds = formats<Dim>();
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (const std::string& file = options.files[i]; !file.empty() && !file.ends_with(kinds[i].ending))
      throw std::invalid_argument(fmt::format("{}: must end in {}", file, kinds[i].ending));
  ExportInput<Dim> input = {.scene = scene, .file = {}};
  const WalkDamage damage = walk_chosen<Dim>(scene, options, [&](const RecordedFrame<Dim>& frame) {
    ++input.frames;
    input.events += static_cast<std::int64_t>(frame.events.size());
    input.bodies = frame.states.size();
  });
  if (input.frames == 0) {
    throw std::invalid_argument(fmt::format("{}: has no frame from --from {:g} to --to {:g} s ({} damaged bytes)",
                                            options.run, options.from, options.to, damage.bytes));
  }
  report_damage(damage);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (options.files[i].empty()) continue;
    input.file = options.files[i];
    export_as<Dim>(kinds[i], input, options);
  }
}

}  // namespace

void add_export_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("export", "Write a recorded run in the formats of other programs");
  auto options = std::make_shared<ExportOptions>();
  command->add_option("run", options->run, "Run folder, as `talus run` leaves it")->required()->check(not_empty());
  constexpr std::array<std::array<const char*, 2>, 6> files = {
      {{"--csv", "A row for each body and frame"},
       {"--npz", "Arrays of NumPy"},
       {"--ply", "The bodies of the last frame as one mesh"},
       {"--vtp", "A series for ParaView: FILE.pvd, with the folder FILE_vtp"},
       {"--glb", "An animated scene for Blender and engines of games"},
       {"--mcap", "A recording for Foxglove, Lichtblick and Rerun"}}};
  CLI::Option_group* group = command->add_option_group("formats", "Files to write, overwritten if there");
  for (std::size_t i = 0; i < files.size(); ++i)
    group->add_option(files[i][0], options->files[i], files[i][1])->check(in_a_folder());
  group->require_option(1, 0);
  command->add_option("--from", options->from, "Simulated time from which on frames are written [s]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  command->add_option("--to", options->to, "Simulated time up to which they are [s]; default: the run's end")
      ->check(number_between(0.0, 1e9));
  command->add_option("--every", options->every, "Take every Nth frame of output")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->footer("Example:\n  talus run drop_in_a_pile_3d --out runs/pile\n  talus export runs/pile --npz pile.npz");
  command->callback([options, &exit_code] {
    std::visit([&](const auto& scene) { export_run(*options, scene); }, scene_of_run(options->run));
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
