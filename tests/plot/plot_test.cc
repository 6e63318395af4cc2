// Plots, drawn by the real gnuplot.

#include "tools/plot/plot.h"

#include <gtest/gtest.h>

#include <limits>

namespace talus::plot_test {
namespace {

Plot sample() {
  Plot plot;
  plot.title = "A 'quoted' title & <more>";
  plot.x_label = "time [s]";
  plot.y_label = "awake bodies";
  plot.series = {
      {"one", {0.0, 1.0, 2.0}, {3.0, 1.0, 2.0}, {2.5, 0.5, 1.5}, {3.5, 1.5, 2.5}, SeriesStyle::line_and_points},
      {"two", {0.0, 1.0, 2.0}, {1.0, 2.0, 4.0}}};
  return plot;
}

std::string refusal(const Plot& plot) {
  try {
    svg_of(plot);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Plot, IsAnSvgWithItsWords) {
  const std::string svg = svg_of(sample());
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("A 'quoted' title &amp; &lt;more>"), std::string::npos);
  EXPECT_NE(svg.find("time [s]"), std::string::npos);
  EXPECT_NE(svg.find("rgb(  0, 114, 178)"), std::string::npos);
}

TEST(Plot, IsTheSameBytesForTheSameInput) { EXPECT_EQ(svg_of(sample()), svg_of(sample())); }

TEST(Plot, HandsOverEachNumberWithoutLossOfDigits) {
  Plot plot = sample();
  plot.series = {{"one", {0.1}, {1.0 / 3.0}}};
  EXPECT_NE(gnuplot_script(plot).find("0.1 0.3333333333333333\n"), std::string::npos);
}

TEST(Plot, DrawsLogarithmicAxesAndASinglePoint) {
  Plot plot = sample();
  plot.series = {{"one", {10.0}, {100.0}, {}, {}, SeriesStyle::line_and_points}};
  plot.log_x = plot.log_y = true;
  EXPECT_NE(svg_of(plot).find("</svg>"), std::string::npos);
}

TEST(Plot, RefusesNumbersThatDoNotFitTogether) {
  Plot plot = sample();
  plot.series[1].y.pop_back();
  EXPECT_EQ(refusal(plot), "series \"two\".y = 2 values: must be as many as x, 3");
  plot = sample();
  plot.log_x = true;
  EXPECT_EQ(refusal(plot), "series \"one\".x = 0.000000: must be above 0 on a logarithmic axis");
  plot = sample();
  plot.series[0].y[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(plot), "series \"one\".y = nan: must be finite");
  plot.series.clear();
  EXPECT_EQ(refusal(plot), "plot.series = 0 of them: must be 1 to 7");
}

TEST(Plot, SaysWhichPackageIsMissing) {
  const std::string path = getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  std::string told;
  try {
    svg_of(sample());
  } catch (const std::runtime_error& error) {
    told = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(told.find("apt-get install gnuplot-nox"), std::string::npos) << told;
}

}  // namespace
}  // namespace talus::plot_test
