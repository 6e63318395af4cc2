#include "tools/monitor/heard.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/text/printable.h"

namespace talus {

std::vector<HeardRun> runs_of(const Heard& heard) {
  std::vector<HeardRun> runs;
  for (const auto& [id, entry] : heard.listener.runs().entries()) runs.push_back({.id = id, .entry = &entry});
  std::ranges::stable_sort(runs, {}, [](const HeardRun& run) { return run.entry->entered; });
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].number = static_cast<int>(i) + 1;
  return runs;
}

std::string name_of(const RunView& view) {
  if (!view.run()) return "?";  // until TALUS_RUN comes, which takes a second at most
  return fmt::format("{} {} {}", printable(view.run()->scene), printable(view.run()->backend),
                     printable(view.run()->policy));
}

std::string state_of(const Heard& heard, const HeardRun& run) {
  const RunView& view = run.view();
  if (view.ended()) return fmt::format("ended: {}", printable(view.run()->reason));
  const auto silent = std::chrono::duration_cast<std::chrono::seconds>(heard.now - run.entry->heard);
  return silent >= RunTable::silence ? fmt::format("silent for {} s", silent.count()) : "";
}

std::string count_text(double number, int characters) {
  const char* unit = "";
  for (const char* next : {"k", "M", "G", "T", "P", "E"}) {
    std::string text = fmt::format("{:.0f}{}", number, unit);
    if (std::ssize(text) <= characters) return text;
    number /= 1e3;
    unit = next;
  }
  return fmt::format("{:.0f}{}", number, unit);
}

}  // namespace talus
