#include "tools/run/warning_printer.h"

#include <unistd.h>

#include "tools/output/output.h"

namespace talus {

template <int Dim>
void WarningPrinter<Dim>::print(const Frame<Dim>& frame) {
  for (; printed_ < frame.warnings.size(); ++printed_) {
    if (isatty(STDERR_FILENO) != 0) write_note("\r\x1b[K");  // the line of progress
    print_message("warning: {}", advice(frame.warnings[printed_]));
  }
}

template class WarningPrinter<2>;
template class WarningPrinter<3>;

}  // namespace talus
