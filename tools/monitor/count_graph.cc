#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "tools/monitor/panels.h"

namespace talus {
namespace {

/// The sample in force at each column of a graph, by time.
std::vector<CountSample> columns_of(std::span<const CountSample> samples, int columns) {
  std::vector<CountSample> picked;
  if (samples.empty()) return picked;
  const double begin = samples.front().time;
  const double length = samples.back().time - begin;
  std::size_t at = 0;
  for (int column = 0; column < columns; ++column) {
    const double time = begin + length * (column + 1) / columns;
    while (at + 1 < samples.size() && samples[at + 1].time <= time) ++at;
    picked.push_back(samples[at]);
  }
  return picked;
}

/// A column of blocks, `eighths` high.
void put_column(const Area& area, int column, int eighths, Style style) {
  constexpr std::array blocks = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  for (int row = area.rows() - 1; row >= 0 && eighths > 0; --row, eighths -= 8)
    area.put(row, column, blocks[static_cast<std::size_t>(std::min(eighths, 8)) - 1], style);
}

void draw_graph(std::span<const CountSample> samples, std::int64_t CountSample::*what, const char* name, Style style,
                const Area& area) {
  std::int64_t most = 1;
  for (const CountSample& sample : samples) most = std::max({most, sample.*what});
  const int end = area.put(
      0, 0, fmt::format("{} {}", name, samples.empty() ? "?" : fmt::format("{}", samples.back().*what)), style);
  if (samples.empty()) return;
  area.put(0, end, fmt::format(", at most {}, {:.0f} to {:.0f} s", most, samples.front().time, samples.back().time),
           Style::quiet);
  const Area plot = area.lower(1);
  int column = 0;
  for (const CountSample& sample : columns_of(samples, plot.columns())) {
    const double share = static_cast<double>(sample.*what) / static_cast<double>(most);
    const int eighths = sample.*what == 0 ? 0 : std::max(static_cast<int>(std::lround(8.0 * plot.rows() * share)), 1);
    put_column(plot, column++, eighths, style);
  }
}

}  // namespace

void draw_counts(const RunView& view, const Area& area) {
  const int half = area.columns() / 2;
  const auto samples = view.counts().samples();
  draw_graph(samples, &CountSample::awake, "awake", Style::awake, area.part(0, 0, area.rows(), half - 1));
  draw_graph(samples, &CountSample::asleep, "asleep", Style::asleep, area.part(0, half, area.rows(), half));
}

}  // namespace talus
