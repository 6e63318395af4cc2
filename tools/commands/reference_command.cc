#include <filesystem>
#include <memory>
#include <stdexcept>

#include "common/math/require.h"
#include "common/scene/reference.h"
#include "common/text/file.h"
#include "tools/commands/command_line_text.h"
#include "tools/commands/commands.h"
#include "tools/output/output.h"

namespace talus {
namespace {

void print_reference() {
  for (const auto& [name, table] : key_tables()) print_result("## {}\n\n{}\n", name, table);
}

void update(const std::filesystem::path& file) {
  const std::optional<std::string> before = file_contents(file);
  require(before.has_value(), "--update", file.string(), readable_rule);
  try {
    const std::string after = with_reference(*before);
    if (after != before) write_file(file, after);
  } catch (const std::invalid_argument& error) {
    throw InvalidValue("--update", file.string(), error.what());
  }
}

}  // namespace

void add_reference_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("reference", "All keys of a scene file with unit, default, range and meaning");
  auto file = std::make_shared<std::string>();
  command->add_option("--update", *file, "Put the tables into this Markdown file, between its marks, as docs/scenes.md")
      ->check(not_empty());
  auto shell = std::make_shared<std::string>();
  auto* completion = command->add_option("--completion", *shell, "Print a script that completes command lines instead")
                         ->check(CLI::IsMember({"bash", "zsh"}));
  auto man = std::make_shared<bool>(false);
  command->add_flag("--man", *man, "Print the manual page instead")->excludes(completion);
  command->callback([=, &app, &exit_code] {
    if (*man)
      print_text(man_page(app));
    else if (!shell->empty())
      print_text(*shell == "bash" ? bash_completion(app) : zsh_completion(app));
    else if (file->empty())
      print_reference();
    else
      update(*file);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
