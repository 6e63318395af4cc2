#pragma once
// Several pictures side by side.

#include <filesystem>
#include <span>
#include <string>

#include "tools/picture/picture_params.h"

namespace talus {

/// One picture of a sheet.
struct Tile {
  std::filesystem::path png;
  std::string caption;            // below the picture, broken into lines as needed; may be empty
  double pixels_per_metre = 0.0;  // of the picture; 0: unknown
};

/// Lengths are pixels of the sheet.
struct ContactSheetParams {
  int columns = 3;          // 1..20; fewer tiles than columns make a narrower sheet
  int tile_width = 640;     // [px] 100..4000; pictures are scaled to it
  bool one_scale = false;   // a metre has the same length in all pictures, which then are smaller than tile_width
  double gap = 28.0;        // [px] >= 0 between tiles and around them
  double font_size = 20.0;  // [px] > 0
  Colour paper = {1.0, 1.0, 1.0};
  Colour text = {0.12, 0.13, 0.15};
};

/// Writes tiles row by row into one PNG, a strip of a run or runs side by side; tiles of a row end at the same height.
/// The same input gives the same bytes. Throws std::invalid_argument on bad parameters or no tile, std::runtime_error
/// naming the file that cannot be read or written.
void write_contact_sheet(const std::filesystem::path& png, std::span<const Tile> tiles, const std::string& title = "",
                         const ContactSheetParams& params = {});

}  // namespace talus
