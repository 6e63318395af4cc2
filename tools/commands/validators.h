#pragma once
// Checks of options on the command line.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <system_error>

namespace talus {

/// For options with a text: `--out ''` is not the same as no --out.
inline CLI::Validator not_empty() {
  return {[](const std::string& text) { return std::string(text.empty() ? "must not be empty" : ""); }, ""};
}

/// For names of files to write: their folder must be there.
inline CLI::Validator in_a_folder() {
  return {[](const std::string& text) {
            const std::filesystem::path folder = std::filesystem::path(text).parent_path();
            std::error_code unused;
            const bool there = !text.empty() && (folder.empty() || std::filesystem::is_directory(folder, unused));
            return there ? std::string() : text + ": must be a file in a folder that exists";
          },
          ""};
}

/// For options with a file to write, which must be no folder.
inline CLI::Validator file_to_write() {
  return {[](const std::string& text) {
            const std::string error = in_a_folder()(text);
            std::error_code unused;
            const bool folder = error.empty() && std::filesystem::is_directory(text, unused);
            return folder ? text + ": must be a file, not a folder" : error;
          },
          ""};
}

enum class Bound { kept, left_out };

/// For an option: a finite number up to `high`, from or above `low`. CLI::Range lets nan through.
inline CLI::Validator number_between(double low, double high, Bound lower = Bound::kept) {
  std::string most = fmt::format("{:g}", high);
  if (const std::size_t sign = most.find("e+0"); sign != std::string::npos) most.replace(sign, 3, "e");
  const auto check = [=](const std::string& text) -> std::string {
    double value = NAN;
    const bool inside = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value <= high &&
                        (lower == Bound::kept ? value >= low : value > low);
    if (inside) return {};
    return fmt::format("{}: must be a number {} {:g} {} {}", text, lower == Bound::kept ? "from" : "above", low,
                       lower == Bound::kept ? "to" : "and at most", most);
  };
  return CLI::Validator(check, fmt::format("{}{:g} to {}", lower == Bound::kept ? "" : "above ", low, most));
}

/// For an option: a whole number from `low` to `high`. CLI11 takes one beyond 64 bits for the largest.
inline CLI::Validator whole_number(std::int64_t low, std::int64_t high) {
  const auto check = [=](const std::string& text) -> std::string {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && value >= low && value <= high) return {};
    return fmt::format("{}: must be a whole number from {} to {}", text, low, high);
  };
  return CLI::Validator(check, fmt::format("{} to {}", low, high));
}

/// The same, up to the largest of 64 bits, of which its help tells nothing.
inline CLI::Validator whole_number() {
  return whole_number(0, std::numeric_limits<std::int64_t>::max()).description("");
}

}  // namespace talus
