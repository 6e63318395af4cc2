#include "tools/picture/picture_params.h"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

namespace talus {
namespace {

template <typename Value>
void require(bool holds, const char* field, const Value& value, const char* rule) {
  if (!holds) throw std::invalid_argument(fmt::format("picture.{} = {}: {}", field, value, rule));
}

}  // namespace

void check(const PictureParams& params) {
  require(params.width >= 200 && params.width <= 8000, "width", params.width, "must be 200 to 8000 px");
  require(params.height >= 200 && params.height <= 8000, "height", params.height, "must be 200 to 8000 px");
  require(params.margin >= 0.0 && params.margin < 0.25 * params.width, "margin", params.margin,
          "must be at least 0 and under a quarter of the width");
  require(params.font_size > 0.0 && params.font_size < 0.1 * params.width, "font_size", params.font_size,
          "must be above 0 and under a tenth of the width");
  require(params.samples >= 1 && params.samples <= 4, "samples", params.samples, "must be 1 to 4");
  require(params.elevation > 0.0 && params.elevation < 0.5 * std::numbers::pi, "elevation", params.elevation,
          "must lie between 0 and pi/2");
  require(std::abs(params.azimuth) < 1e6, "azimuth", params.azimuth, "must be finite");
  require(!params.awake.empty(), "awake", "[]", "must hold a colour");
}

}  // namespace talus
