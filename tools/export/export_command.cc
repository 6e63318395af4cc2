#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/export/exporter.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"
#include "tools/record/recorded_run.h"

namespace talus {
namespace {

struct ExportOptions {
  std::string run;
  std::vector<std::string> out;  // a format of formats() each, by its ending
  /// Simulated time that is exported [s].
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
  /// Every how many frames of output.
  int every = 1;
};

template <int Dim>
struct Format {
  std::function<std::unique_ptr<Exporter<Dim>>(const ExportInput<Dim>&)> make;
  /// Of its files.
  std::string_view ending;
};

template <int Dim>
std::array<Format<Dim>, 3> formats() {
  return {{{make_csv_export<Dim>, ".csv"}, {make_npz_export<Dim>, ".npz"}, {make_vtp_export<Dim>, ".pvd"}}};
}

/// Throws std::invalid_argument where the file has no ending of a format.
template <int Dim>
Format<Dim> format_of(const std::string& file) {
  for (const Format<Dim>& format : formats<Dim>())
    if (file.ends_with(format.ending)) return format;
  throw std::invalid_argument(
      fmt::format("--out = {}: must end in .csv, .npz or .pvd (a series of .vtp files for ParaView)", file));
}

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
  LogReader log(record_file(options.run).string());
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
  const auto exporter = format.make(input);
  walk_chosen<Dim>(input.scene, options, [&](const RecordedFrame<Dim>& frame) { exporter->add(frame); });
  exporter->finish();
  print_result("{}: {} frames, {} bodies, {:.0f} kB\n", printable(input.file.string()), input.frames, input.bodies,
               static_cast<double>(std::filesystem::file_size(input.file)) / 1e3);
}

template <int Dim>
void export_run(const ExportOptions& options, const Scene<Dim>& scene) {
  std::vector<Format<Dim>> chosen;
  for (const std::string& file : options.out) chosen.push_back(format_of<Dim>(file));
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
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    input.file = options.out[i];
    export_as<Dim>(chosen[i], input, options);
  }
}

}  // namespace

void add_export_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("export", "Write a recorded run in the formats of other programs");
  auto options = std::make_shared<ExportOptions>();
  command->add_option("run", options->run, "Run folder, as `talus run` leaves it, or its record")
      ->required()
      ->check(not_empty());
  command
      ->add_option("-o,--out", options->out,
                   "File to write, overwritten if there: .csv, a row for each body and frame; .npz, arrays of NumPy; "
                   ".pvd, a series for ParaView, with a folder beside it; may be repeated")
      ->required()
      ->allow_extra_args(false)
      ->check(in_a_folder());
  command->add_option("--from", options->from, "Simulated time from which on frames are written [s]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  command->add_option("--to", options->to, "Simulated time up to which they are [s]; default: the run's end")
      ->check(number_between(0.0, 1e9));
  command->add_option("--every", options->every, "Take every Nth frame of output")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->footer(
      "Example:\n  talus run drop_in_a_pile_3d --out runs/pile\n  talus export runs/pile --out pile.npz --out "
      "pile.pvd");
  command->callback([options, &exit_code] {
    std::visit([&](const auto& scene) { export_run(*options, scene); }, scene_of_run(options->run));
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
