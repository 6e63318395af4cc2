#include "tools/monitor/text_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/text/printable.h"
#include "lcmtypes/run_info.h"
#include "tools/monitor/heard.h"

namespace talus {

namespace {

constexpr std::array blocks = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::size_t max_blocks = 24;
constexpr std::size_t max_bars = 4;

const char* block(double density) {
  if (!(density > 0.0)) return blocks.front();
  const auto top = static_cast<double>(blocks.size() - 1);
  return blocks[static_cast<std::size_t>(std::clamp(std::round(density * top), 1.0, top))];
}

std::string bars(const RunView& view) {
  const std::vector<RunView::NumberedPile> piles = view.piles();
  std::string text;
  for (std::size_t i = 0; i < std::min(piles.size(), max_bars); ++i) {
    const std::vector<Layer>& layers = piles[i].pile->layers;
    text += fmt::format(" [{}] {} {}", density_bar(layers), layers.size(), layers.size() == 1 ? "layer" : "layers");
  }
  if (piles.size() > max_bars) text += fmt::format(" and {} piles more", piles.size() - max_bars);
  return text.empty() ? " no pile yet" : text;
}

}  // namespace

std::string density_bar(std::span<const Layer> layers) {
  const std::size_t number = std::min(layers.size(), max_blocks);
  std::string text;
  for (std::size_t i = 0; i < number; ++i) {
    const std::size_t begin = i * layers.size() / number;
    const std::size_t end = (i + 1) * layers.size() / number;
    double sum = 0.0;
    for (const Layer& layer : layers.subspan(begin, end - begin)) sum += layer.density();
    text += block(sum / static_cast<double>(end - begin));
  }
  return text;
}

std::string text_line(std::int64_t run_id, const RunView& view) {
  std::string line =
      fmt::format("{} {}  step {}  {:.2f} s ", short_id(run_id), name_of(view), view.step(), view.sim_time());
  line += bars(view);
  if (view.stats()) {
    line += fmt::format("  awake {}  asleep {}", view.stats()->awake, view.stats()->asleep);
    if (view.stats()->timed != 0) line += fmt::format("  {:.2f} x real time", view.stats()->real_time_factor);
    if (view.stats()->drift_estimate >= 0.0)
      line += fmt::format("  estimated drift {:.2g} D", view.stats()->drift_estimate);
    for (const Warning& warning : view.reader().moment().warnings)
      line += fmt::format("  warning: {}", account(warning));
    if (view.stats()->dropped > 0) line += fmt::format("  dropped by the sender {}", view.stats()->dropped);
  }
  line += fmt::format("  lost {}", view.lost());
  if (view.ended()) line += fmt::format("  ended: {}", printable(view.run()->reason));
  return line;
}

std::string text_line(const Faults& faults) {
  std::string line = "not all could be shown:";
  if (faults.receiver_crashes > 0) {
    line += fmt::format(" receiver crashed {} times, the last time by {}, restarted after {} ms;",
                        faults.receiver_crashes, faults.last_crash, faults.restart_delay_ms);
  }
  if (faults.undecodable > 0)
    line += fmt::format(" undecodable {}, the last one on {};", faults.undecodable, faults.last_undecodable);
  if (faults.dropped_runs > 0) {
    line += fmt::format(" {} runs dropped from a full table, the last one {};", faults.dropped_runs,
                        short_id(faults.last_dropped));
  }
  if (faults.unplaced_messages > 0) line += fmt::format(" {} messages of further runs;", faults.unplaced_messages);
  if (faults.piles_left_out > 0) line += fmt::format(" {} piles above the limits;", faults.piles_left_out);
  line.pop_back();
  return line;
}

}  // namespace talus
