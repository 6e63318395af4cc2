#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "common/policy/sleep_event.h"
#include "tools/monitor/panels.h"

namespace talus {
namespace {

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

std::string text_of(const SleepEvent& event) {
  std::string text = fmt::format("{:>7} {:>6} {} {:<12}", event.step, event.body, event.woke ? "woke " : "slept",
                                 to_string(event.cause));
  if (event.score != 0.0) text += fmt::format(" {:.2f}", event.score);
  return text;
}

}  // namespace

int event_filters(const RunView& view) { return static_cast<int>(filters_of(view.sleep()).size()); }

void draw_events(const RunView& view, int filter, int first, const Area& area) {
  const Filter passing = filter_of(view.sleep(), filter);
  const int end = area.put(0, 0, fmt::format("events: {}", passing.name), Style::strong);
  area.put(0, end, fmt::format(", slept {}, woke {}", view.reader().slept(), view.reader().woken()), Style::quiet);
  area.put(1, 0, "   step   body event cause       score", Style::quiet);
  const Area list = area.lower(2);
  const auto accept = [&](const SleepEvent& event) { return passing.accepts(event); };
  const auto most = static_cast<std::size_t>(std::max(list.rows() + first, 0));
  const auto events = view.sleep().newest(most, accept);
  const int top = std::clamp(first, 0, std::max(static_cast<int>(events.size()) - 1, 0));
  for (int row = 0; top + row < static_cast<int>(events.size()); ++row) {
    const SleepEvent& event = events[top + row];
    list.put(row, 0, text_of(event), event.woke ? Style::awake : Style::asleep);
  }
}

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

}  // namespace talus
