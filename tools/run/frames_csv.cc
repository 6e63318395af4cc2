#include "tools/run/frames_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/world/energy.h"

namespace talus {
namespace {

std::vector<std::string> frame_columns() {
  std::vector<std::string> columns = {"step",  "time_s", "bodies",           "awake",           "slept", "woken",
                                      "piles", "layers", "occupation_ratio", "kinetic_energy_J"};
  for (const Phase& phase : all_phases) columns.push_back(fmt::format("{}_ms", phase.name));
  return columns;
}

}  // namespace

template <int Dim>
FramesCsv<Dim>::FramesCsv(const std::filesystem::path& file) : file_(file, frame_columns()) {}

template <int Dim>
void FramesCsv<Dim>::on_frame(const Frame<Dim>& frame) {
  std::size_t layers = 0;
  double ratio = 0.0;
  for (const Pile<Dim>& pile : frame.piles.piles()) {
    layers += pile.layers.size();
    ratio = std::max(ratio, pile.occupation_ratio());
  }
  const auto woken = std::count_if(frame.events.begin(), frame.events.end(), [](const auto& e) { return e.woke; });
  std::string row =
      fmt::format("{},{:.6f},{},{},{},{},{},{},{:.4f},{:.6g}", frame.step, frame.time, frame.world.states().size(),
                  frame.world.awake().size(), static_cast<std::ptrdiff_t>(frame.events.size()) - woken, woken,
                  frame.piles.piles().size(), layers, ratio, kinetic_energy(frame.world));
  for (const Phase& phase : all_phases) row += fmt::format(",{:.5f}", 1e3 * frame.phases.*phase.time);
  file_.add_line(row + '\n');
}

template <int Dim>
void FramesCsv<Dim>::on_end(const Frame<Dim>&, std::string_view) {
  file_.flush();
}

template class FramesCsv<2>;
template class FramesCsv<3>;

}  // namespace talus
