#include "tools/sweep/sweep_plan.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace talus {
namespace {

constexpr double most_values = 10'000.0;

/// LOW, LOW + STEP, ... up to HIGH, rounded so that 0.2 + 0.2 + 0.2 is 0.6; whole numbers are exact.
std::vector<std::string> range_values(const std::vector<std::string>& parts, const std::string& text) {
  const auto low = number_of(parts[0]);
  const auto high = number_of(parts[1]);
  const auto step = number_of(parts[2]);
  if (!low || !high || !step || *step <= 0.0 || *high < *low || (*high - *low) / *step > most_values)
    throw std::invalid_argument(fmt::format(
        "--set {}: must be LOW:HIGH:STEP, three numbers, with at most {:g} steps upwards", text, most_values));
  std::vector<std::string> values;
  const int count = static_cast<int>(std::floor((*high - *low) / *step + 1e-9)) + 1;
  const bool whole = *low == std::floor(*low) && *step == std::floor(*step) && std::abs(*low) + *high < 0x1p53;
  for (int i = 0; i < count; ++i)
    values.push_back(fmt::format(fmt::runtime(whole ? "{:.0f}" : "{:.12g}"), *low + i * *step));
  return values;
}

}  // namespace

std::optional<double> number_of(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
  return whole ? std::optional(number) : std::nullopt;
}

std::vector<std::string> split_outside(std::string_view text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = '\0';
  for (const char letter : text) {
    if (quote != '\0')
      quote = letter == quote ? '\0' : quote;
    else if (letter == '"' || letter == '\'')
      quote = letter;
    else if (letter == '[' || letter == '{')
      ++depth;
    else if (letter == ']' || letter == '}')
      --depth;
    if (letter == separator && depth == 0 && quote == '\0')
      parts.emplace_back();
    else
      parts.back() += letter;
  }
  return parts;
}

SweepAxis sweep_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw std::invalid_argument(fmt::format("--set {}: must be PATH=VALUES, as in policy.tau=0.1:0.5:0.1", text));
  SweepAxis axis{text.substr(0, equals), {}};
  const std::string written = text.substr(equals + 1);
  const std::vector<std::string> range = split_outside(written, ':');
  axis.values = range.size() == 3 ? range_values(range, text) : split_outside(written, ',');
  for (const std::string& value : axis.values)
    if (value.empty()) throw std::invalid_argument(fmt::format("--set {}: must have no empty value", text));
  if (has_twins(axis.values)) throw std::invalid_argument(fmt::format("--set {}: must have no value twice", text));
  return axis;
}

bool has_twins(std::vector<std::string> values) {
  for (std::string& value : values)
    if (const auto number = number_of(value)) value = fmt::format("{}", *number);
  std::ranges::sort(values);
  return std::ranges::adjacent_find(values) != values.end();
}

bool overlap(const std::string& path, const std::string& other) {
  const toml::path first(path);
  const toml::path second(other);
  if (first.empty() || second.empty()) return false;  // no paths, which the scene's reader refuses
  const auto [of_first, of_second] = std::mismatch(first.begin(), first.end(), second.begin(), second.end());
  return of_first == first.end() || of_second == second.end();
}

void require_apart(const std::vector<SweepAxis>& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (overlap(axes[i].path, axes[k].path))
        throw std::invalid_argument(
            fmt::format("--set {}: must be given once, and {} is given, too", axes[i].path, axes[k].path));
}

int sweep_size(const std::vector<SweepAxis>& axes) {
  std::size_t size = 1;
  for (const SweepAxis& axis : axes) {
    size *= axis.values.size();
    if (size > most_sweep_runs)
      throw std::invalid_argument(fmt::format("sweep: must have at most {} runs", most_sweep_runs));
  }
  return static_cast<int>(size);
}

SweepRun sweep_run(const std::vector<SweepAxis>& axes, int number) {
  SweepRun run{std::vector<std::string>(axes.size())};
  for (std::size_t i = axes.size(); i-- > 0;) {
    const int count = static_cast<int>(axes[i].values.size());
    run.values[i] = axes[i].values[number % count];
    number /= count;
  }
  return run;
}

std::vector<std::string> settings_of(const std::vector<SweepAxis>& axes, const SweepRun& run) {
  std::vector<std::string> settings;
  for (std::size_t i = 0; i < axes.size(); ++i) settings.push_back(axes[i].path + "=" + run.values[i]);
  return settings;
}

}  // namespace talus
