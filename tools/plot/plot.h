#pragma once
// Plots as SVG, drawn by gnuplot.

#include <string>
#include <vector>

namespace talus {

enum class SeriesStyle { line, line_and_points };

/// One curve. Coordinates are finite; with a logarithmic axis those on it are above zero.
struct Series {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;         // as many as x
  std::vector<double> low = {};  // lower and upper ends of error bars: as many as x, or none
  std::vector<double> high = {};
  SeriesStyle style = SeriesStyle::line;
};

struct Plot {
  std::string title;
  std::string x_label;  // with the unit, as in "time [s]"
  std::string y_label;
  bool log_x = false;
  bool log_y = false;          // a linear one begins at zero where no value is below
  std::vector<Series> series;  // at most 7, the number of colours distinct for all kinds of colour vision
  int width = 760;             // [px] 200..4000
  int height = 440;            // [px] 200..4000
};

/// The plot as the text of an SVG file, the same for the same plot. Throws std::invalid_argument naming the series and
/// the rule; std::runtime_error with gnuplot's own words, or saying which package to install where it is missing.
std::string svg_of(const Plot& plot);

/// Throws std::invalid_argument if the plot's numbers do not fit together.
void check(const Plot& plot);

/// The input with which gnuplot writes the plot as SVG to its standard output, data included.
std::string gnuplot_script(const Plot& plot);

}  // namespace talus
