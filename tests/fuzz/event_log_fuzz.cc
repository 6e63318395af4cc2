// Input: the bytes of an LCM event log.
#include <sstream>

#include "lcmtypes/log_reader.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/limits.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace talus;
  const fuzz::TimeLimit limit;
  LogReader reader(std::make_unique<std::istringstream>(std::string(fuzz::text({data, size}))));
  std::size_t bytes = 0;
  constexpr std::size_t header_size = 28;  // of an event, before channel and data
  for (LogEvent event; reader.next(event);) bytes += header_size + event.channel.size() + event.data.size();
  fuzz::require_that(bytes + reader.damage().bytes == size, "every byte belongs to an event or to damage");
  return 0;
}
