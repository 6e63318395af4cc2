// Input: a byte that chooses the message type, then the message between fingerprint and checksum. What decodes goes to
// the view of a monitor, as a message that followed it.
#include "lcmtypes/wire.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/limits.h"
#include "tests/fuzz/sealed_message.h"
#include "tools/monitor/run_view.h"

namespace {

using namespace talus;

void show(const auto& message) {
  RunView view;
  if constexpr (requires { view.take(message); }) {
    view.take(message);
    view.take(message);
    fuzz::require_that(view.lost() >= 0 && view.received() > 0, "a view counts what it takes");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const fuzz::TimeLimit limit;
  const std::span input(data, size);
  const auto channel = static_cast<Channel>(input[0] % channel_names.size());
  const std::vector<std::uint8_t> bytes = fuzz::sealed_message(channel, input.subspan(1));
  with_message_of(channel, [&](auto message) {
    if (decode(bytes, message).empty()) show(message);
    (void)decode(input, message);
  });
  return 0;
}
