#pragma once
// Published experiments as data: scenes/published/experiments.toml.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// What was published of a number.
struct Published {
  std::vector<double> values = {};  // none, one number, or the two ends of an interval
  double error = 0.0;               // standard error of these
};

/// One setting of an experiment.
struct ExperimentRow {
  std::string name = {};
  std::vector<std::string> settings = {};  // PATH=VALUE
  std::optional<double> x = {};            // what fits take the value to depend on
  std::string value = {};                  // what is measured; empty: that of the experiment
  Published published = {};
};

/// A number that all rows give together.
struct ExperimentFit {
  std::string name = {};
  std::string kind = {};  // one of fit_kinds
  double power = 1.0;     // of "factor"
  Published published = {};
};

/// `exponent`: p of value = c x^p. `factor`: c of value = c x^power. Both by least squares of the logarithms.
inline constexpr auto fit_kinds = std::to_array<std::string_view>({"exponent", "factor"});

/// A scene, what is measured in it, and what others found.
struct Experiment {
  std::string name = {};
  std::string title = {};
  std::string source = {};
  std::string remark = {};              // why numbers differ
  std::filesystem::path scene = {};     // file
  std::string value = {};               // what is measured, as a JSON pointer into what published_run() gives
  std::string unit = {};                // of the value, once divided
  double over = 1.0;                    // what the value is divided by
  std::optional<double> at_least = {};  // then the value is the share of runs in which it is as large as this
  std::vector<ExperimentRow> rows = {};
  std::vector<ExperimentFit> fits = {};
};

/// All experiments of a file; scenes are beside it. Throws SceneErrors with all that is wrong.
std::vector<Experiment> read_experiments(const std::filesystem::path& file);

/// The number that a fit of this kind gives for values at `x` > 0; NaN where a value is not finite and above 0.
double fitted(const ExperimentFit& fit, const std::vector<double>& x, const std::vector<double>& values);

}  // namespace talus
