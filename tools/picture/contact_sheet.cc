#include "tools/picture/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "tools/picture/canvas.h"

namespace talus {
namespace {

constexpr double caption_line_height = 1.4;  // in font sizes

using Picture = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;

Picture read_png(const std::filesystem::path& path) {
  Picture surface(cairo_image_surface_create_from_png(path.c_str()), cairo_surface_destroy);
  const cairo_status_t status = cairo_surface_status(surface.get());
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), cairo_status_to_string(status)));
  return surface;
}

struct PlacedTile {
  Picture picture;
  std::vector<std::string> caption;
  double scale = 1.0;
  double left = 0.0;
  double top = 0.0;
  double height = 0.0;  // of the picture on the sheet
};

void check(std::span<const Tile> tiles, const ContactSheetParams& params) {
  const auto require = [](bool holds, const char* field, auto value, const char* rule) {
    if (!holds) throw std::invalid_argument(fmt::format("contact_sheet.{} = {}: {}", field, value, rule));
  };
  require(!tiles.empty(), "tiles", tiles.size(), "must be at least 1");
  for (const Tile& tile : tiles)
    require(!params.one_scale || tile.pixels_per_metre > 0.0, "pixels_per_metre", tile.pixels_per_metre,
            "must be known of each picture where all have one scale");
  require(params.columns >= 1 && params.columns <= 20, "columns", params.columns, "must be 1 to 20");
  require(params.tile_width >= 100 && params.tile_width <= 4000, "tile_width", params.tile_width,
          "must be 100 to 4000 px");
  require(params.gap >= 0.0 && params.gap <= 1000.0, "gap", params.gap, "must be 0 to 1000 px");
  require(params.font_size > 0.0 && params.font_size <= 500.0, "font_size", params.font_size, "must be 0 to 500 px");
}

class Sheet {
 public:
  Sheet(std::span<const Tile> tiles, std::string title, const ContactSheetParams& params)
      : title_(std::move(title)),
        params_(params),
        columns_(std::min(tiles.size(), static_cast<std::size_t>(params.columns))) {
    for (const Tile& tile : tiles) {
      if (!params.one_scale) break;
      const double width = cairo_image_surface_get_width(read_png(tile.png).get());
      const double metre = params.tile_width / width * tile.pixels_per_metre;
      metre_ = metre_ == 0.0 ? metre : std::min(metre_, metre);
    }
    height_ = params.gap + (title_.empty() ? 0.0 : 2.2 * title_style().size);
    for (std::size_t first = 0; first < tiles.size(); first += columns_)
      place_row(tiles.subspan(first, std::min(columns_, tiles.size() - first)));
  }

  int width() const {
    const auto columns = static_cast<double>(columns_);
    return static_cast<int>(std::ceil(columns * params_.tile_width + (columns + 1.0) * params_.gap));
  }
  int height() const { return static_cast<int>(std::ceil(height_)); }

  void paint(cairo_t* canvas) const {
    set_colour(canvas, params_.paper);
    cairo_paint(canvas);
    draw_text(canvas, {params_.gap, params_.gap + title_style().size}, title_, title_style());
    for (const PlacedTile& tile : placed_) {
      cairo_save(canvas);
      cairo_translate(canvas, tile.left, tile.top);
      cairo_scale(canvas, tile.scale, tile.scale);
      cairo_set_source_surface(canvas, tile.picture.get(), 0.0, 0.0);
      cairo_pattern_set_filter(cairo_get_source(canvas), CAIRO_FILTER_BEST);
      cairo_paint(canvas);
      cairo_restore(canvas);
      double base = tile.top + tile.height;
      for (const std::string& line : tile.caption) {
        base += caption_line_height * params_.font_size;
        draw_text(canvas, {tile.left, base}, line, caption_style());
      }
    }
  }

 private:
  TextStyle title_style() const { return {.size = 1.4 * params_.font_size, .colour = params_.text, .bold = true}; }
  TextStyle caption_style() const { return {.size = params_.font_size, .colour = params_.text}; }

  void place_row(std::span<const Tile> tiles) {
    double tallest = 0.0;
    std::size_t lines = 0;
    const std::size_t first = placed_.size();
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      PlacedTile tile{read_png(tiles[i].png), wrapped(tiles[i].caption, params_.tile_width, caption_style())};
      const double width = cairo_image_surface_get_width(tile.picture.get());
      tile.scale = params_.one_scale ? metre_ / tiles[i].pixels_per_metre : params_.tile_width / width;
      tile.height = tile.scale * cairo_image_surface_get_height(tile.picture.get());
      tile.left = params_.gap + static_cast<double>(i) * (params_.tile_width + params_.gap) +
                  0.5 * (params_.tile_width - tile.scale * width);
      tallest = std::max(tallest, tile.height);
      lines = std::max(lines, tile.caption.size());
      placed_.push_back(std::move(tile));
    }
    for (std::size_t i = first; i < placed_.size(); ++i) placed_[i].top = height_ + tallest - placed_[i].height;
    height_ += tallest + caption_line_height * params_.font_size * static_cast<double>(lines) + params_.gap;
  }

  std::string title_;
  const ContactSheetParams& params_;
  std::size_t columns_;
  std::vector<PlacedTile> placed_;
  double metre_ = 0.0;  // on the sheet, where all pictures have one scale [px]
  double height_ = 0.0;
};

}  // namespace

void write_contact_sheet(const std::filesystem::path& png, std::span<const Tile> tiles, const std::string& title,
                         const ContactSheetParams& params) {
  check(tiles, params);
  const Sheet sheet(tiles, title, params);
  write_file(png, png_bytes(sheet.width(), sheet.height(), [&](cairo_t* canvas) { sheet.paint(canvas); }));
}

}  // namespace talus
