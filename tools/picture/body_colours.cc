#include "tools/picture/body_colours.h"

#include "tools/picture/canvas.h"

namespace talus {

Colour colour_of(const std::string& text) {
  const auto part = [&](std::size_t at) { return std::stoi(text.substr(at, 2), nullptr, 16) / 255.0; };
  return {part(1), part(3), part(5)};
}

BodyPaint body_paint(const PictureParams& params, int shape, const std::string& own, bool asleep) {
  if (!own.empty()) {
    const Colour awake = colour_of(own);
    return {asleep ? mix(awake, {}, params.sleep_shade) : awake, asleep ? params.asleep_outline : params.awake_outline};
  }
  if (asleep) return {params.asleep, params.asleep_outline};
  return {params.awake[shape % params.awake.size()], params.awake_outline};
}

}  // namespace talus
