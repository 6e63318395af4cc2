#pragma once
// Colours of bodies in pictures: by state, or by what else is wanted.

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "common/shape/shape.h"
#include "tools/picture/picture_params.h"

namespace talus {

/// A line of the legend: a colour or a scale of colours, and what it stands for.
struct LegendEntry {
  std::vector<Colour> fills;
  std::string text;
};

/// Colours that show something else than the state. Sleeping bodies are drawn darker.
struct BodyColours {
  std::vector<Colour> awake;  // [body]; empty: the colours of PictureParams
  std::vector<LegendEntry> legend;
};

/// Colours for kinds: `kind[body]` indexes `names`, or is -1 (grey, `none` in the legend). `own[kind]`, where given, is
/// its "#rrggbb". Beyond seven kinds the colours come again. The legend has the kinds that occur, at most seven.
BodyColours colours_of_kinds(std::span<const int> kind, std::span<const std::string> names, const std::string& none,
                             std::span<const std::string> own = {});

/// Colours from blue over grey to red for values from `least` to `greatest` (> least) and beyond, `text` in the legend;
/// NaN: grey, `none` in the legend.
BodyColours colours_of_values(std::span<const double> values, double least, double greatest, const std::string& text,
                              const std::string& none);

/// Fill and outline of one body.
struct BodyPaint {
  Colour fill;
  Colour outline;
};

/// `own`: Shape::colour. `colour`: what `BodyColours` says of the body, or nullptr.
BodyPaint body_paint(const PictureParams& params, int shape, const std::string& own, bool asleep,
                     const Colour* colour = nullptr);

/// "#rrggbb" as a colour.
Colour colour_of(const std::string& text);

/// Legend of shapes with colours of their own: each once, variants and sizes under the name that the scene gives them;
/// at most seven.
template <int Dim>
std::vector<LegendEntry> legend_of_shapes(std::span<const Shape<Dim>> shapes) {
  constexpr std::size_t most = 7;
  std::vector<LegendEntry> legend;
  for (const Shape<Dim>& shape : shapes) {
    const std::string name = shape.name.substr(0, shape.name.find_first_of("#*"));
    const bool named = std::ranges::any_of(legend, [&](const LegendEntry& entry) { return entry.text == name; });
    if (!shape.colour.empty() && !named && legend.size() < most) legend.push_back({{colour_of(shape.colour)}, name});
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
