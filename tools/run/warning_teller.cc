#include "tools/run/warning_teller.h"

#include <unistd.h>

#include "tools/output/output.h"

namespace talus {

template <int Dim>
void WarningTeller<Dim>::tell(const Frame<Dim>& frame) {
  for (; told_ < frame.warnings.size(); ++told_) {
    if (isatty(STDERR_FILENO) != 0) write_note("\r\x1b[K");  // the line of progress
    print_message("warning: {}", advice(frame.warnings[told_]));
  }
}

template class WarningTeller<2>;
template class WarningTeller<3>;

}  // namespace talus
