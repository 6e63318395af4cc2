// Several pictures on one sheet.

#include "tools/picture/contact_sheet.h"

#include <gtest/gtest.h>

#include "tests/common/temporary_folder.h"
#include "tests/picture/sample.h"
#include "tools/picture/canvas.h"

namespace talus::contact_sheet_test {
namespace {

/// A picture of one colour.
void write_plain(const std::filesystem::path& path, int width, int height, const Colour& colour) {
  std::ofstream(path, std::ios::binary) << png_bytes(width, height, [&](cairo_t* canvas) {
    set_colour(canvas, colour);
    cairo_paint(canvas);
  });
}

const ContactSheetParams tight = {.columns = 2, .tile_width = 100, .gap = 10.0, .font_size = 10.0};

TEST(ContactSheet, PlacesTilesRowByRow) {
  const TemporaryFolder folder;
  write_plain(folder / "red.png", 200, 100, {1.0, 0.0, 0.0});
  write_plain(folder / "green.png", 50, 50, {0.0, 1.0, 0.0});
  write_plain(folder / "blue.png", 400, 100, {0.0, 0.0, 1.0});
  const std::vector<Tile> tiles = {{folder / "red.png", ""}, {folder / "green.png", ""}, {folder / "blue.png", ""}};
  write_contact_sheet(folder / "sheet.png", tiles, "", tight);
  const Image sheet(folder / "sheet.png");
  // Two columns of 100 px; the upper row as high as the square one, the lower as the flat one.
  EXPECT_EQ(sheet.width(), 230);
  EXPECT_EQ(sheet.height(), 10 + 100 + 10 + 25 + 10);
  EXPECT_EQ(sheet.at({60.0, 100.0}).red, 1.0);
  EXPECT_EQ(sheet.at({60.0, 100.0}).green, 0.0);
  EXPECT_EQ(sheet.at({60.0, 30.0}).green, 1.0) << "paper above the lower of two tiles";
  EXPECT_EQ(sheet.at({170.0, 60.0}).green, 1.0);
  EXPECT_EQ(sheet.at({170.0, 60.0}).red, 0.0);
  EXPECT_EQ(sheet.at({60.0, 130.0}).blue, 1.0);
  EXPECT_EQ(sheet.at({60.0, 130.0}).red, 0.0);
}

TEST(ContactSheet, MakesRoomForTitleAndCaptions) {
  const TemporaryFolder folder;
  write_plain(folder / "a.png", 100, 100, {1.0, 0.0, 0.0});
  const std::vector<Tile> bare = {{folder / "a.png", ""}};
  const std::vector<Tile> told = {{folder / "a.png", "some words that need more than one line of a hundred pixels"}};
  write_contact_sheet(folder / "bare.png", bare, "", tight);
  write_contact_sheet(folder / "told.png", told, "A title", tight);
  EXPECT_EQ(Image(folder / "bare.png").width(), 120);
  EXPECT_EQ(Image(folder / "told.png").width(), 120);
  EXPECT_GT(Image(folder / "told.png").height(), Image(folder / "bare.png").height() + 50);
}

TEST(ContactSheet, NamesThePictureThatCannotBeRead) {
  const TemporaryFolder folder;
  const std::vector<Tile> tiles = {{folder / "missing.png", ""}};
  try {
    write_contact_sheet(folder / "sheet.png", tiles);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("missing.png"), std::string::npos);
  }
}

TEST(ContactSheet, RefusesAnEmptySheet) { EXPECT_THROW(write_contact_sheet("sheet.png", {}), std::invalid_argument); }

}  // namespace
}  // namespace talus::contact_sheet_test
