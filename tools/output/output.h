#pragma once
// What the sub-commands print, and how they end. Results go to standard output: one that cannot be written is an error.
// Warnings, errors and progress go to standard error: one that cannot be written is lost, and changes nothing else.

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace talus {
namespace exit_codes {
inline constexpr int success = 0;
inline constexpr int failed = 1;         // the run itself went wrong; all that was recorded is kept
inline constexpr int bad_input = 2;      // a scene, option or file is not as it should be
inline constexpr int interrupted = 130;  // Ctrl-C; all is saved
}  // namespace exit_codes

/// At the start of the program. Reserves the descriptors 0 to 2 where they are closed, so that no file of a run gets
/// the number of a standard stream; a write to such a descriptor fails. A pipe without a reader and
/// a file at the limit of its size become failed writes.
void prepare_output();

/// Text on standard output, buffered as by the C library. Throws std::system_error when it cannot be written.
void print_text(std::string_view text);

template <class... Values>
void print_result(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}

/// Writes what is buffered. Throws std::system_error when any result so far could not be written.
void flush_results();

/// Text on standard error as it is, for progress lines that steer a terminal. Never fails.
void write_note(std::string_view text) noexcept;

/// A line on standard error, printable: a file or a command line may hold control characters.
void write_message(std::string_view line);

template <class... Values>
void print_message(fmt::format_string<Values...> format, Values&&... values) {
  write_message(fmt::format(format, std::forward<Values>(values)...));
}

/// Columns of the terminal behind a file descriptor; 80 where it is unknown.
int terminal_width(int file_descriptor);

}  // namespace talus
