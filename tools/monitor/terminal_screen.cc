#include "tools/monitor/terminal_screen.h"

#define NCURSES_NOMACROS 1
#define NCURSES_WIDECHAR 1
#include <fcntl.h>
#include <langinfo.h>
#include <ncurses.h>
#include <unistd.h>

#include <array>
#include <clocale>
#include <cstdlib>
#include <string_view>

#include "tools/monitor/pages.h"

namespace talus {
namespace {

/// What stands for a character in a terminal of ASCII.
wchar_t ascii_for(char32_t character) {
  if (character < 0x80) return static_cast<wchar_t>(character);
  if (character == U'│') return L'|';
  if (character == U'▌') return L'=';
  if (character >= U'▁' && character <= U'█') return L"__..==##"[character - U'▁'];
  return L'?';
}

struct Appearance {
  Style style;
  short colour;         // of curses; -1: the terminal's own
  attr_t with_colours;  // attributes
  attr_t without_colours;
};

constexpr std::array<Appearance, 7> appearances = {{{Style::plain, -1, A_NORMAL, A_NORMAL},
                                                    {Style::quiet, -1, A_DIM, A_NORMAL},
                                                    {Style::strong, -1, A_BOLD, A_BOLD},
                                                    {Style::awake, COLOR_YELLOW, A_NORMAL, A_NORMAL},
                                                    {Style::asleep, COLOR_CYAN, A_NORMAL, A_NORMAL},
                                                    {Style::good, COLOR_GREEN, A_NORMAL, A_NORMAL},
                                                    {Style::alert, COLOR_RED, A_BOLD, A_REVERSE}}};

bool wants_colours() {
  const char* no_color = std::getenv("NO_COLOR");
  return no_color == nullptr || *no_color == '\0';
}

}  // namespace

struct TerminalScreen::State {
  SCREEN* screen = nullptr;
  bool colours = false;
  bool utf8 = false;
  int standard_error = -1;  // a copy, while messages would garble the screen
};

std::unique_ptr<TerminalScreen> TerminalScreen::open() {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0) return nullptr;
  const char* kind = std::getenv("TERM");
  if (kind == nullptr || *kind == '\0' || std::string_view(kind) == "dumb") return nullptr;
  std::unique_ptr<TerminalScreen> screen(new TerminalScreen);
  return screen->state_->screen != nullptr ? std::move(screen) : nullptr;
}

TerminalScreen::TerminalScreen() : state_(std::make_unique<State>()) {
  std::setlocale(LC_CTYPE, "");  // numbers stay as they are
  state_->utf8 = std::string_view(nl_langinfo(CODESET)) == "UTF-8";
  state_->screen = newterm(nullptr, stdout, stdin);
  if (state_->screen == nullptr) return;
  cbreak();
  noecho();
  nonl();
  keypad(stdscr, true);
  nodelay(stdscr, true);
  set_escdelay(25);  // [ms]: how long an escape waits for the rest of a key
  curs_set(0);
  if (has_colors() && wants_colours() && start_color() == OK && use_default_colors() == OK) {
    state_->colours = true;
    for (const Appearance& each : appearances)
      init_pair(static_cast<short>(static_cast<int>(each.style) + 1), each.colour, -1);
  }
  state_->standard_error = dup(STDERR_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

TerminalScreen::~TerminalScreen() {
  if (state_->screen == nullptr) return;
  endwin();
  delscreen(state_->screen);
  dup2(state_->standard_error, STDERR_FILENO);
  close(state_->standard_error);
}

int TerminalScreen::rows() { return getmaxy(stdscr); }

int TerminalScreen::columns() { return getmaxx(stdscr); }

void TerminalScreen::show(const Sheet& sheet) {
  werase(stdscr);
  for (int row = 0; row < sheet.rows(); ++row) {
    for (int column = 0; column < sheet.columns(); ++column) {
      const Sheet::Cell& cell = sheet.at(row, column);
      if (cell.character == U' ') continue;
      const wchar_t text[] = {state_->utf8 ? static_cast<wchar_t>(cell.character) : ascii_for(cell.character), L'\0'};
      const Appearance& appearance = appearances[static_cast<std::size_t>(cell.style)];
      const auto pair = static_cast<short>(state_->colours ? static_cast<int>(cell.style) + 1 : 0);
      cchar_t glyph;
      setcchar(&glyph, text, state_->colours ? appearance.with_colours : appearance.without_colours, pair, nullptr);
      mvwadd_wch(stdscr, row, column, &glyph);
    }
  }
  wrefresh(stdscr);
}

int TerminalScreen::key() {
  switch (const int key = wgetch(stdscr)) {
    case ERR:
      return no_key;
    case KEY_RESIZE:
      return resized;
    case KEY_UP:
      return keys::up;
    case KEY_DOWN:
      return keys::down;
    default:
      return key;
  }
}

}  // namespace talus
