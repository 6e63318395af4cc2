#include "tools/bench/case_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus {
namespace {

constexpr std::size_t most_curves = 7;  // colours that people of any colour vision can distinguish

/// The curve of this name, added where it is missing.
Series& curve_of(Plot& plot, const std::string& name) {
  const auto found = std::ranges::find(plot.series, name, &Series::name);
  if (found != plot.series.end()) return *found;
  Series series{name, {}, {}};
  series.style = SeriesStyle::line_and_points;
  return plot.series.emplace_back(series);
}

void add_point(const CasePlot& wanted, const CaseView& view, Plot& plot) {
  const std::string name = wanted.curve(view);
  const double x = wanted.x(view);
  const double y = view.values[wanted.y];
  const bool placed = std::isfinite(x) && std::isfinite(y) && (!wanted.log_x || x > 0.0) && (!wanted.log_y || y > 0.0);
  if (name.empty() || !placed) return;
  Series& series = curve_of(plot, name);
  series.x.push_back(x);
  series.y.push_back(y);
  if (wanted.bars == Bars::none) return;
  const double deviation = wanted.bars == Bars::deviation ? view.values[wanted.y.with("_sd")] : 0.0;
  const bool rounds = wanted.bars == Bars::rounds;
  series.low.push_back(rounds ? view.values[wanted.y.with("_min")] : y - deviation);
  series.high.push_back(rounds ? view.values[wanted.y.with("_max")] : y + deviation);
}

/// Orders the points along x, so that a line joins neighbours.
void sort_along_x(Series& series) {
  std::vector<std::size_t> order(series.x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return series.x[i]; });
  for (std::vector<double>* column : {&series.x, &series.y, &series.low, &series.high}) {
    if (column->empty()) continue;
    std::vector<double> sorted;
    for (const std::size_t i : order) sorted.push_back((*column)[i]);
    *column = sorted;
  }
}

}  // namespace

std::string scene_and_engine(const CaseView& view) {
  return key_of(view.bench_case).scene + ", " + view.bench_case.backend;
}

std::function<double(const CaseView&)> measured(MeasureId id) {
  return [id](const CaseView& view) { return view.values[id]; };
}

std::string curve_of_case(const CaseView& view) { return view.bench_case.curve; }

std::string sleeping_policy_of(const CaseView& view) { return sleeps(view) ? view.bench_case.policy : ""; }

std::vector<Figure> figures_of(const BenchRunner& runner, const std::vector<BenchGroup>& groups,
                               const CasePlot& wanted) {
  std::vector<Plot> plots;
  for (const BenchGroup& group : groups) {
    for (const BenchCase& each : group.cases) {
      const CaseView view = view_of(runner, group, each, wanted.pass);
      const std::string title = wanted.per_scene ? scene_and_engine(view) : "";
      auto plot = std::ranges::find(plots, title, &Plot::title);
      if (plot == plots.end()) {
        plots.push_back({.title = title,
                         .x_label = wanted.x_label,
                         .y_label = wanted.y_label.empty() ? std::string(wanted.y.info().heading) : wanted.y_label,
                         .log_x = wanted.log_x,
                         .log_y = wanted.log_y,
                         .from_zero = wanted.from_zero,
                         .series = {}});
        plot = plots.end() - 1;
      }
      add_point(wanted, view, *plot);
    }
  }
  std::vector<Figure> figures;
  for (Plot& plot : plots) {
    if (plot.series.empty()) continue;
    if (!wanted.in_order_of_cases) std::ranges::for_each(plot.series, sort_along_x);
    plot.series.insert(plot.series.end(), wanted.more.begin(), wanted.more.end());
    std::string caption = wanted.caption;
    if (plot.series.size() > most_curves) {
      caption += fmt::format(" Curves left out: {}.", plot.series.size() - most_curves);
      plot.series.resize(most_curves);
    }
    figures.push_back({svg_of(plot), caption});
  }
  return figures;
}

}  // namespace talus
