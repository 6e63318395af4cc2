#include "common/scene/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace talus {
namespace {

std::vector<SceneError> in_order(std::vector<SceneError> errors) {
  std::stable_sort(errors.begin(), errors.end(), [](const SceneError& a, const SceneError& b) {
    return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
  });
  return errors;
}

std::string one_line_each(const std::vector<SceneError>& errors) {
  const std::size_t shown = std::min(errors.size(), max_printed_errors);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < shown; ++i) lines.push_back(to_string(errors[i]));
  if (errors.size() > shown) lines.push_back(fmt::format("and {} more errors", errors.size() - shown));
  return fmt::format("{}", fmt::join(lines, "\n"));
}

}  // namespace

std::string to_string(const SceneError& error) {
  std::string text = error.file;
  if (error.line > 0) text += fmt::format(":{}:{}", error.line, error.column);
  if (!error.field.empty()) text += fmt::format(": {}", error.field);
  if (!error.value.empty()) text += fmt::format(" = {}", error.value);
  text += fmt::format(": {}", error.rule);
  if (!error.suggestion.empty()) text += fmt::format(" (did you mean \"{}\"?)", error.suggestion);
  return text;
}

SceneErrors::SceneErrors(std::vector<SceneError> errors) : SceneErrors(in_order(std::move(errors)), InOrder()) {}

SceneErrors::SceneErrors(std::vector<SceneError> errors, InOrder /*order*/)
    : std::runtime_error(one_line_each(errors)), errors_(std::move(errors)) {}

}  // namespace talus
