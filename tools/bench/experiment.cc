#include "tools/bench/experiment.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/scene/table_reader.h"
#include "common/text/file.h"

namespace talus {
namespace {

constexpr auto published_fields = std::to_array<Field<Published>>({
    {place_of<&Published::values>, {.name = "published"}},
    {place_of<&Published::error>, {.name = "error", .range = at_least(0.0)}},
});

constexpr auto row_fields = std::to_array<Field<ExperimentRow>>({
    {place_of<&ExperimentRow::name>, {.name = "name", .required = true}},
    {place_of<&ExperimentRow::x>, {.name = "x", .range = above(0.0, 1e9)}},
    {place_of<&ExperimentRow::value>, {.name = "value"}},
});

constexpr auto fit_fields = std::to_array<Field<ExperimentFit>>({
    {place_of<&ExperimentFit::name>, {.name = "name", .required = true}},
    {place_of<&ExperimentFit::kind>, {.name = "kind", .required = true, .choices = fit_kinds}},
    {place_of<&ExperimentFit::power>, {.name = "power"}},
});

constexpr auto experiment_fields = std::to_array<Field<Experiment>>({
    {place_of<&Experiment::title>, {.name = "title", .required = true}},
    {place_of<&Experiment::source>, {.name = "source", .required = true}},
    {place_of<&Experiment::remark>, {.name = "remark"}},
    {place_of<&Experiment::name>, {.name = "scene", .required = true}},
    {place_of<&Experiment::value>, {.name = "value", .required = true}},
    {place_of<&Experiment::unit>, {.name = "unit"}},
    {place_of<&Experiment::over>, {.name = "over"}},
    {place_of<&Experiment::at_least>, {.name = "at_least"}},
});

constexpr const char* pointer_rule = "must be a JSON pointer, as /gates/0/net";

Published read_published(TableReader& table) {
  Published published;
  table.read_fields(published, published_fields);
  if (published.values.size() > 2) table.error("published", "must be one number or two, an interval");
  return published;
}

/// A path of the scene with its value for each key of a table; a reader of tables has no such keys.
std::vector<std::string> settings_in(const toml::node* set) {
  std::vector<std::string> settings;
  if (set != nullptr && set->is_table())
    for (const auto& [path, value] : *set->as_table())
      settings.push_back(fmt::format("{}={}", path.str(), value_text(value)));
  return settings;
}

ExperimentRow read_row(TableReader& table, const toml::node_view<const toml::node>& written) {
  ExperimentRow row;
  table.read_fields(row, row_fields);
  row.published = read_published(table);
  if (table.has("set") && !written["set"].is_table()) table.error("set", "must be a table of paths and values");
  if (!row.value.empty() && !row.value.starts_with('/')) table.error("value", pointer_rule);
  row.settings = settings_in(written["set"].node());
  return row;
}

ExperimentFit read_fit(TableReader& table) {
  ExperimentFit fit;
  table.read_fields(fit, fit_fields);
  fit.published = read_published(table);
  return fit;
}

Experiment read_experiment(TableReader& table, const toml::node_view<const toml::node>& written,
                           const std::filesystem::path& folder) {
  Experiment experiment;
  table.read_fields(experiment, experiment_fields);
  experiment.scene = folder / (experiment.name + ".toml");
  if (table.ok() && !std::filesystem::is_regular_file(experiment.scene))
    table.error("scene", "must be the name of a scene beside this file");
  if (table.ok() && !experiment.value.starts_with('/')) table.error("value", pointer_rule);
  if (table.ok() && experiment.over == 0.0) table.error("over", "must not be 0");
  table.tables("row", [&, i = std::size_t{0}](TableReader& row) mutable {
    experiment.rows.push_back(read_row(row, written["row"][i++]));
  });
  if (experiment.rows.empty()) table.error("row", "must be given once or more");
  table.tables("fit", [&](TableReader& fit) { experiment.fits.push_back(read_fit(fit)); });
  const bool all_x = std::ranges::all_of(experiment.rows, [](const ExperimentRow& row) { return row.x.has_value(); });
  if (!experiment.fits.empty() && !all_x) table.error("fit", "must have an x in each row");
  return experiment;
}

/// Least squares of log(value) = log(c) + p log(x).
double exponent_of(const std::vector<double>& x, const std::vector<double>& values) {
  const auto n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double lx = std::log(x[i]), ly = std::log(values[i]);
    sx += lx;
    sy += ly;
    sxx += lx * lx;
    sxy += lx * ly;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Least squares of log(value) = log(c) + power log(x).
double factor_of(double power, const std::vector<double>& x, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::log(values[i]) - power * std::log(x[i]);
  return std::exp(sum / static_cast<double>(x.size()));
}

}  // namespace

std::vector<Experiment> read_experiments(const std::filesystem::path& file) {
  Diagnostics diagnostics{.file = file.string()};
  std::vector<Experiment> experiments;
  try {
    const toml::table root = toml::parse(file_contents(file).value_or(""), file.string());
    TableReader::read_root(root, 0, diagnostics, [&](TableReader& table) {
      table.tables("experiment", [&, i = std::size_t{0}](TableReader& each) mutable {
        experiments.push_back(read_experiment(each, root["experiment"][i++], file.parent_path()));
      });
    });
  } catch (const toml::parse_error& error) {
    const auto at = error.source().begin;
    diagnostics.errors.push_back({file.string(), static_cast<int>(at.line), static_cast<int>(at.column), "", "",
                                  std::string(error.description()), ""});
  }
  if (!diagnostics.errors.empty()) throw SceneErrors(diagnostics.errors);
  return experiments;
}

double fitted(const ExperimentFit& fit, const std::vector<double>& x, const std::vector<double>& values) {
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value) && value > 0.0; }))
    return std::numeric_limits<double>::quiet_NaN();
  return fit.kind == "exponent" ? exponent_of(x, values) : factor_of(fit.power, x, values);
}

}  // namespace talus
