#include "tools/run/warning_teller.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace talus {

template <int Dim>
void WarningTeller<Dim>::tell(const Frame<Dim>& frame) {
  for (; told_ < frame.warnings.size(); ++told_) {
    const char* clear_progress = isatty(STDERR_FILENO) != 0 ? "\r\x1b[K" : "";
    std::fputs(fmt::format("{}warning: {}\n", clear_progress, advice(frame.warnings[told_])).c_str(), stderr);
  }
}

template class WarningTeller<2>;
template class WarningTeller<3>;

}  // namespace talus
