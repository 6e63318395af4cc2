#pragma once
// Plots of cases: a point a case, a curve a policy, an engine or a sweep.

#include <functional>
#include <string>
#include <vector>

#include "tools/bench/case_table.h"
#include "tools/plot/plot.h"
#include "tools/report/html_report.h"

namespace talus {

/// Bars at the points of a plot.
enum class Bars {
  none,
  rounds,     // smallest and largest of the rounds
  deviation,  // standard deviation of one run
};

/// Which cases a plot shows and where.
struct CasePlot {
  std::string caption;
  std::string x_label;
  /// Place of a case; a case whose place is not finite is left out.
  std::function<double(const CaseView&)> x;
  MeasureId y;
  /// Empty: the heading of `y`.
  std::string y_label = {};
  bool log_x = false;
  bool log_y = false;
  /// Whether a linear y axis begins at zero.
  bool from_zero = true;
  Bars bars = Bars::none;
  Pass pass = Pass::against_full;
  /// Name of the curve that a case belongs to; empty: the case is left out.
  std::function<std::string(const CaseView&)> curve;
  /// One plot per scene and engine; else one plot for all.
  bool per_scene = true;
  /// Joins the points of a curve in the order of its cases, as for a swept parameter; otherwise in the order of x.
  bool in_order_of_cases = false;
  /// Curves beside those of the cases.
  std::vector<Series> more = {};
};

/// "scene, engine" of a case, for titles and curves.
std::string scene_and_engine(const CaseView& view);

/// Places and curves for plots: a measure of the case; the case's own curve; its policy where it lets bodies sleep.
std::function<double(const CaseView&)> measured(MeasureId id);
std::string curve_of_case(const CaseView& view);
std::string sleeping_policy_of(const CaseView& view);

/// The figures of the plot; none where there is no point. A figure has at most seven curves, and its caption says how
/// many are left out.
std::vector<Figure> figures_of(const BenchRunner& runner, const std::vector<BenchGroup>& groups,
                               const CasePlot& wanted);

}  // namespace talus
