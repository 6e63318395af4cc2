#include "tools/commands/command_line_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>
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

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// What a value of an option may be.
struct ValueKind {
  std::string word;    // as NUMBER
  std::string limits;  // as "1 to 64"; empty: none
};

/// From what CLI11 and validators.h say, as "INT:1 to 64" or "TEXT:{a,b}".
ValueKind kind_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = std::min(type.find(':'), type.size());
  ValueKind kind = {type.substr(0, colon), colon < type.size() ? type.substr(colon + 1) : ""};
  if (kind.word == "INT" || kind.word == "UINT" || kind.word == "FLOAT") kind.word = "NUMBER";
  if (kind.limits.starts_with('{')) {
    constexpr std::size_t longest_word = 20;
    const std::string values = kind.limits.substr(1, kind.limits.size() - 2);
    const bool is_short = values.size() <= longest_word;
    if (is_short) kind.word = replaced(values, ",", "|");
    kind.limits = is_short ? "" : "one of " + replaced(values, ",", ", ");
  } else if (kind.limits.find("DIR") != std::string::npos) {
    kind = {"FOLDER", ""};
  }
  return kind;
}

/// What an option does, with all that holds for it in brackets.
std::string meaning_of(const CLI::Option& option) {
  std::vector<std::string> notes;
  const auto note_others = [&](const char* word, const std::set<CLI::Option*>& others) {
    std::vector<std::string> names;
    for (const CLI::Option* other : others) names.push_back(names_of(*other).back());
    std::ranges::sort(names);
    if (!names.empty()) notes.push_back(fmt::format("{} {}", word, fmt::join(names, " or ")));
  };
  if (takes_value(option)) {
    if (const std::string limits = kind_of(option).limits; !limits.empty()) notes.push_back(limits);
    if (!option.get_default_str().empty()) notes.push_back("default " + option.get_default_str());
  }
  if (option.get_required() && !option.get_positional()) notes.emplace_back("must be given");
  note_others("with", option.get_needs());
  note_others("not with", option.get_excludes());
  if (notes.empty()) return option.get_description();
  return fmt::format("{} ({})", option.get_description(), fmt::join(notes, "; "));
}

std::vector<std::string> words_of(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::App* command : commands_of(app)) words.push_back(command->get_name());
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : names_of(*option)) words.push_back(name);
  return words;
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
  if (head.empty())
    head = fmt::format("\\fI{}\\fR", roff(option.get_name(true)));
  else if (takes_value(option))
    head += fmt::format(" \\fI{}\\fR", roff(kind_of(option).word));
  const std::string group = option.get_group() == "Options" ? "" : option.get_group() + ": ";
  return fmt::format(".TP\n{}\n{}\n", head, roff(group + meaning_of(option)));
}

std::string command_text(const CLI::App& command) {
  std::string page = fmt::format(".SS {}\n{}\n", roff(command.get_name()), roff(command.get_description()));
  for (const CLI::Option* option : command.get_options())
    if (option->get_name() != "--help") page += option_text(*option);
  if (const std::string footer = command.get_footer(); !footer.empty())
    page += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(footer));
  return page;
}

}  // namespace

std::string PlainHelp::make_option_name(const CLI::Option* option, bool is_positional) const {
  return is_positional ? option->get_name(true) : fmt::format("{}", fmt::join(names_of(*option), ", "));
}

std::string PlainHelp::make_option_opts(const CLI::Option* option) const {
  return takes_value(*option) && !option->get_positional() ? " " + kind_of(*option).word : "";
}

std::string PlainHelp::make_option_desc(const CLI::Option* option) const { return meaning_of(*option); }

std::string man_page(const CLI::App& app) {
  std::string upper = app.get_name();
  std::ranges::transform(upper, upper.begin(), [](unsigned char letter) { return std::toupper(letter); });
  std::string page = fmt::format(
      ".TH {} 1\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n\\fB{}\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n"
      "Each command prints its options with \\fB\\-\\-help\\fR. Scene files are described in docs/scenes.md of the "
      "source;\n\\fBtalus reference\\fR prints all their keys.\n.SH COMMANDS\n",
      upper, app.get_name(), roff(replaced(app.get_description(), app.get_name() + ": ", "")), app.get_name());
  for (const CLI::App* command : commands_of(app)) page += command_text(*command);
  page += ".SH EXIT STATUS\n0 done, 1 the run failed, 2 bad input, 130 interrupted.\n";
  return page;
}

// Words of a command that begin with what is typed; names of scenes after `run`, `check`, `view`, `sweep`; else files.
std::string bash_completion(const CLI::App& app) {
  std::string cases;
  for (const CLI::App* command : commands_of(app))
    cases += fmt::format("    {}) words='{}' ;;\n", command->get_name(), fmt::join(words_of(*command), " "));
  return fmt::format(R"bash(# Completion of {0} for bash, made by `{0} reference --completion bash`.
_{0}() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} words='{1}' command=''
  ((COMP_CWORD == 1)) || command=${{COMP_WORDS[1]}}
  case $command in
{2}  esac
  case $command in run | check | view | sweep)
    [[ $current == -* ]] || words+=" $({0} list 2>/dev/null | cut -d ' ' -f 1)" ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
}}
complete -o default -F _{0} {0}
)bash",
                     app.get_name(), fmt::join(words_of(app), " "), cases);
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
