#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <vector>

#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/export/exporter.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"
#include "tools/record/record_walk.h"
#include "tools/record/recorded_scene.h"

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

struct Format {
  std::unique_ptr<Exporter> (*make)(const ExportInput&);
  /// Of its files.
  std::string_view ending;
};

/// The first whose ending fits is taken.
constexpr std::array<Format, 4> formats = {{{make_contacts_csv_export, ".contacts.csv"},
                                            {make_csv_export, ".csv"},
                                            {make_npz_export, ".npz"},
                                            {make_vtp_export, ".pvd"}}};

/// Throws std::invalid_argument where the file has no ending of a format.
Format format_of(const std::string& file) {
  for (const Format& format : formats)
    if (file.ends_with(format.ending)) return format;
  throw std::invalid_argument(
      fmt::format("--out = {}: must end in .csv, .npz or .pvd (a series of .vtp files for ParaView)", file));
}

/// Chooses among the frames of a record.
class FrameChoice {
 public:
  explicit FrameChoice(const ExportOptions& options) : options_(options) {}
  bool has(double time) const { return time >= options_.from - rounding && time <= options_.to + rounding; }
  bool takes(double time) { return has(time) && number_++ % options_.every == 0; }

 private:
  static constexpr double rounding = 1e-9;  // by which equal times may differ [s]

  const ExportOptions& options_;
  int number_ = 0;
};

struct ChosenWalk {
  WalkDamage damage;
  std::vector<SleepEvent> later_events;  // of the chosen time, after its last exported moment
};

/// Visits the chosen moments, each with the sleep events since the one before.
template <int Dim, class Visit>
ChosenWalk walk_chosen(const Scene<Dim>& scene, const ExportOptions& options, const Visit& visit) {
  LogReader log(record_file(options.run).string());
  FrameChoice choice(options);
  std::vector<SleepEvent> events;
  const auto keep = [&](const std::vector<SleepEvent>& more) {
    std::ranges::copy_if(more, std::back_inserter(events), [&](const SleepEvent& event) {
      return choice.has(static_cast<double>(event.step) * scene.world.dt);
    });
  };
  const auto take = [&](const Moment& moment) {
    keep(moment.events);
    if (!choice.takes(moment.time)) return;
    visit(moment, events);
    events.clear();
  };
  const WalkResult walk = walk_record<Dim>(scene, log, options.run, take);
  keep(walk.later_events);
  return {walk.damage, events};
}

void report_damage(const WalkDamage& damage) {
  if (damage.none()) return;
  print_message(
      "the record is damaged: {} bytes and {} messages left out, {} messages missing; bodies of unknown pose count as "
      "absent",
      damage.bytes, damage.undecodable, damage.missing);
}

template <int Dim>
void export_as(const Format& format, const Scene<Dim>& scene, const ExportInput& input, const ExportOptions& options) {
  const auto exporter = format.make(input);
  const ChosenWalk walk = walk_chosen<Dim>(
      scene, options, [&](const Moment& moment, std::span<const SleepEvent> events) { exporter->add(moment, events); });
  exporter->finish(walk.later_events);
  print_result("{}: {} frames, {} bodies, {:.0f} kB\n", printable(input.file.string()), input.frames, input.bodies,
               static_cast<double>(std::filesystem::file_size(input.file)) / 1e3);
}

template <int Dim>
void export_run(const ExportOptions& options, const Scene<Dim>& scene) {
  std::vector<Format> chosen;
  for (const std::string& file : options.out) {
    chosen.push_back(format_of(file));
    refuse_own_file(options.run, file);
    if (chosen.back().make == make_contacts_csv_export && !scene.run.contacts)
      throw std::invalid_argument(
          fmt::format("--out = {}: {} has no contacts: must be of a run with run.contacts = true", file, options.run));
  }
  ExportInput input = {.dimension = Dim, .shapes = {}, .file = {}};
  for (const Shape<Dim>& shape : scene.world.shapes) input.shapes.push_back({shape.name, polygons_in_space(shape)});
  const ChosenWalk walk =
      walk_chosen<Dim>(scene, options, [&](const Moment& moment, std::span<const SleepEvent> events) {
        ++input.frames;
        input.events += std::ssize(events);
        input.contacts += std::ssize(moment.contacts);
        input.bodies = moment.bodies.size();
      });
  input.events += std::ssize(walk.later_events);
  if (input.frames == 0) {
    throw std::invalid_argument(
        fmt::format("--from = {:g}, --to = {:g}: must have a frame of {} in between ({} damaged bytes)", options.from,
                    options.to, options.run, walk.damage.bytes));
  }
  report_damage(walk.damage);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    input.file = options.out[i];
    export_as<Dim>(chosen[i], scene, input, options);
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
                   "File to write, overwritten if there: .csv, a row for each body and frame; .contacts.csv, one for "
                   "each contact point; .npz, arrays of NumPy; .pvd, a series for ParaView, with a folder beside it; "
                   "may be repeated")
      ->required()
      ->allow_extra_args(false)
      ->check(file_to_write());
  command->add_option("--from", options->from, "Simulated time from which on frames and sleep events are written [s]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  command->add_option("--to", options->to, "Simulated time up to which they are [s]; default: the run's end")
      ->check(number_between(0.0, 1e9));
  command->add_option("--every", options->every, "Take every Nth frame of output")
      ->check(whole_number(1, 1'000'000))
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
