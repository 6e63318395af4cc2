#pragma once
// The sub-commands of `talus`. Each adds itself to the command line and sets `exit_code` when it has run.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <system_error>

namespace talus {

namespace exit_codes {
inline constexpr int success = 0;
inline constexpr int failed = 1;         // the run itself went wrong; all that was recorded is kept
inline constexpr int bad_input = 2;      // a scene, option or file is not as it should be
inline constexpr int interrupted = 130;  // Ctrl-C; all is saved
}  // namespace exit_codes

/// For options with a text: `--out ''` is not the same as no --out.
inline CLI::Validator not_empty() {
  return {[](const std::string& text) { return std::string(text.empty() ? "must not be empty" : ""); }, ""};
}

/// For options with a file to write: its folder must be there.
inline CLI::Validator in_a_folder() {
  return {[](const std::string& text) {
            const std::filesystem::path folder = std::filesystem::path(text).parent_path();
            std::error_code unused;
            const bool there = !text.empty() && (folder.empty() || std::filesystem::is_directory(folder, unused));
            return there ? std::string() : text + ": must be a file in a folder that exists";
          },
          ""};
}

void add_run_command(CLI::App& app, int& exit_code);
void add_list_command(CLI::App& app, int& exit_code);
void add_check_command(CLI::App& app, int& exit_code);
void add_sheet_command(CLI::App& app, int& exit_code);
void add_reference_command(CLI::App& app, int& exit_code);

}  // namespace talus
