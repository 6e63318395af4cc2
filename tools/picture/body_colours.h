#pragma once
// Colours of bodies in pictures.

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "common/shape/shape.h"
#include "tools/picture/picture_params.h"

namespace talus {

/// A line of the legend: a colour and what it stands for.
struct LegendEntry {
  Colour fill;
  std::string text;
};

/// Fill and outline of one body.
struct BodyPaint {
  Colour fill;
  Colour outline;
};

/// `own`: Shape::colour, which sleeping bodies have darker.
BodyPaint body_paint(const PictureParams& params, int shape, const std::string& own, bool asleep);

/// "#rrggbb" as a colour.
Colour colour_of(const std::string& text);

/// Legend of shapes with colours of their own: each once, variants and sizes under the name that the scene gives them;
/// at most seven.
template <int Dim>
std::vector<LegendEntry> legend_of_shapes(std::span<const Shape<Dim>> shapes) {
  constexpr std::size_t most = 7;
  std::vector<LegendEntry> legend;
  for (const Shape<Dim>& shape : shapes) {
    const std::string name = base_name(shape.name);
    const bool named = std::ranges::any_of(legend, [&](const LegendEntry& entry) { return entry.text == name; });
    if (!shape.colour.empty() && !named && legend.size() < most) legend.push_back({colour_of(shape.colour), name});
  }
  return legend;
}

/// Colours that awake bodies have in turn, each once: of shapes, or those of `params`.
template <int Dim>
std::vector<Colour> awake_colours(const PictureParams& params, std::span<const Shape<Dim>> shapes) {
  std::vector<Colour> colours;
  std::vector<std::string> own;
  for (std::size_t i = 0; i < shapes.size() && colours.size() < params.awake.size(); ++i) {
    if (!shapes[i].colour.empty() && std::ranges::count(own, shapes[i].colour) > 0) continue;
    own.push_back(shapes[i].colour);
    colours.push_back(body_paint(params, static_cast<int>(i), shapes[i].colour, false).fill);
  }
  return colours;
}

}  // namespace talus
