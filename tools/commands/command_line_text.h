#pragma once
// What follows from the declaration of the command line: manual page, completions, and the option or command that was
// most likely meant.

#include <CLI/CLI.hpp>
#include <string>

namespace talus {

/// Help in plain words: kinds of values as TEXT and NUMBER, and behind each description the values that may be given,
/// the default, and what must or must not stand beside it.
class PlainHelp final : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override;
  std::string make_option_opts(const CLI::Option* option) const override;
  std::string make_option_desc(const CLI::Option* option) const override;
};

/// The manual page of the command with all its sub-commands, in the macros of man(7).
std::string man_page(const CLI::App& app);

/// A script that completes commands, options, and the names of scenes for bash.
std::string bash_completion(const CLI::App& app);
/// The same for zsh, to be installed as _talus.
std::string zsh_completion(const CLI::App& app);

/// The option or sub-command that was most likely meant by `word`, of the sub-command that was given, else of `app`;
/// empty if none is near.
std::string nearest_word(const CLI::App& app, const std::string& word);

}  // namespace talus
