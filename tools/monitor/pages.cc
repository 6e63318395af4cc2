#include "tools/monitor/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/policy/frame.h"
#include "common/text/printable.h"
#include "lcmtypes/run_info.h"
#include "lcmtypes/translate.h"
#include "tools/monitor/text_view.h"

namespace talus {

using talus_lcm::talus_layer_v1;
using talus_lcm::talus_pile_v1;
using talus_lcm::talus_run_v1;
using talus_lcm::talus_stats_v2;

namespace {

using Entry = RunTable::Entry;
using Clock = RunTable::Clock;

constexpr int narrowest = 40;  // columns
constexpr int lowest = 8;      // rows
constexpr int two_columns = 72;
constexpr const char* key_line = "q quit  tab run  p pile  f filter  l layers  e events  r runs  a alerts  ? help";

struct Shown {
  std::int64_t id = 0;
  int number = 0;  // from 1, in the order in which the runs came
  const Entry* entry = nullptr;
  const RunView& view() const { return entry->view; }
};

std::vector<Shown> runs_of(const Heard& heard) {
  std::vector<Shown> runs;
  for (const auto& [id, entry] : heard.listener.runs().entries()) runs.push_back({.id = id, .entry = &entry});
  std::ranges::stable_sort(runs, {}, [](const Shown& run) { return run.entry->entered; });
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].number = static_cast<int>(i) + 1;
  return runs;
}

/// Runs are not empty.
const Shown& chosen_of(const std::vector<Shown>& runs, std::int64_t id) {
  const auto found = std::ranges::find(runs, id, &Shown::id);
  return found == runs.end() ? runs.front() : *found;
}

std::string name_of(const RunView& view) {
  if (!view.run()) return "?";
  return fmt::format("{} {} {}", printable(view.run()->scene), printable(view.run()->backend),
                     printable(view.run()->policy));
}

/// A count >= 0 in so many characters: 9999, 123k, 45M.
std::string count_text(double number, int characters = 6) {
  const char* unit = "";
  for (const char* next : {"k", "M", "G", "T", "P", "E"}) {
    std::string text = fmt::format("{:.0f}{}", number, unit);
    if (std::ssize(text) <= characters) return text;
    number /= 1e3;
    unit = next;
  }
  return fmt::format("{:.0f}{}", number, unit);
}

// Filters of events.

struct Filter {
  std::string name;
  bool slept = true;
  bool woke = true;
  std::optional<SleepCause> cause = std::nullopt;

  bool accepts(const SleepEvent& event) const {
    return (event.woke ? woke : slept) && (!cause || event.cause == *cause);
  }
};

/// All, woke, fell asleep, and each cause that occurred.
std::vector<Filter> filters_of(const SleepHistory& history) {
  std::vector<Filter> filters = {{.name = "all"}, {.name = "woke", .slept = false}, {.name = "slept", .woke = false}};
  for (std::size_t number = 0; number < SleepHistory::causes; ++number) {
    const auto cause = static_cast<SleepCause>(number);
    if (history.count({cause, false}) + history.count({cause, true}) > 0)
      filters.push_back({.name = std::string(to_string(cause)), .cause = cause});
  }
  return filters;
}

Filter filter_of(const SleepHistory& history, int number) {
  const auto filters = filters_of(history);
  return filters[static_cast<std::size_t>(number) % filters.size()];
}

// Head.

std::string state_of(const Heard& heard, const Shown& run) {
  const RunView& view = run.view();
  if (view.ended()) return fmt::format("ended: {}", printable(view.run()->reason));
  const auto silent = std::chrono::duration_cast<std::chrono::seconds>(heard.now - run.entry->heard);
  return silent >= RunTable::silence ? fmt::format("silent for {} s", silent.count()) : "";
}

std::string progress_of(const RunView& view) {
  std::string text = fmt::format("step {}", view.step());
  if (view.run() && view.run()->steps > 0) text += fmt::format(" of {}", view.run()->steps);
  text += fmt::format("  {:.2f} s", view.sim_time());
  if (!view.stats()) return text;
  const talus_stats_v2& stats = *view.stats();
  if (stats.timed != 0) text += fmt::format("  {:.2f} x real time", stats.real_time_factor);
  if (stats.planned >= 0) text += fmt::format("  {} of {} bodies", stats.appeared, stats.planned);
  return text;
}

std::string error_of(const RunView& view) {
  if (!view.stats() || view.stats()->drift_estimate < 0.0) return "no estimate of drift";
  return fmt::format("estimated drift {:.2g} D, {:.0f} % checked", view.stats()->drift_estimate,
                     100.0 * view.stats()->checked_share);
}

void draw_head(const Heard& heard, const std::vector<Shown>& runs, const Shown& run, const Choice& choice,
               const Area& area) {
  area.put(0, 0, fmt::format("talus monitor on {}", printable(heard.address)), Style::quiet);
  area.put_right(0, fmt::format("  run {} of {}{}", run.number, runs.size(), choice.held ? ", held" : ""),
                 choice.held ? Style::alert : Style::strong);
  const RunView& view = run.view();
  area.put(1, 0, fmt::format("{} {}", short_id(run.id), name_of(view)), Style::strong);
  area.put_right(1, fmt::format("  {}", state_of(heard, run)), view.ended() ? Style::good : Style::alert);
  area.put(2, 0, progress_of(view));
  const int end = area.put(3, 0, error_of(view));
  if (view.stats()) area.put(3, end, fmt::format("  energy {:.3g} J", view.stats()->kinetic_energy));
  const bool lost = view.lost() > 0;
  area.put_right(3, fmt::format("  lost {}", count_text(static_cast<double>(view.lost()))),
                 lost ? Style::alert : Style::good);
}

// Awake and asleep over time.

/// The sample in force at each column of a graph, by time.
std::vector<CountSample> columns_of(std::span<const CountSample> samples, int columns) {
  std::vector<CountSample> picked;
  if (samples.empty()) return picked;
  const double begin = samples.front().time;
  const double length = samples.back().time - begin;
  std::size_t at = 0;
  for (int column = 0; column < columns; ++column) {
    const double time = begin + length * (column + 1) / columns;
    while (at + 1 < samples.size() && samples[at + 1].time <= time) ++at;
    picked.push_back(samples[at]);
  }
  return picked;
}

/// A column of blocks, `eighths` high.
void put_column(const Area& area, int column, int eighths, Style style) {
  constexpr std::array blocks = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  for (int row = area.rows() - 1; row >= 0 && eighths > 0; --row, eighths -= 8)
    area.put(row, column, blocks[static_cast<std::size_t>(std::min(eighths, 8)) - 1], style);
}

void draw_graph(std::span<const CountSample> samples, std::int64_t CountSample::*what, const char* name, Style style,
                const Area& area) {
  std::int64_t most = 1;
  for (const CountSample& sample : samples) most = std::max({most, sample.*what});
  const int end = area.put(
      0, 0, fmt::format("{} {}", name, samples.empty() ? "?" : fmt::format("{}", samples.back().*what)), style);
  if (samples.empty()) return;
  area.put(0, end, fmt::format(", at most {}, {:.0f} to {:.0f} s", most, samples.front().time, samples.back().time),
           Style::quiet);
  const Area plot = area.lower(1);
  int column = 0;
  for (const CountSample& sample : columns_of(samples, plot.columns())) {
    const double share = static_cast<double>(sample.*what) / static_cast<double>(most);
    const int eighths = sample.*what == 0 ? 0 : std::max(static_cast<int>(std::lround(8.0 * plot.rows() * share)), 1);
    put_column(plot, column++, eighths, style);
  }
}

void draw_counts(const RunView& view, const Area& area) {
  const int half = area.columns() / 2;
  const auto samples = view.counts().samples();
  draw_graph(samples, &CountSample::awake, "awake", Style::awake, area.part(0, 0, area.rows(), half - 1));
  draw_graph(samples, &CountSample::asleep, "asleep", Style::asleep, area.part(0, half, area.rows(), half));
}

// Layers.

/// Neighbouring layers in one row.
struct LayerRow {
  std::size_t first = 0;
  std::size_t last = 0;
  double capacity = 0.0;
  double count = 0.0;
  std::int64_t sleeping = 0;
};

/// Bottom first, at most `rows`.
std::vector<LayerRow> rows_of(std::span<const talus_layer_v1> layers, std::size_t rows) {
  const std::size_t number = std::min(layers.size(), rows);
  std::vector<LayerRow> result;
  for (std::size_t i = 0; i < number; ++i) {
    LayerRow row{.first = i * layers.size() / number, .last = (i + 1) * layers.size() / number - 1};
    for (std::size_t layer = row.first; layer <= row.last; ++layer) {
      row.capacity += layers[layer].capacity;
      row.count += layers[layer].count;
      row.sleeping += layers[layer].sleeping;
    }
    result.push_back(row);
  }
  return result;
}

/// A bar of so many cells for density 1, which a mark shows; longer where there is more.
void put_density_bar(Area area, int row, int column, double density, bool asleep) {
  const int full = area.columns() - column - 2;  // two cells for what is above 1
  if (full < 2) return;
  const int halves = std::clamp(static_cast<int>(std::lround(2.0 * full * density)), 0, 2 * full + 4);
  area.put(row, column + full, "│", Style::quiet);
  const Style style = asleep ? Style::asleep : Style::awake;
  for (int cell = 0; 2 * cell < halves; ++cell)
    area.put(row, column + cell, 2 * cell + 1 < halves ? "█" : "▌", halves > 2 * full ? Style::alert : style);
}

void draw_layer(const LayerRow& row, int number, const Area& area) {
  const std::string name =
      row.first == row.last ? fmt::format("{}", row.first) : fmt::format("{}-{}", row.first, row.last);
  const double density = row.capacity > 0.0 ? row.count / row.capacity : 0.0;
  const auto sleeping = static_cast<double>(row.sleeping);
  const int end = area.put(number, 0,
                           fmt::format("{:>5} {:4.2f} {:>4}/{:<4} {:>5}", name, density, count_text(row.count, 4),
                                       count_text(row.capacity, 4), count_text(sleeping, 5)));
  put_density_bar(area, number, end + 1, density, 2.0 * sleeping >= row.count);
}

/// Without the empty ones on top.
std::span<const talus_layer_v1> filled_layers(const talus_pile_v1& pile) {
  std::span<const talus_layer_v1> layers = pile.layers;
  while (!layers.empty() && layers.back().count == 0) layers = layers.first(layers.size() - 1);
  return layers;
}

std::string heading_of(std::int32_t number, int place, std::size_t piles, const talus_pile_v1& pile) {
  constexpr double degrees = 180.0 / 3.14159265358979323846;
  const std::string among = piles > 1 ? fmt::format(" ({} of {})", place + 1, piles) : "";
  return fmt::format("pile {}{}: {} layers, {:.0f} deg, {:.0f} %", number, among, pile.layer_total,
                     degrees * pile.alpha, 100.0 * pile.occupation_ratio);
}

void draw_layers(const RunView& view, const Choice& choice, const Area& area) {
  if (view.piles().empty()) {
    area.put(0, 0, "no pile yet", Style::quiet);
    return;
  }
  const int place = choice.pile % static_cast<int>(view.piles().size());
  const auto& [pile_number, pile] = *std::next(view.piles().begin(), place);
  area.put(0, 0, heading_of(pile_number, place, view.piles().size(), pile), Style::strong);
  area.put(1, 0, "layer dens.  bodies/cap sleep", Style::quiet);
  const Area list = area.lower(2);
  const auto rows = rows_of(filled_layers(pile), static_cast<std::size_t>(list.rows()));
  int number = static_cast<int>(rows.size());
  for (const LayerRow& row : rows) draw_layer(row, --number, list);
}

// Sleep events.

std::string text_of(const SleepEvent& event) {
  std::string text = fmt::format("{:>7} {:>6} {} {:<12}", event.step, event.body, event.woke ? "woke " : "slept",
                                 to_string(event.cause));
  if (event.score != 0.0) text += fmt::format(" {:.2f}", event.score);
  return text;
}

void draw_events(const RunView& view, const Choice& choice, const Area& area) {
  const Filter filter = filter_of(view.sleep(), choice.filter);
  const int end = area.put(0, 0, fmt::format("events: {}", filter.name), Style::strong);
  area.put(0, end, fmt::format(", slept {}, woke {}", view.slept(), view.woken()), Style::quiet);
  area.put(1, 0, "   step   body event cause       score", Style::quiet);
  const Area list = area.lower(2);
  const auto accept = [&](const SleepEvent& event) { return filter.accepts(event); };
  const auto most = static_cast<std::size_t>(std::max(list.rows() + choice.first_row, 0));
  const auto events = view.sleep().newest(most, accept);
  const int first = std::clamp(choice.first_row, 0, std::max(static_cast<int>(events.size()) - 1, 0));
  for (int row = 0; first + row < static_cast<int>(events.size()); ++row) {
    const SleepEvent& event = events[first + row];
    list.put(row, 0, text_of(event), event.woke ? Style::awake : Style::asleep);
  }
}

/// Number of events of each cause.
void draw_causes(const RunView& view, const Area& area) {
  area.put(0, 0, "cause           slept     woke", Style::quiet);
  int row = 1;
  for (std::size_t number = 0; number < SleepHistory::causes; ++number) {
    const auto cause = static_cast<SleepCause>(number);
    const std::int64_t slept = view.sleep().count({cause, false});
    const std::int64_t woke = view.sleep().count({cause, true});
    if (slept + woke > 0) area.put(row++, 0, fmt::format("{:<12} {:>8} {:>8}", to_string(cause), slept, woke));
  }
}

// Time per phase, and channels.

PhaseTimes times_of(const talus_stats_v2& stats) {
  return {.emit = stats.ms_emit,
          .step = stats.ms_step,
          .collide = stats.ms_collide,
          .solve = stats.ms_solve,
          .read = stats.ms_read,
          .count = stats.ms_count,
          .decide = stats.ms_decide,
          .apply = stats.ms_apply,
          .observe = stats.ms_observe};
}

void draw_phases(const RunView& view, const Area& area) {
  if (!view.stats() || view.stats()->timed == 0) {
    area.put(0, 0, "ms per step: not measured", Style::strong);
    return;
  }
  const PhaseTimes times = times_of(*view.stats());
  area.put(0, 0, fmt::format("ms per step: {:.3g}", times.total()), Style::strong);
  int place = 0;
  const int rows = 5;
  for (const Phase& phase : all_phases) {
    const bool part = phase.meaning.starts_with("of it");
    area.put(1 + place % rows, place / rows * 19,
             fmt::format("{}{:<{}} {:>7.3f}", part ? " " : "", phase.name, part ? 8 : 9, times.*phase.time));
    ++place;
  }
}

void draw_channels(const Heard& heard, const Shown& run, const Area& area) {
  area.put(0, 0, "channel         /s   kB/s   lost   bad", Style::strong);
  int row = 1;
  for (const Channel channel : heard_channels) {
    const RateMeter::Rate rate = run.entry->rates[static_cast<std::size_t>(channel)].rate(heard.now);
    const std::int64_t lost = run.view().lost(channel);
    const std::int64_t bad = heard.listener.undecodable(channel);
    area.put(row, 0, fmt::format("{:<12} {:>5.1f} {:>6.1f}", talus::name_of(channel), rate.messages, rate.bytes / 1e3));
    area.put(row, 25, fmt::format("{:>6}", count_text(static_cast<double>(lost))),
             lost > 0 ? Style::alert : Style::good);
    area.put(row, 32, fmt::format("{:>5}", count_text(static_cast<double>(bad), 5)),
             bad > 0 ? Style::alert : Style::good);
    ++row;
  }
}

// Alerts.

bool is_recent(const Wave& wave, const RunView& view) {
  constexpr double recent = 10.0;  // [s] simulated
  return view.run() && static_cast<double>(view.step() - wave.step) * view.run()->dt <= recent;
}

void add_alerts(const Heard& heard, const Shown& run, std::vector<std::string>& alerts) {
  const RunView& view = run.view();
  const std::string who = short_id(run.id);
  if (view.stats()) {
    for (const Warning& warning : warnings_of(*view.stats()))
      alerts.push_back(fmt::format("{}: warning: {}", who, account(warning)));
    if (view.stats()->dropped > 0)
      alerts.push_back(fmt::format("{}: the sender dropped {} messages", who, view.stats()->dropped));
  }
  if (view.lost() > 0) {
    alerts.push_back(fmt::format("{}: {} of {} messages lost; cure: sysctl -w net.core.rmem_max=4194304", who,
                                 view.lost(), sum_of_counts(view.lost(), view.received())));
  }
  if (const Wave& wave = view.sleep().wave(); wave.bodies > 0 && is_recent(wave, view)) {
    alerts.push_back(
        fmt::format("{}: {} bodies woke in step {}: {}", who, wave.bodies, wave.step, to_string(wave.cause)));
  }
  if (const std::string state = state_of(heard, run); state.starts_with("silent"))
    alerts.push_back(fmt::format("{}: {}", who, state));
}

void draw_list(const std::vector<std::string>& lines, int first, Style style, const Area& area) {
  for (int row = 0; row < area.rows() && first + row < static_cast<int>(lines.size()); ++row)
    area.put(row, 0, lines[first + row], style);
}

void draw_first_alert(const std::vector<std::string>& alerts, const Area& area) {
  if (alerts.empty()) return;
  const std::string more = alerts.size() > 1 ? fmt::format("  a: {} more", alerts.size() - 1) : "";
  area.put(0, 0, "! " + alerts.front(), Style::alert);
  area.put_right(0, more, Style::alert);
}

// Pages.

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

void draw_overview(const Heard& heard, const Shown& run, const Choice& choice, const Area& area) {
  constexpr int low = 7;  // rows of phases and channels
  const int graph = std::clamp(area.rows() / 5, 2, 8);
  const bool has_low = area.rows() >= graph + 5 + low;
  draw_counts(run.view(), area.upper(graph));
  const int middle = area.rows() - graph - (has_low ? low : 0);
  const Halves upper = halves_of(area.part(graph, 0, middle, area.columns()));
  draw_layers(run.view(), choice, upper.left);
  draw_events(run.view(), choice, upper.right);
  if (!has_low) return;
  const Halves lower = halves_of(area.lower(graph + middle));
  draw_phases(run.view(), lower.left);
  draw_channels(heard, run, lower.right);
}

std::string drift_text(const RunView& view) {
  return view.stats() && view.stats()->drift_estimate >= 0.0 ? fmt::format("{:.2g}", view.stats()->drift_estimate)
                                                             : "-";
}

void draw_runs(const Heard& heard, const std::vector<Shown>& runs, const Shown& chosen, int first, const Area& area) {
  area.put(0, 0, " key  time s  awake asleep x real  drift  lost  policy, backend, scene", Style::quiet);
  const Area list = area.lower(1);
  for (const Shown& run : runs) {
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
       "e           sleep events, and how many of each cause",
       "f           filter of events: all, woke, slept, then each cause", "a           all alerts",
       "up, down    scroll a list", "space       hold the screen; the monitor goes on listening",
       "escape      back to the overview", "",
       "A bar of a layer is its density: bodies over capacity, | marks 1. It has the",
       "colour of sleeping bodies where at least half of its bodies sleep.",
       "lost: messages that this monitor missed; bad: those that it could not decode."},
      0, Style::plain, area);
}

void draw_page(const Heard& heard, const std::vector<Shown>& runs, const Choice& choice, const Area& area) {
  const Shown& run = chosen_of(runs, choice.run);
  switch (choice.page) {
    case Page::overview:
      return draw_overview(heard, run, choice, area);
    case Page::layers:
      return draw_layers(run.view(), choice, area);
    case Page::events: {
      const Halves halves = halves_of(area);
      draw_events(run.view(), choice, halves.left);
      return draw_causes(run.view(), halves.right);
    }
    case Page::runs:
      return draw_runs(heard, runs, run, choice.first_row, area);
    case Page::alerts:
      return draw_list(alerts_of(heard), choice.first_row, Style::alert, area);
    case Page::help:
      return draw_help(area);
  }
}

void draw_waiting(const Heard& heard, const Area& area) {
  area.put(0, 0, "talus monitor", Style::strong);
  area.put(2, 0, fmt::format("waiting on {}", printable(heard.address)));
  area.put(3, 0, "Start a run in another terminal: talus run drop_in_a_pile_2d --pace 1", Style::quiet);
  draw_list(alerts_of(heard), 0, Style::alert, area.lower(5));
  area.put(area.rows() - 1, 0, "q quit", Style::quiet);
}

void toggle(Page page, Choice& choice) {
  choice.page = choice.page == page ? Page::overview : page;
  choice.first_row = 0;
}

void choose_run(const std::vector<Shown>& runs, std::size_t place, Choice& choice) {
  choice.run = runs[place % runs.size()].id;
  choice.pile = 0;
  choice.first_row = 0;
}

void obey_choice(int key, const std::vector<Shown>& runs, Choice& choice) {
  const Shown& run = chosen_of(runs, choice.run);
  if (key == '\t' || key == 'n') choose_run(runs, static_cast<std::size_t>(run.number), choice);
  if (key >= '1' && key <= '9' && key - '1' < static_cast<int>(runs.size()))
    choose_run(runs, static_cast<std::size_t>(key - '1'), choice);
  const auto piles = static_cast<int>(run.view().piles().size());
  if (key == 'p' && piles > 0) choice.pile = (choice.pile + 1) % piles;
  const auto filters = static_cast<int>(filters_of(run.view().sleep()).size());
  if (key == 'f') choice.filter = (choice.filter + 1) % filters;
}

}  // namespace

std::vector<std::string> alerts_of(const Heard& heard) {
  std::vector<std::string> alerts;
  for (const Shown& run : runs_of(heard)) add_alerts(heard, run, alerts);
  if (!heard.faults.none()) alerts.push_back(text_line(heard.faults));
  return alerts;
}

Effect obey(int key, const Heard& heard, Choice& choice) {
  constexpr std::array<std::pair<int, Page>, 5> pages = {
      {{'l', Page::layers}, {'e', Page::events}, {'r', Page::runs}, {'a', Page::alerts}, {'?', Page::help}}};
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
