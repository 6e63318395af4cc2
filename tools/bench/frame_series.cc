#include "tools/bench/frame_series.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

#include "common/measure/compare.h"
#include "common/measure/ensemble.h"
#include "tools/bench/recording.h"
#include "tools/bench/timed_run.h"
#include "tools/output/output.h"
#include "tools/run/version.h"

namespace talus {
namespace {

double number(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

bool read(const std::filesystem::path& file, FrameSeries& series) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line != "frame,seconds,relative,absolute,R," + version_text()) return false;
  while (std::getline(in, line)) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (cells.size() != 5) return false;
    series.seconds.push_back(number(cells[1]));
    series.relative.push_back(number(cells[2]));
    series.absolute.push_back(number(cells[3]));
    series.ratio.push_back(number(cells[4]));
  }
  return true;
}

void write(const std::filesystem::path& file, const FrameSeries& series) {
  std::ofstream out(file);
  out << "frame,seconds,relative,absolute,R," << version_text() << '\n';
  for (std::size_t i = 0; i < series.relative.size(); ++i) {
    out << fmt::format("{},{},{},{},{}\n", i, series.seconds[i], series.relative[i], series.absolute[i],
                       series.ratio[i]);
  }
}

template <int Dim>
FrameSeries measured(const Scene<Dim>& scene, const Scene<Dim>& full, const BenchCase& bench_case, bool itself,
                     int rounds) {
  FrameSeries series;
  const Recording<Dim> baseline = record(full, bench_case.backend);
  const Recording<Dim> run = record(itself ? perturbed(scene) : scene, bench_case.backend);
  const auto errors =
      motion_errors<Dim>(baseline.frames, run.frames, extents_of<Dim>(scene.world.shapes), scene.world.gravity);
  for (const MotionError& error : errors) {
    series.relative.push_back(error.relative);
    series.absolute.push_back(error.absolute);
    series.ratio.push_back(error.ratio);
  }
  std::vector<std::vector<double>> by_round;
  for (int round = 0; round < rounds; ++round) by_round.push_back(timed_run(scene, bench_case.backend).frame_seconds);
  for (std::size_t frame = 0; frame < errors.size(); ++frame) {
    std::vector<double> all;
    for (const std::vector<double>& round : by_round) all.push_back(round[frame]);
    series.seconds.push_back(quantile(all, 0.5));
  }
  return series;
}

}  // namespace

FrameSeries frame_series(const std::filesystem::path& folder, const BenchCase& bench_case, const BenchCase& full,
                         int rounds) {
  const RowKey key = key_of(bench_case);
  const auto file = folder / fmt::format("frames-{}-{}-{}.csv", key.scene, key.backend, key.policy);
  FrameSeries series;
  const AnyScene scene = load(bench_case);
  if (!read(file, series)) {
    print_message("frame by frame: {} {} {}", key.scene, key.backend, key.policy);
    series = std::visit(
        [&]<int Dim>(const Scene<Dim>& one) {
          return measured(one, std::get<Scene<Dim>>(load(full)), bench_case, key == key_of(full), rounds);
        },
        scene);
    write(file, series);
  }
  series.frame_time = std::visit([](const auto& one) { return 1.0 / one.run.frame_rate; }, scene);
  return series;
}

}  // namespace talus
