#pragma once
// The last state of a run as a picture, pile.svg and pile.png.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/pile/pile.h"
#include "common/world/world_description.h"
#include "tools/picture/picture_params.h"

namespace talus {

/// What there is to draw. The shapes and piles must outlive the call.
template <int Dim>
struct PictureInput {
  std::span<const Shape<Dim>> shapes;    // BodyStates::shape indexes these
  BodyStates<Dim> states;                // removed bodies are not drawn
  std::span<const Pile<Dim>> piles;      // may be empty
  std::vector<Obstacle<Dim>> obstacles;  // where they are
  Ground ground;
  std::string title;                             // one line, may be empty
  std::string caption;                           // one line or more, separated by '\n'; may be empty
  std::vector<ContactForce<Dim>> contacts = {};  // drawn as force chains; may be empty
  double force_scale = 0.0;                      // [N] of a line of the strongest colour; 0: as force_scale() gives it
  Periodic<Dim> sides = {};                      // drawn as dashed lines, with the images of what reaches through them
};

/// Draws the same picture into two files: sleeping bodies black, awake ones in warm colours, the layers of each pile
/// translucent over them, and force chains as lines between the middles of bodies, as wide as their force is large. In
/// 2D all of the SVG is vectors, up to 20,000 bodies; in 3D the shaded bodies are an image within it, since no order of
/// painting solves interlocked bodies and layers that bodies stick out of. Bodies far from all others are left out and
/// counted in a note. The same input gives the same bytes on one machine. Needs no display. Returns the scale
/// [pixels/m], in 3D that in the middle. Throws std::invalid_argument on bad parameters, std::runtime_error naming the
/// file that cannot be written.
template <int Dim>
double draw_pile(const std::filesystem::path& svg, const std::filesystem::path& png, const PictureInput<Dim>& input,
                 const PictureParams& params = {});

}  // namespace talus
