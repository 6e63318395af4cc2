#pragma once
// Colours of bodies in pictures: by state, or by what else is wanted.

#include <span>
#include <string>
#include <vector>

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

/// Colours for kinds: `kind[body]` indexes `names`, or is -1 (grey). Beyond seven kinds the colours come again. The
/// legend has the kinds that occur, at most seven.
BodyColours colours_of_kinds(std::span<const int> kind, std::span<const std::string> names);

/// Colours from blue over grey to red for values from `least` to `greatest` (> least) and beyond; NaN: grey, never
/// slept. `text` is the legend's.
BodyColours colours_of_values(std::span<const double> values, double least, double greatest, const std::string& text);

/// Fill and outline of one body.
struct BodyPaint {
  Colour fill;
  Colour outline;
};

/// `colour`: what `BodyColours` says of the body, or nullptr.
BodyPaint body_paint(const PictureParams& params, int shape, bool asleep, const Colour* colour);

}  // namespace talus
