#pragma once
// talus_run: what a run is, and how it ended.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lcmtypes/run_info.h"
#include "lcmtypes/wire.h"

namespace talus {

/// `phase` as in talus_run; `channels` are those that the run sends on, with the numbers that `encoder` has reached.
talus_lcm::talus_run to_run(const RunInfo& info, std::int8_t phase, std::string_view reason,
                            std::span<const Channel> channels, const MessageEncoder& encoder);

/// The first value that is out of its range, or nothing (see decode()).
std::string_view range_fault(const talus_lcm::talus_run& message);

/// What a message on TALUS_RUN of another format than talus_run::FORMAT says of itself.
struct OtherFormat {
  std::int32_t format = 0;
  std::string version;  // of talus; any bytes
};
/// One line: "format 3 of talus 0.4, must be format 1".
std::string text_of(const OtherFormat& other);
/// Nothing where the bytes are damaged or of this format.
std::optional<OtherFormat> other_format(std::span<const std::uint8_t> bytes);
/// Throws std::invalid_argument where these are of a run of another format.
void refuse_other_format(Channel channel, std::span<const std::uint8_t> bytes);

}  // namespace talus
