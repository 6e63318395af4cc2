#include "tools/picture/layer_style.h"

#include <fmt/format.h>

#include <algorithm>

namespace talus {

double layer_opacity(const Layer& layer) { return 0.10 + 0.22 * std::clamp(layer.density(), 0.0, 1.0); }

void DensityLabels::draw(cairo_t* canvas, const Vec2& at, const Layer& layer) {
  if (layer.count == 0) {
    return;
  }
  const TextStyle style = {.size = 0.82 * params_.font_size, .colour = params_.layer, .halo = 3.0};
  const std::string text = fmt::format("{:.2f}", layer.density());
  const Vec2 left = at + Vec2(0.4 * params_.font_size, 0.0);
  const Box<2> box(Vec2(left - Vec2(0.0, 0.6 * style.size)),
                   Vec2(left + Vec2(text_width(canvas, text, style), 0.6 * style.size)));
  if (std::ranges::any_of(taken_, [&](const Box<2>& other) { return other.intersects(box); })) {
    return;
  }
  taken_.push_back(box);
  draw_text(canvas, left + Vec2(0.0, 0.36 * style.size), text, style);
}

}  // namespace talus
