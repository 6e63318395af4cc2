#include "tools/commands/command_line_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "common/text/nearest_name.h"

namespace talus {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_name().empty(); });
}

/// As `-o`, `--out`.
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::vector<std::string> words_of(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::App* command : commands_of(app)) words.push_back(command->get_name());
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : names_of(*option)) words.push_back(name);
  return words;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Text in which roff reads nothing as a request.
std::string roff(const std::string& text) {
  std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  escaped = replaced(escaped, "\n.", "\n\\&.");
  escaped = replaced(escaped, "\n'", "\n\\&'");
  if (escaped.starts_with('.') || escaped.starts_with('\'')) escaped.insert(0, "\\&");
  return escaped;
}

std::string option_text(const CLI::Option& option) {
  std::string head;
  for (const std::string& name : names_of(option))
    head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", roff(name));
  if (head.empty()) head = fmt::format("\\fI{}\\fR", roff(option.get_name(true)));
  if (takes_value(option) && !option.get_type_name().empty())
    head += fmt::format(" \\fI{}\\fR", roff(option.get_type_name()));
  return fmt::format(".TP\n{}\n{}\n", head, roff(option.get_description()));
}

void append_command(const CLI::App& command, const std::string& name, std::string& page) {
  page += fmt::format(".SS {}\n{}\n", roff(name), roff(command.get_description()));
  for (const CLI::Option* option : command.get_options())
    if (option->get_name() != "--help") page += option_text(*option);
  if (const std::string footer = command.get_footer(); !footer.empty())
    page += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(footer));
  for (const CLI::App* below : commands_of(command)) append_command(*below, name + " " + below->get_name(), page);
}

/// A case of the script for a command and each below it; `path` as `talus bench`.
void append_case(const CLI::App& command, const std::string& path, std::string& cases) {
  cases += fmt::format("    '{}') words='{}' ;;\n", path, fmt::join(words_of(command), " "));
  for (const CLI::App* below : commands_of(command)) append_case(*below, path + " " + below->get_name(), cases);
}

/// A case of the script for each command below another one, which enters it.
void append_paths(const CLI::App& command, const std::string& path, std::string& cases) {
  for (const CLI::App* below : commands_of(command)) {
    const std::string name = path + " " + below->get_name();
    cases += fmt::format("      '{0}') path='{0}' ;;\n", name);
    append_paths(*below, name, cases);
  }
}

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string upper = app.get_name();
  std::ranges::transform(upper, upper.begin(), [](unsigned char letter) { return std::toupper(letter); });
  std::string page = fmt::format(
      ".TH {} 1\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n\\fB{}\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n"
      "Each command prints its options with \\fB\\-\\-help\\fR. Scene files are described in docs/scenes.md of the "
      "source;\n\\fBtalus reference\\fR prints all their keys.\n.SH COMMANDS\n",
      upper, app.get_name(), roff(replaced(app.get_description(), app.get_name() + ": ", "")), app.get_name());
  for (const CLI::App* command : commands_of(app)) append_command(*command, command->get_name(), page);
  page += ".SH EXIT STATUS\n0 done, 1 the run failed, 2 bad input, 130 interrupted.\n";
  return page;
}

// Words of a command that begin with what is typed; names of scenes after `run`, `check`, `view`, `sweep`; else files.
std::string bash_completion(const CLI::App& app) {
  std::string cases;
  append_case(app, app.get_name(), cases);
  std::string paths;
  append_paths(app, app.get_name(), paths);
  return fmt::format(R"bash(# Completion of {0} for bash, made by `{0} reference --completion bash`.
_{0}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} path={0} words='' word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$path $word" in
{2}    esac
  done
  case $path in
{1}  esac
  case "$path" in '{0} run' | '{0} check' | '{0} view' | '{0} sweep')
    [[ $current == -* ]] || words+=" $({0} list 2>/dev/null | cut -d ' ' -f 1)" ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _{0} {0}
)bash",
                     app.get_name(), cases, paths);
}

std::string zsh_completion(const CLI::App& app) {
  return fmt::format("#compdef {0}\nautoload -U +X bashcompinit && bashcompinit\n{1}", app.get_name(),
                     bash_completion(app));
}

std::string nearest_word(const CLI::App& app, const std::string& word) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> words = words_of(*command);
  std::erase_if(words, [&](const std::string& each) { return each.starts_with('-') != name.starts_with('-'); });
  return nearest_name(name, words);
}

}  // namespace talus
