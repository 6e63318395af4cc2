#include "tools/run/avalanches_csv.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

namespace talus {

void write_avalanches(const std::filesystem::path& file, std::span<const Avalanche> avalanches) {
  std::ofstream out(file);
  out << "step,pile,layer,density,woken,seconds_until_quiet,mean_way_m,longest_way_m\n";
  for (const Avalanche& a : avalanches) {
    out << fmt::format("{},{},{},{:.4f},{},{},{:.6g},{:.6g}\n", a.step, a.pile, a.layer, a.density, a.woken,
                       a.seconds < 0.0 ? "" : fmt::format("{:.4f}", a.seconds), a.mean_way, a.longest_way);
  }
  out.flush();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace talus
