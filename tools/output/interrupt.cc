#include "tools/output/interrupt.h"

#include <csignal>

namespace talus {
namespace {

/// A signal handler can reach nothing but static storage.
volatile std::sig_atomic_t interrupt_requested = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void on_signal(int signal) {
  interrupt_requested = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

Interrupt::~Interrupt() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  if (std::signal(SIGHUP, SIG_DFL) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  interrupt_requested = 0;
}

// NOLINTNEXTLINE(readability-convert-member-functions-to-static): for a live object only
bool Interrupt::requested() const { return interrupt_requested != 0; }

}  // namespace talus
