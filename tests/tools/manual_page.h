#pragma once
// A page of the manual as a reader takes commands from it.

#include <map>
#include <string>
#include <vector>

namespace talus {

struct CommandLine {
  /// Page and line.
  std::string place;
  /// Without its comment.
  std::string text;
};

struct ManualPage {
  /// Path from the root of the repository.
  std::string name;
  /// The lines of its ```sh blocks.
  std::vector<CommandLine> commands;
  /// Commands of `talus` and `./dev` between back quotes in the text.
  std::vector<CommandLine> inline_commands;
  /// Lines outside of ```sh blocks that look like commands.
  std::vector<CommandLine> outside;
  /// TOML blocks by the file name that the line before them ends with, as in "Save this as `discs.toml`:".
  std::map<std::string, std::string> files;
};

/// Reads a page; `name` is its path from the root of the repository.
ManualPage read_page(const std::string& name);

/// README.md, CONTRIBUTING.md and docs/*.md.
std::vector<std::string> page_names();

}  // namespace talus
