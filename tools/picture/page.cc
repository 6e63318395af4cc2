#include "tools/picture/page.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "tools/picture/canvas.h"
#include "tools/picture/force_chains.h"

namespace talus {
namespace {

constexpr double line_height = 1.45;  // in font sizes
constexpr double swatch_side = 0.8;
constexpr double entry_gap = 1.6;  // after an entry of the legend

TextStyle title_style(const PictureParams& params) {
  return {.size = 1.4 * params.font_size, .colour = params.text, .bold = true};
}

TextStyle legend_style(const PictureParams& params) { return {.size = params.font_size, .colour = params.text}; }

TextStyle caption_style(const PictureParams& params) {
  return {.size = 0.92 * params.font_size, .colour = params.quiet_text};
}

/// With the gap after it [px].
double entry_width(cairo_t* canvas, const std::string& text, const TextStyle& style) {
  return (1.5 * swatch_side + entry_gap) * style.size + text_width(canvas, text, style);
}

std::string counted(int count, const char* what) { return fmt::format("{} {}", count, what); }

}  // namespace

template <int Dim>
PageContent page_content(const PictureInput<Dim>& input, const Box<Dim>& box, const PictureParams& params) {
  PageContent content = {.title = input.title, .caption = input.caption};
  for (BodyIndex body = 0; body < input.states.size(); ++body) {
    if (input.states.removed[body] != 0) continue;
    ++(input.states.asleep[body] != 0 ? content.asleep : content.awake);
    const double away = box.exteriorDistance(input.states.pose[body].position);
    content.outside += away > 0.0 ? 1 : 0;
    content.farthest = std::max(content.farthest, away);
  }
  content.awake_colours = awake_colours(params, input.shapes);
  content.shapes = legend_of_shapes(input.shapes);
  content.obstacles = !input.obstacles.empty();
  content.layers = !input.piles.empty();
  content.sides = input.sides.any();
  content.force_scale = force_scale(input);
  content.parallel = Dim == 2;
  return content;
}
template PageContent page_content(const PictureInput<2>&, const Box<2>&, const PictureParams&);
template PageContent page_content(const PictureInput<3>&, const Box<3>&, const PictureParams&);

Page::Page(PageContent content, const PictureParams& params) : content_(std::move(content)), params_(params) {
  const double font = params.font_size;
  double y = 0.7 * params.margin;
  if (!content_.title.empty()) {
    title_base_ = y + title_style(params).size;
    y = title_base_ + 0.5 * font;
  }
  legend_base_ = y + font;
  header_ = legend_base_ + 1.2 * font;
  lines_ = wrapped(content_.caption, params.width - 2.0 * params.margin, caption_style(params));
  footer_ =
      2.6 * font + line_height * caption_style(params).size * static_cast<double>(lines_.size()) + 0.7 * params.margin;
}

void Page::draw_background(cairo_t* canvas) const {
  set_colour(canvas, params_.paper);
  cairo_paint(canvas);
}

void Page::draw(cairo_t* canvas, double height, double pixels_per_metre) const {
  draw_title(canvas);
  draw_legend(canvas);
  const double scale_base = height - footer_ + 2.1 * params_.font_size;
  draw_scale_bar(canvas, scale_base, pixels_per_metre);
  TextStyle style = caption_style(params_);
  double base = scale_base + 0.35 * params_.font_size;
  for (const std::string& line : lines_) {
    base += line_height * style.size;
    draw_text(canvas, {params_.margin, base}, line, style);
  }
  style.anchor = 1.0;
  draw_text(canvas, {params_.width - params_.margin, scale_base}, outside_note(), style);
}

std::string Page::outside_note() const {
  if (content_.outside == 0) return "";
  return content_.outside == 1 ? fmt::format("1 body lies outside the picture, {:.3g} m away", content_.farthest)
                               : fmt::format("{} bodies lie outside the picture, up to {:.3g} m away", content_.outside,
                                             content_.farthest);
}

void Page::draw_title(cairo_t* canvas) const {
  TextStyle style = title_style(params_);
  const double room = params_.width - 2.0 * params_.margin;
  const double needed = text_width(canvas, content_.title, style);
  style.size *= needed > room ? room / needed : 1.0;
  draw_text(canvas, {params_.margin, title_base_}, content_.title, style);
}

void Page::draw_legend(cairo_t* canvas) const {
  const std::vector<Swatch> all = swatches();
  TextStyle style = legend_style(params_);
  double needed = -entry_gap * style.size;
  for (const Swatch& swatch : all) needed += entry_width(canvas, swatch.text, style);
  style.size *= std::min(1.0, (params_.width - 2.0 * params_.margin) / needed);
  double left = params_.margin;
  for (const Swatch& swatch : all) {
    draw_swatch(canvas, left, swatch, style);
    left += entry_width(canvas, swatch.text, style);
  }
}

std::vector<Page::Swatch> Page::swatches() const {
  const char* asleep = content_.shapes.empty() ? "asleep" : "asleep (darker)";
  std::vector<Swatch> all = {{{params_.asleep}, params_.asleep_outline, counted(content_.asleep, asleep)},
                             {content_.awake_colours, params_.awake_outline, counted(content_.awake, "awake")}};
  for (const LegendEntry& entry : content_.shapes) all.push_back({{entry.fill}, params_.awake_outline, entry.text});
  if (content_.obstacles) all.push_back({{params_.obstacle}, params_.obstacle_outline, "obstacles"});
  if (content_.sides) all.push_back({{params_.paper}, params_.ground, "periodic sides"});
  if (content_.layers) all.push_back({{with_alpha(params_.layer, 0.25)}, params_.layer, "layers with their density"});
  if (content_.force_scale > 0.0)
    all.push_back({{params_.weak_force, params_.strong_force},
                   params_.strong_force,
                   fmt::format("contact forces, the strong ones {:g} N and more", content_.force_scale)});
  return all;
}

void Page::draw_swatch(cairo_t* canvas, double left, const Swatch& swatch, const TextStyle& style) const {
  const auto& [fills, outline, text] = swatch;
  const double side = swatch_side * style.size;
  for (std::size_t i = 0; i < fills.size(); ++i) {
    const double width = side / static_cast<double>(fills.size());
    cairo_rectangle(canvas, left + width * static_cast<double>(i), legend_base_ - side, width, side);
    set_colour(canvas, fills[i]);
    cairo_fill(canvas);
  }
  cairo_rectangle(canvas, left, legend_base_ - side, side, side);
  set_colour(canvas, outline);
  cairo_set_line_width(canvas, 1.2);
  cairo_stroke(canvas);
  draw_text(canvas, {left + 1.5 * side, legend_base_ - 0.05 * side}, text, style);
}

void Page::draw_scale_bar(cairo_t* canvas, double base, double pixels_per_metre) const {
  const double length = nice_length(params_.width / 6.0 / pixels_per_metre);
  const double left = params_.margin;
  const double right = left + length * pixels_per_metre;
  const double y = base - 0.3 * params_.font_size;
  const double tick = 0.3 * params_.font_size;
  trace_line(canvas, std::array{Vec2(left, y), Vec2(right, y)});
  trace_line(canvas, std::array{Vec2(left, y - tick), Vec2(left, y + tick)});
  trace_line(canvas, std::array{Vec2(right, y - tick), Vec2(right, y + tick)});
  set_colour(canvas, params_.text);
  cairo_set_line_width(canvas, 2.0);
  cairo_set_line_cap(canvas, CAIRO_LINE_CAP_BUTT);
  cairo_stroke(canvas);
  const std::string text = fmt::format("{} m{}", length, content_.parallel ? "" : ", as the squares on the ground");
  draw_text(canvas, {right + 0.6 * params_.font_size, base}, text, caption_style(params_));
}

namespace {

constexpr double least_height = 0.42;  // of the page, in its width
constexpr double eye_distance = 2.6;   // in diagonals of what is seen: a mild perspective
constexpr double label_room = 2.0;     // beside the scene, in font sizes

void aim(Projection<2>&, const Framing<2>&, const PictureParams&) {}

void aim(Projection<3>& projection, const Framing<3>& framing, const PictureParams& params) {
  const Vec3 towards_eye(std::cos(params.azimuth) * std::cos(params.elevation),
                         std::sin(params.azimuth) * std::cos(params.elevation), std::sin(params.elevation));
  projection =
      Projection<3>::looking_along(towards_eye, framing.box.center(), eye_distance * framing.box.diagonal().norm());
}

}  // namespace

template <int Dim>
Layout<Dim> lay_out(const Framing<Dim>& framing, const Page& page, const PictureParams& params) {
  Layout<Dim> layout;
  aim(layout.projection, framing, params);
  const double side = params.margin + label_room * params.font_size;
  const double bottom = std::max(page.header() + 1.0, params.height - page.footer());
  Box<2> area(Vec2(side, page.header()), Vec2(params.width - side, bottom));
  const Vec2 size = fit<Dim>(layout.projection, framing.points, area);
  const double room = std::max(size.y(), least_height * params.width - page.header() - page.footer());
  area.max().y() = std::min(bottom, page.header() + room);
  fit<Dim>(layout.projection, framing.points, area);
  layout.height = static_cast<int>(std::ceil(area.max().y() + page.footer()));
  return layout;
}

template Layout<2> lay_out(const Framing<2>&, const Page&, const PictureParams&);
template Layout<3> lay_out(const Framing<3>&, const Page&, const PictureParams&);

}  // namespace talus
