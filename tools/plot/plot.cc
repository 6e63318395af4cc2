#include "tools/plot/plot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace talus {
namespace {

/// A folder of its own for one call, gone with it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "talus_plot_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot make a folder in " + std::filesystem::temp_directory_path().string());
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs gnuplot with its output and errors in files; returns its exit status. Without a shell, so that no name needs
/// quoting.
int run_gnuplot(std::string script, const std::string& output, const std::string& errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::string program = "gnuplot";
  std::string defaults_off = "-d";  // a user's own ~/.gnuplot would change the style
  const std::array<char*, 4> arguments = {program.data(), defaults_off.data(), script.data(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT)
    throw std::runtime_error("plots need gnuplot, which is not on this machine: apt-get install gnuplot-nox");
  if (failure != 0) throw std::runtime_error(std::string("cannot start gnuplot: ") + std::strerror(failure));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

std::string svg_of(const Plot& plot) {
  check(plot);
  const TemporaryFolder folder;
  const std::string script = folder / "plot.gp";
  std::ofstream(script) << gnuplot_script(plot);
  const int status = run_gnuplot(script, folder / "plot.svg", folder / "errors");
  std::string svg = text_of(folder / "plot.svg");
  if (status != 0 || svg.find("</svg>") == std::string::npos)
    throw std::runtime_error("gnuplot could not draw \"" + plot.title + "\": " + text_of(folder / "errors"));
  return svg;
}

namespace {

// Okabe and Ito's colours, distinct for all kinds of colour vision; yellow left out, too pale for lines on white.
constexpr std::array<const char*, 7> palette = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#000000"};
// Round, square, triangles, diamond: distinct in grey print too.
constexpr std::array<int, 7> point_types = {7, 5, 9, 11, 13, 6, 4};

void require(bool holds, const std::string& field, const std::string& value, const std::string& rule) {
  if (!holds) throw std::invalid_argument(fmt::format("{} = {}: {}", field, value, rule));
}

void check_values(const std::string& field, const std::vector<double>& values, bool logarithmic) {
  for (const double value : values) {
    require(std::isfinite(value), field, std::to_string(value), "must be finite");
    require(!logarithmic || value > 0.0, field, std::to_string(value), "must be above 0 on a logarithmic axis");
  }
}

/// In gnuplot's single quotes nothing but the quote has a meaning.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\n' ? std::string(" ") : c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

/// A logarithmic axis that reaches a little beyond its values instead of to the next powers of ten, with labels at 1, 2
/// and 5 where powers alone would be too few.
std::string logarithmic_axis(char axis, const Plot& plot) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const Series& series : plot.series) {
    for (const auto* values : {axis == 'x' ? &series.x : &series.y, axis == 'x' ? &series.x : &series.low,
                               axis == 'x' ? &series.x : &series.high}) {
      for (const double value : *values) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  constexpr double margin = 1.15;
  constexpr double few_decades = 50.0;
  std::string script = fmt::format("set logscale {0} 10\nset {0}range [{1}:{2}]\n", axis, low / margin, high * margin);
  if (high / low > few_decades) return script;
  script += fmt::format("set {}tics (", axis);
  for (double decade = std::pow(10.0, std::floor(std::log10(low / margin))); decade <= high * margin; decade *= 10.0)
    for (const double step : {1.0, 2.0, 5.0}) script += fmt::format("'{0:g}' {0:g},", step * decade);
  script.back() = ')';
  return script + "\n";
}

std::string head_of(const Plot& plot) {
  std::string script = fmt::format(
      "set terminal svg size {},{} dynamic noenhanced font 'DejaVu Sans,13' background 'white'\n"
      "set encoding utf8\n"
      "set border 3 linecolor '#666666'\n"
      "set tics nomirror out scale 0.6 textcolor '#333333'\n"
      "set grid back linecolor '#DDDDDD' linetype 1 linewidth 0.6\n"
      "set key outside bottom center horizontal Left reverse noopaque textcolor '#222222' samplen 2.5 height 0.8\n",
      plot.width, plot.height);
  if (!plot.title.empty()) script += fmt::format("set title {} textcolor '#222222' font ',15'\n", quoted(plot.title));
  script += fmt::format("set xlabel {} offset 0,0.5 textcolor '#222222'\n", quoted(plot.x_label));
  script += fmt::format("set ylabel {} textcolor '#222222'\n", quoted(plot.y_label));
  if (plot.log_x) script += logarithmic_axis('x', plot);
  // The caps of bars at the first and last point.
  const bool bars = std::ranges::any_of(plot.series, [](const Series& series) { return !series.low.empty(); });
  if (bars && !plot.log_x) script += "set offsets graph 0.03, graph 0.03, 0, 0\n";
  if (plot.log_y) script += logarithmic_axis('y', plot);
  const bool none_below = std::ranges::all_of(plot.series, [](const Series& series) {
    const auto above = [](double value) { return value >= 0.0; };
    return std::ranges::all_of(series.y, above) && std::ranges::all_of(series.low, above);
  });
  if (!plot.log_y && none_below) script += "set yrange [0:*]\n";
  return script;
}

std::string data_of(const Series& series, std::size_t number) {
  std::string block = fmt::format("$series{} << END_OF_SERIES\n", number);
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    block += fmt::format("{} {}", series.x[i], series.y[i]);
    block += series.low.empty() ? "\n" : fmt::format(" {} {}\n", series.low[i], series.high[i]);
  }
  return block + "END_OF_SERIES\n";
}

std::string curve_of(const Series& series, std::size_t number) {
  static constexpr std::array<const char*, 2> styles = {"lines", "linespoints"};
  const std::string style = fmt::format("linecolor '{0}' linewidth 2 pointtype {1} pointsize 0.7",
                                        palette[number % palette.size()], point_types[number % point_types.size()]);
  std::string curve = fmt::format(
      "$series{} using 1:2 with {} {} title {}", number, styles[static_cast<std::size_t>(series.style)],
      series.style == SeriesStyle::line ? fmt::format("linecolor '{}' linewidth 2", palette[number % palette.size()])
                                        : style,
      quoted(series.name));
  if (!series.low.empty()) curve += fmt::format(", $series{} using 1:2:3:4 with yerrorbars {} notitle", number, style);
  return curve;
}

}  // namespace

void check(const Plot& plot) {
  require(plot.width >= 200 && plot.width <= 4000, "plot.width", std::to_string(plot.width), "must be 200 to 4000 px");
  require(plot.height >= 200 && plot.height <= 4000, "plot.height", std::to_string(plot.height),
          "must be 200 to 4000 px");
  require(!plot.series.empty() && plot.series.size() <= palette.size(), "plot.series",
          std::to_string(plot.series.size()) + " of them", "must be 1 to 7");
  for (const Series& series : plot.series) {
    const std::string name = fmt::format("series \"{}\"", series.name);
    const std::size_t size = series.x.size();
    require(size > 0, name + ".x", "[]", "must hold a value");
    require(series.y.size() == size, name + ".y", std::to_string(series.y.size()) + " values",
            fmt::format("must be as many as x, {}", size));
    require(series.low.size() == series.high.size() && (series.low.empty() || series.low.size() == size),
            name + ".low and .high", fmt::format("{} and {} values", series.low.size(), series.high.size()),
            fmt::format("must be as many as x, {}, or none", size));
    check_values(name + ".x", series.x, plot.log_x);
    check_values(name + ".y", series.y, plot.log_y);
    check_values(name + ".low", series.low, plot.log_y);
    check_values(name + ".high", series.high, plot.log_y);
  }
}

std::string gnuplot_script(const Plot& plot) {
  std::string script = head_of(plot);
  std::string curves;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    script += data_of(plot.series[i], i);
    curves += (i == 0 ? "" : ", ") + curve_of(plot.series[i], i);
  }
  return script + "plot " + curves + "\n";
}

}  // namespace talus
