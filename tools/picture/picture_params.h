#pragma once

#include <vector>

namespace talus {

/// Red, green, blue and opacity in [0, 1].
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};

/// Settings of a picture. Lengths are pixels of the PNG, which are the SVG's user units.
struct PictureParams {
  int width = 1600;         // [px] 200..8000; time and the PNG's size grow with the area
  int height = 1200;        // [px] 200..8000, at most; a flat pile gets a lower picture
  double margin = 56.0;     // [px] >= 0 around title, view and caption
  double font_size = 23.0;  // [px] > 0; below 20 unreadable where a page shows the picture at half its size
  int samples = 2;          // 1..4, 3D only: subpixels on each axis; 1: jagged edges, 4: four times the time of 2

  double azimuth = -0.95;  // [rad] 3D only: the eye's direction in the x-y plane as seen from the pile, from the x axis
  double elevation = 0.42;  // [rad] 3D only, in (0, pi/2): the eye's height over the ground, seen from the pile

  Colour paper = {1.0, 1.0, 1.0};
  Colour text = {0.12, 0.13, 0.15};
  Colour quiet_text = {0.38, 0.40, 0.43};
  Colour asleep = {0.17, 0.18, 0.20};
  Colour asleep_outline = {0.60, 0.62, 0.65};
  double sleep_shade = 0.55;  // 0..1: how much darker a sleeping body is whose shape has a colour of its own
  std::vector<Colour> awake = {{0.96, 0.68, 0.26}, {0.91, 0.47, 0.31}, {0.96, 0.83, 0.50}, {0.85, 0.56, 0.50}};
  Colour awake_outline = {0.42, 0.23, 0.06};  // `awake` by shape, in turn; not empty
  Colour layer = {0.16, 0.44, 0.82};          // opacity follows the layer's density
  Colour weak_force = {0.10, 0.75, 0.70};     // of contacts
  Colour strong_force = {0.85, 0.05, 0.50};
  Colour obstacle = {0.70, 0.72, 0.74};
  Colour obstacle_outline = {0.36, 0.38, 0.40};
  Colour ground = {0.36, 0.38, 0.40};
};

/// Throws std::invalid_argument with field, value and rule.
void check(const PictureParams& params);

}  // namespace talus
