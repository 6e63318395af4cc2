#include "tools/picture/body_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/picture/canvas.h"

namespace talus {
namespace {

/// Okabe and Ito's colours, which colour-blind eyes tell apart, without black.
constexpr std::array<Colour, 7> kind_colours = {{{0.90, 0.62, 0.00},
                                                 {0.34, 0.71, 0.91},
                                                 {0.00, 0.62, 0.45},
                                                 {0.94, 0.89, 0.26},
                                                 {0.84, 0.37, 0.00},
                                                 {0.80, 0.47, 0.65},
                                                 {0.00, 0.45, 0.70}}};

/// From the least value to the greatest: Moreland's diverging map, which keeps an order in grey too.
constexpr std::array<Colour, 3> value_scale = {{{0.23, 0.30, 0.75}, {0.87, 0.87, 0.87}, {0.71, 0.02, 0.15}}};

constexpr Colour no_value = {0.6, 0.6, 0.6};
constexpr double sleep_shade = 0.55;  // of the way to black

Colour on_scale(double share) {
  const double place = share * (value_scale.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), value_scale.size() - 2);
  return mix(value_scale[below], value_scale[below + 1], place - static_cast<double>(below));
}

}  // namespace

BodyColours colours_of_kinds(std::span<const int> kind, std::span<const std::string> names, const std::string& none,
                             std::span<const std::string> own) {
  const auto colour = [&](std::size_t one) {
    return one < own.size() && !own[one].empty() ? colour_of(own[one]) : kind_colours[one % kind_colours.size()];
  };
  BodyColours colours;
  std::vector<int> bodies(names.size(), 0);
  int without = 0;
  for (const int one : kind) {
    colours.awake.push_back(one < 0 ? no_value : colour(one));
    ++(one < 0 ? without : bodies[one]);
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (bodies[i] > 0 && colours.legend.size() < kind_colours.size()) colours.legend.push_back({{colour(i)}, names[i]});
  if (without > 0) colours.legend.push_back({{no_value}, none});
  return colours;
}

BodyColours colours_of_values(std::span<const double> values, double least, double greatest, const std::string& text,
                              const std::string& none) {
  BodyColours colours;
  bool all = true;
  for (const double value : values) {
    all = all && std::isfinite(value);
    const double share = std::clamp((value - least) / (greatest - least), 0.0, 1.0);
    colours.awake.push_back(std::isfinite(value) ? on_scale(share) : no_value);
  }
  colours.legend.push_back({{value_scale.begin(), value_scale.end()}, text});
  if (!all) colours.legend.push_back({{no_value}, none});
  return colours;
}

Colour colour_of(const std::string& text) {
  const auto part = [&](std::size_t at) { return std::stoi(text.substr(at, 2), nullptr, 16) / 255.0; };
  return {part(1), part(3), part(5)};
}

BodyPaint body_paint(const PictureParams& params, int shape, const std::string& own, bool asleep,
                     const Colour* colour) {
  if (colour != nullptr || !own.empty()) {
    const Colour awake = colour != nullptr ? *colour : colour_of(own);
    return {asleep ? mix(awake, {}, sleep_shade) : awake, asleep ? params.asleep_outline : params.awake_outline};
  }
  if (asleep) return {params.asleep, params.asleep_outline};
  return {params.awake[shape % params.awake.size()], params.awake_outline};
}

}  // namespace talus
