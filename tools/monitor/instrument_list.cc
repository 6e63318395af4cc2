#include <fmt/format.h>

#include <string>
#include <vector>

#include "common/text/printable.h"
#include "tools/monitor/panels.h"

namespace talus {

using talus_lcm::talus_gate;
using talus_lcm::talus_instruments;
using talus_lcm::talus_load;
using talus_lcm::talus_region;

namespace {

struct Line {
  std::string text;
  Style style = Style::plain;
};

std::string named(const std::string& name) { return fmt::format("{:<10} ", printable(name)); }

Line line_of(const talus_gate& gate) {
  std::string text = named(gate.name) + fmt::format("{} passed", gate.forward);
  if (gate.backward > 0) text += fmt::format(", {} back", gate.backward);
  if (gate.jammed != 0) return {text + ", jammed", Style::alert};
  return {text};
}

Line line_of(const talus_region& region) {
  std::string text = named(region.name) + fmt::format("{} bodies", region.bodies);
  if (region.packing >= 0.0) text += fmt::format(", {:.1f} %", 100.0 * region.packing);
  return {text + fmt::format(", {:.2g} m/s", region.mean_speed)};
}

Line line_of(const talus_load& load, bool plane) {
  const auto& [x, y, z] = load.force;
  if (load.known == 0) return {named(load.name) + "not known", Style::quiet};
  return {named(load.name) +
          (plane ? fmt::format("({:.3g}, {:.3g}) N", x, z) : fmt::format("({:.3g}, {:.3g}, {:.3g}) N", x, y, z))};
}

std::vector<Line> lines_of(const RunView& view) {
  const bool plane = view.run() && view.run()->dimension == 2;
  std::vector<Line> lines;
  for (const talus_instruments& message : view.reader().instruments()) {
    for (const talus_gate& gate : message.gates) lines.push_back(line_of(gate));
    for (const talus_region& region : message.regions) lines.push_back(line_of(region));
    for (const talus_load& load : message.loads) lines.push_back(line_of(load, plane));
  }
  return lines;
}

}  // namespace

int instrument_rows(const RunView& view) {
  const std::size_t lines = lines_of(view).size();
  return lines == 0 ? 0 : static_cast<int>(lines) + 1;
}

void draw_instruments(const RunView& view, int first, const Area& area) {
  const std::vector<Line> lines = lines_of(view);
  area.put(0, 0, lines.empty() ? "no gate, region or load" : "gates, regions, loads", Style::strong);
  if (std::ssize(lines) >= area.rows()) area.put_right(0, "  i: all", Style::quiet);
  const Area list = area.lower(1);
  for (int row = 0; row < list.rows() && first + row < std::ssize(lines); ++row)
    list.put(row, 0, lines[first + row].text, lines[first + row].style);
}

}  // namespace talus
