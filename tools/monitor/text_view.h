#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "tools/monitor/faults.h"
#include "tools/monitor/run_view.h"

namespace talus {

/// One block of eight heights per layer, bottom layer first: density 1 and above is a full block, an empty layer a
/// blank. Of more than 24 layers, neighbours share a block with their mean.
std::string density_bar(std::span<const Layer> layers);

/// A run in one line for people.
std::string text_line(std::int64_t run_id, const RunView& view);

/// The faults there are, in one line.
std::string text_line(const Faults& faults);

}  // namespace talus
