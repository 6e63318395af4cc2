#include "tools/monitor/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/text/printable.h"
#include "lcmtypes/run_info.h"
#include "tools/monitor/panels.h"

namespace talus {

using talus_lcm::talus_stats;

namespace {

constexpr int narrowest = 40;  // columns
constexpr int lowest = 8;      // rows
constexpr int two_columns = 72;
constexpr const char* key_line = "q quit  tab run  p pile  f filter  l layers  e events  r runs  a alerts  ? help";

/// Runs are not empty.
const HeardRun& chosen_of(const std::vector<HeardRun>& runs, std::int64_t id) {
  const auto found = std::ranges::find(runs, id, &HeardRun::id);
  return found == runs.end() ? runs.front() : *found;
}

std::string progress_of(const RunView& view) {
  std::string text = fmt::format("step {}", view.step());
  if (view.run() && view.run()->steps > 0) text += fmt::format(" of {}", view.run()->steps);
  text += fmt::format("  {:.2f} s", view.sim_time());
  if (!view.stats()) return text;
  const talus_stats& stats = *view.stats();
  if (stats.timed != 0) text += fmt::format("  {:.2f} x real time", stats.real_time_factor);
  text += fmt::format("  {} of {} bodies", stats.appeared, stats.planned);
  return text;
}

std::string error_of(const RunView& view) {
  if (!view.stats() || view.stats()->drift_estimate < 0.0) return "no estimate of drift";
  return fmt::format("estimated drift {:.2g} D, {:.0f} % checked", view.stats()->drift_estimate,
                     100.0 * view.stats()->checked_share);
}

void draw_head(const Heard& heard, const std::vector<HeardRun>& runs, const HeardRun& run, const Choice& choice,
               const Area& area) {
  area.put(0, 0, fmt::format("talus monitor on {}", printable(heard.address)), Style::quiet);
  area.put_right(0, fmt::format("  run {} of {}{}", run.number, runs.size(), choice.held ? ", held" : ""),
                 choice.held ? Style::alert : Style::strong);
  const RunView& view = run.view();
  area.put(1, 0, fmt::format("{} {}", short_id(run.id), name_of(view)), Style::strong);
  area.put_right(1, fmt::format("  {}", state_of(heard, run)), view.ended() ? Style::good : Style::alert);
  area.put(2, 0, progress_of(view));
  const int end = area.put(3, 0, error_of(view));
  if (view.stats())
    area.put(3, end,
             fmt::format("  overlap {:.2g} D  energy {:.3g} J", view.stats()->overlap, view.stats()->kinetic_energy));
  const bool lost = view.lost() > 0;
  area.put_right(3, fmt::format("  lost {}", count_text(static_cast<double>(view.lost()))),
                 lost ? Style::alert : Style::good);
}

void draw_list(const std::vector<std::string>& lines, int first, Style style, const Area& area) {
  for (int row = 0; row < area.rows() && first + row < static_cast<int>(lines.size()); ++row)
    area.put(row, 0, lines[first + row], style);
}

/// Cut at spaces where a line is too long for the screen.
std::vector<std::string> wrapped(const std::vector<std::string>& lines, int columns) {
  const std::string indent = "  ";
  std::vector<std::string> result;
  for (std::string line : lines) {
    while (std::ssize(line) > columns) {
      const std::size_t space = line.rfind(' ', columns);
      if (space == std::string::npos || space < indent.size()) break;
      result.push_back(line.substr(0, space));
      line = indent + line.substr(space + 1);
    }
    result.push_back(std::move(line));
  }
  return result;
}

void draw_first_alert(const std::vector<std::string>& alerts, const Area& area) {
  if (alerts.empty()) return;
  const std::string more = alerts.size() > 1 ? fmt::format("  a: {} more", alerts.size() - 1) : "";
  area.put(0, 0, "! " + alerts.front(), Style::alert);
  area.put_right(0, more, Style::alert);
}

/// Side by side where the terminal is wide enough, else only the left one.
struct Halves {
  Area left;
  Area right;
};

Halves halves_of(const Area& area) {
  if (area.columns() < two_columns) return {area, area.part(0, 0, 0, 0)};
  const int half = area.columns() / 2;
  return {area.part(0, 0, area.rows(), half - 1), area.part(0, half, area.rows(), area.columns() - half)};
}

/// Beside the events, or where the layers of a pile would be.
void draw_lists(const RunView& view, const Choice& choice, const Area& area) {
  const auto [left, right] = halves_of(area);
  const int rows = std::min(instrument_rows(view), area.rows() / 2);
  const bool on_the_left = rows > 0 && view.piles().empty();
  if (on_the_left)
    draw_instruments(view, 0, left);
  else
    draw_layers(view, choice.pile, left);
  if (rows > 0 && !on_the_left) draw_instruments(view, 0, right.upper(rows));
  draw_events(view, choice.filter, choice.first_row, on_the_left ? right : right.lower(rows));
}

void draw_overview(const Heard& heard, const HeardRun& run, const Choice& choice, const Area& area) {
  const int low = 1 + static_cast<int>(channels_of(run.view()).size());  // rows of phases and channels
  const int graph = std::clamp(area.rows() / 5, 2, 8);
  const bool has_low = area.rows() >= graph + 5 + low;
  draw_counts(run.view(), area.upper(graph));
  const int middle = area.rows() - graph - (has_low ? low : 0);
  draw_lists(run.view(), choice, area.part(graph, 0, middle, area.columns()));
  if (!has_low) return;
  const Halves lower = halves_of(area.lower(graph + middle));
  draw_phases(run.view(), lower.left);
  draw_channels(heard, run, lower.right);
}

std::string drift_text(const RunView& view) {
  return view.stats() && view.stats()->drift_estimate >= 0.0 ? fmt::format("{:.2g}", view.stats()->drift_estimate)
                                                             : "-";
}

void draw_runs(const Heard& heard, const std::vector<HeardRun>& runs, const HeardRun& chosen, int first,
               const Area& area) {
  area.put(0, 0, " key  time s  awake asleep x real  drift  lost  policy, backend, scene", Style::quiet);
  const Area list = area.lower(1);
  for (const HeardRun& run : runs) {
    const RunView& view = run.view();
    const int row = run.number - 1 - first;
    if (row < 0) continue;
    std::string text = fmt::format("{:>4} {:>7.1f}", run.number, view.sim_time());
    if (view.stats()) {
      text += fmt::format(" {:>6} {:>6} {:>6.1f}", view.stats()->awake, view.stats()->asleep,
                          view.stats()->real_time_factor);
    } else {
      text += fmt::format("{:>21}", "");
    }
    text += fmt::format(" {:>6} {:>5}  {} {}  {}", drift_text(view), count_text(static_cast<double>(view.lost())),
                        view.run() ? printable(view.run()->policy) : short_id(run.id),
                        view.run() ? printable(view.run()->backend) + " " + printable(view.run()->scene) : "",
                        state_of(heard, run));
    list.put(row, 0, text, run.id == chosen.id ? Style::strong : view.ended() ? Style::quiet : Style::plain);
  }
}

void draw_help(const Area& area) {
  draw_list(
      {"q, Ctrl-C   quit", "tab, n      next run; 1 to 9: run of that number", "r           all runs side by side",
       "p           next pile of the run", "l           layers of the pile, one a row where they fit",
       "e           sleep events, and how many of each cause", "i           gates, regions and loads of the scene",
       "f           filter of events: all, woke, slept, then each cause", "a           all alerts",
       "up, down    scroll a list", "space       hold the screen; the monitor goes on listening",
       "escape      back to the overview", "",
       "A bar of a layer is its density: bodies over capacity. | marks the density above",
       "which the pile wakes, under other policies than paper 1. A bar has the colour of",
       "sleeping bodies where at least half of its bodies sleep.",
       "lost: messages that this monitor missed; bad: those that it could not decode."},
      0, Style::plain, area);
}

void draw_page(const Heard& heard, const std::vector<HeardRun>& runs, const Choice& choice, const Area& area) {
  const HeardRun& run = chosen_of(runs, choice.run);
  switch (choice.page) {
    case Page::overview:
      return draw_overview(heard, run, choice, area);
    case Page::layers:
      return draw_layers(run.view(), choice.pile, area);
    case Page::events: {
      const Halves halves = halves_of(area);
      draw_events(run.view(), choice.filter, choice.first_row, halves.left);
      return draw_causes(run.view(), halves.right);
    }
    case Page::instruments:
      return draw_instruments(run.view(), choice.first_row, area);
    case Page::runs:
      return draw_runs(heard, runs, run, choice.first_row, area);
    case Page::alerts:
      return draw_list(wrapped(alerts_of(heard), area.columns()), choice.first_row, Style::alert, area);
    case Page::help:
      return draw_help(area);
  }
}

void draw_waiting(const Heard& heard, const Area& area) {
  area.put(0, 0, "talus monitor", Style::strong);
  area.put(2, 0, fmt::format("waiting on {}", printable(heard.address)));
  area.put(3, 0, "Start a run in another terminal: talus run drop_in_a_pile_2d --pace 1", Style::quiet);
  draw_list(wrapped(alerts_of(heard), area.columns()), 0, Style::alert, area.lower(5));
  area.put(area.rows() - 1, 0, "q quit", Style::quiet);
}

void toggle(Page page, Choice& choice) {
  choice.page = choice.page == page ? Page::overview : page;
  choice.first_row = 0;
}

void choose_run(const std::vector<HeardRun>& runs, std::size_t place, Choice& choice) {
  choice.run = runs[place % runs.size()].id;
  choice.pile = 0;
  choice.first_row = 0;
}

void obey_choice(int key, const std::vector<HeardRun>& runs, Choice& choice) {
  const HeardRun& run = chosen_of(runs, choice.run);
  if (key == '\t' || key == 'n') choose_run(runs, static_cast<std::size_t>(run.number), choice);
  if (key >= '1' && key <= '9' && key - '1' < static_cast<int>(runs.size()))
    choose_run(runs, static_cast<std::size_t>(key - '1'), choice);
  const auto piles = static_cast<int>(run.view().piles().size());
  if (key == 'p' && piles > 0) choice.pile = (choice.pile + 1) % piles;
  if (key == 'f') choice.filter = (choice.filter + 1) % event_filters(run.view());
}

}  // namespace

Effect obey(int key, const Heard& heard, Choice& choice) {
  constexpr std::array<std::pair<int, Page>, 6> pages = {{{'l', Page::layers},
                                                          {'e', Page::events},
                                                          {'i', Page::instruments},
                                                          {'r', Page::runs},
                                                          {'a', Page::alerts},
                                                          {'?', Page::help}}};
  if (key == 'q') return Effect::quit;
  if (key == ' ') choice.held = !choice.held;
  if (key == keys::escape) toggle(Page::overview, choice);
  if (key == keys::down) ++choice.first_row;
  if (key == keys::up) choice.first_row = std::max(choice.first_row - 1, 0);
  for (const auto& [letter, page] : pages)
    if (key == letter) toggle(page, choice);
  if (const auto runs = runs_of(heard); !runs.empty()) obey_choice(key, runs, choice);
  return Effect::redraw;
}

void draw(const Heard& heard, const Choice& choice, Sheet& sheet) {
  const Area area(sheet);
  const auto runs = runs_of(heard);
  if (area.columns() < narrowest || area.rows() < lowest) {
    area.upper(1).put(0, 0, fmt::format("talus monitor needs {} x {} characters", narrowest, lowest));
  } else if (runs.empty() && choice.page != Page::help) {
    draw_waiting(heard, area);
  } else if (runs.empty()) {
    draw_help(area);
  } else {
    const int last = area.rows() - 1;
    draw_head(heard, runs, chosen_of(runs, choice.run), choice, area.upper(4));
    draw_page(heard, runs, choice, area.part(4, 0, last - 5, area.columns()));
    draw_first_alert(alerts_of(heard), area.part(last - 1, 0, 1, area.columns()));
    area.part(last, 0, 1, area.columns()).put(0, 0, key_line, Style::quiet);
  }
}

}  // namespace talus
