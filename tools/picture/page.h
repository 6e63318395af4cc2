#pragma once
// What stands around the scene: title, legend, scale bar, caption.

#include <cmath>
#include <string>
#include <vector>

#include "tools/picture/body_colours.h"
#include "tools/picture/canvas.h"
#include "tools/picture/framing.h"
#include "tools/picture/projection.h"

namespace talus {

/// The text of a page and its numbers.
struct PageContent {
  std::string title;
  std::string caption;  // lines separated by '\n'
  int asleep = 0;
  int awake = 0;
  int outside = 0;                      // bodies too far away to be drawn
  double farthest = 0.0;                // of them, from what is drawn [m]
  std::vector<Colour> awake_colours{};  // of awake bodies
  std::vector<LegendEntry> shapes{};    // with colours of their own
  bool obstacles = false;               // whether any is drawn
  bool layers = false;                  // whether piles are drawn
  bool sides = false;                   // whether periodic sides are drawn
  double force_scale = 0.0;             // of force chains [N]; 0: none are drawn
  bool parallel = true;                 // whether the scale bar holds all over the picture (2D), or in the middle only
};

/// Of a picture that shows `box` [m]: bodies whose middle lies beyond it are outside.
template <int Dim>
PageContent page_content(const PictureInput<Dim>& input, const Box<Dim>& box, const PictureParams& params);

/// A page of fixed width whose header and footer leave room for a scene between them.
class Page {
 public:
  Page(PageContent content, const PictureParams& params);

  double header() const { return header_; }  // [px]
  double footer() const { return footer_; }  // [px]

  void draw_background(cairo_t* canvas) const;
  /// Draws everything but the scene. `height`: of the page [px].
  void draw(cairo_t* canvas, double height, double pixels_per_metre) const;

 private:
  void draw_title(cairo_t* canvas) const;
  /// An entry of the legend: a box, divided among the fills, with a text.
  struct Swatch {
    std::vector<Colour> fills;
    Colour outline;
    std::string text;
  };
  std::vector<Swatch> swatches() const;
  void draw_legend(cairo_t* canvas) const;
  void draw_swatch(cairo_t* canvas, double left, const Swatch& swatch, const TextStyle& style) const;
  void draw_scale_bar(cairo_t* canvas, double base, double pixels_per_metre) const;
  std::string outside_note() const;

  PageContent content_;
  const PictureParams& params_;
  std::vector<std::string> lines_;  // the caption, broken to the page's width
  double title_base_ = 0.0;         // [px] base line; 0: no title
  double legend_base_ = 0.0;
  double header_ = 0.0;
  double footer_ = 0.0;
};

template <int Dim>
struct Layout {
  Projection<Dim> projection;  // from the world to the page
  int height = 0;              // of the page [px]
};

/// All that is framed fits between the page's header and footer, with room for labels at its sides. The page is as high
/// as this needs, within limits.
template <int Dim>
Layout<Dim> lay_out(const Framing<Dim>& framing, const Page& page, const PictureParams& params);

/// The largest of 1, 2, 5 times a power of ten that is at most `limit` (> 0): the length of a scale bar.
inline double nice_length(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  const double share = limit / power;
  return power * (share >= 5.0 ? 5.0 : share >= 2.0 ? 2.0 : 1.0);
}

}  // namespace talus
