#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "common/pile/pile.h"
#include "tools/monitor/panels.h"

namespace talus {

namespace {

/// Neighbouring layers in one row.
struct LayerRow {
  std::size_t first = 0;
  std::size_t last = 0;
  double capacity = 0.0;
  double count = 0.0;
  std::int64_t sleeping = 0;
  LayerThresholds thresholds = {};  // the lowest of each kind
};

double lower(double known, double more) { return known < 0.0 || (more >= 0.0 && more < known) ? more : known; }

/// Bottom first, at most `rows`.
std::vector<LayerRow> rows_of(std::span<const Layer> layers, std::size_t rows) {
  const std::size_t number = std::min(layers.size(), rows);
  std::vector<LayerRow> result;
  for (std::size_t i = 0; i < number; ++i) {
    LayerRow row{.first = i * layers.size() / number, .last = (i + 1) * layers.size() / number - 1};
    for (std::size_t layer = row.first; layer <= row.last; ++layer) {
      row.capacity += layers[layer].capacity;
      row.count += layers[layer].count;
      row.sleeping += layers[layer].sleeping;
      row.thresholds.sleep = lower(row.thresholds.sleep, layers[layer].thresholds.sleep);
      row.thresholds.wake = lower(row.thresholds.wake, layers[layer].thresholds.wake);
    }
    result.push_back(row);
  }
  return result;
}

/// A bar of so many cells for the density above which the pile wakes, which a mark shows, else for density 1; longer
/// where there is more.
void put_density_bar(Area area, int row, int column, double density, const LayerThresholds& thresholds, bool asleep) {
  const int full = area.columns() - column - 2;  // two cells for what is above
  if (full < 2) return;
  const double mark = thresholds.wake > 0.0 ? thresholds.wake : 1.0;
  const int halves = std::clamp(static_cast<int>(std::lround(2.0 * full * density / mark)), 0, 2 * full + 4);
  area.put(row, column + full, "│", Style::quiet);
  const Style style = asleep ? Style::asleep : Style::awake;
  for (int cell = 0; 2 * cell < halves; ++cell)
    area.put(row, column + cell, 2 * cell + 1 < halves ? "█" : "▌", density > mark ? Style::alert : style);
}

constexpr int with_both = 48;  // columns at which both thresholds have room beside the bar

void draw_layer(const LayerRow& row, int number, const Area& area) {
  const std::string name =
      row.first == row.last ? fmt::format("{}", row.first) : fmt::format("{}-{}", row.first, row.last);
  const double density = row.capacity > 0.0 ? row.count / row.capacity : 0.0;
  const auto sleeping = static_cast<double>(row.sleeping);
  const int end = area.put(number, 0,
                           fmt::format("{:>5} {:4.2f} {:>4}/{:<4} {:>5}", name, density, count_text(row.count, 4),
                                       count_text(row.capacity, 4), count_text(sleeping, 5)));
  const bool asleep = 2.0 * sleeping >= row.count;
  if (row.thresholds.wake < 0.0) return put_density_bar(area, number, end + 1, density, row.thresholds, asleep);
  int last = area.put(number, end + 2, fmt::format("{:4.2f}", row.thresholds.wake),
                      density > row.thresholds.wake ? Style::alert : Style::quiet);
  if (area.columns() >= with_both)
    last = area.put(number, last + 3, fmt::format("{:4.2f}", row.thresholds.sleep), Style::quiet);
  put_density_bar(area, number, last + 1, density, row.thresholds, asleep);
}

/// Without the empty ones on top.
std::span<const Layer> filled_layers(const Pile<3>& pile) {
  std::span<const Layer> layers = pile.layers;
  while (!layers.empty() && layers.back().count == 0) layers = layers.first(layers.size() - 1);
  return layers;
}

std::string heading_of(int number, int place, std::size_t piles, const Pile<3>& pile) {
  constexpr double degrees = 180.0 / std::numbers::pi;
  const std::string among = piles > 1 ? fmt::format(" ({} of {})", place + 1, piles) : "";
  return fmt::format("pile {}{}: {} layers, {:.0f} deg, {:.0f} %", number, among, pile.layers.size(),
                     degrees * pile.alpha, 100.0 * pile.occupation_ratio());
}

}  // namespace

void draw_layers(const RunView& view, int pile_place, const Area& area) {
  const std::vector<RunView::NumberedPile> piles = view.piles();
  if (piles.empty()) {
    area.put(0, 0, "no pile yet", Style::quiet);
    return;
  }
  const int place = pile_place % static_cast<int>(piles.size());
  const Pile<3>& pile = *piles[place].pile;
  area.put(0, 0, heading_of(piles[place].number, place, piles.size(), pile), Style::strong);
  const bool has_thresholds = pile.layers.front().thresholds.wake >= 0.0;
  if (!has_thresholds)
    area.put(1, 0, "layer dens.  bodies/cap sleep", Style::quiet);
  else
    area.put(1, 0, fmt::format("layer dens bodies/cap sleep wake>{}", area.columns() >= with_both ? " sleep>" : ""),
             Style::quiet);
  const Area list = area.lower(2);
  const auto rows = rows_of(filled_layers(pile), static_cast<std::size_t>(list.rows()));
  int number = static_cast<int>(rows.size());
  for (const LayerRow& row : rows) draw_layer(row, --number, list);
}

}  // namespace talus
