// The two files of a picture, as a whole.

#include "tools/picture/picture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

#include "tests/common/temporary_folder.h"
#include "tests/picture/sample.h"
#include "tools/picture/force_chains.h"
#include "tools/picture/page.h"
#include "tools/picture/periodic_sides.h"

namespace talus::picture_test {
namespace {

const PictureParams small = {.width = 500, .height = 400, .margin = 16.0, .font_size = 9.0};

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++found;
  return found;
}

/// Areas of a colour [%]: cairo 1.16 writes it as a style, cairo 1.18 as an attribute.
std::size_t fills(const std::string& svg, int red, int green, int blue) {
  return count(svg, fmt::format("fill:rgb({}%,{}%,{}%)", red, green, blue)) +
         count(svg, fmt::format("fill=\"rgb({}%, {}%, {}%)\"", red, green, blue));
}

/// cairo 1.18 numbers images over all pictures of a process.
std::string without_image_numbers(const std::string& svg) {
  return std::regex_replace(svg, std::regex("source-[0-9]+"), "");
}

template <int Dim>
Layout<Dim> layout_of(const PictureInput<Dim>& input, const PictureParams& params) {
  PageContent content;
  content.title = input.title;
  content.caption = input.caption;
  return lay_out(framing_of(input), Page(content, params), params);
}

/// Body 0 of a sample asleep and body 1 awake, and the colours that the picture shows there.
template <int Dim>
std::pair<Colour, Colour> colours_of_asleep_and_awake(double distance) {
  const TemporaryFolder folder;
  Sample<Dim> sample;
  sample.add(Vec<Dim>::Unit(Dim - 1) * 0.7, true);
  sample.add(Vec<Dim>::Unit(Dim - 1) * 0.7 + Vec<Dim>::Unit(0) * distance, false);
  draw_pile<Dim>(folder / "a.svg", folder / "a.png", sample.input(), small);
  const PngImage image(folder / "a.png");
  const Projection<Dim> projection = layout_of<Dim>(sample.input(), small).projection;
  // A point of the lying arm: in 2D its middle, in 3D just under its upper face.
  Vec<Dim> arm = sample.shapes[0].reference;
  arm[0] += 0.7;
  arm[Dim - 1] += Dim == 2 ? 0.2 : 0.39;
  const auto colour = [&](std::size_t body) { return image.at(projection.on_page(sample.states.pose[body] * arm)); };
  return {colour(0), colour(1)};
}

TEST(Picture, ShowsSleepersDarkAndAwakeBodiesWarm) {
  for (const auto& [asleep, awake] : {colours_of_asleep_and_awake<2>(3.0), colours_of_asleep_and_awake<3>(3.0)}) {
    EXPECT_LT(asleep.red + asleep.green + asleep.blue, 0.9);
    EXPECT_GT(awake.red + awake.green, 1.0);
    EXPECT_GT(awake.red, awake.blue + 0.25);
  }
}

/// Two bodies with a contact of 2 N and one of 2 N, and what the picture has halfway between their middles.
template <int Dim>
Colour colour_between(bool contacts) {
  const TemporaryFolder folder;
  Sample<Dim> sample;
  sample.add_rows(2);
  PictureInput<Dim> input = sample.input();
  const Vec<Dim> middle = 0.5 * (sample.states.pose[1].position + sample.states.pose[2].position);
  if (contacts) input.contacts.assign(2, {.a = 1, .b = 2, .point = middle, .normal_force = 2.0 * Vec<Dim>::Unit(0)});
  draw_pile<Dim>(folder / "a.svg", folder / "a.png", input, small);
  return PngImage(folder / "a.png").at(layout_of<Dim>(sample.input(), small).projection.on_page(middle));
}

TEST(Picture, DrawsAForceChainBetweenTheMiddlesOfBodiesThatTouch) {
  const auto strong = [](const Colour& colour) {
    const Colour& as = PictureParams().strong_force;
    return std::abs(colour.red - as.red) + std::abs(colour.green - as.green) + std::abs(colour.blue - as.blue) < 0.1;
  };
  EXPECT_TRUE(strong(colour_between<2>(true)));
  EXPECT_TRUE(strong(colour_between<3>(true)));
  EXPECT_FALSE(strong(colour_between<2>(false)));
  EXPECT_FALSE(strong(colour_between<3>(false)));
}

TEST(Picture, WritesTheForceOfAStrongLineInTheLegend) {
  Sample<2> sample;
  sample.add_rows(2);
  PictureInput<2> input = sample.input();
  EXPECT_EQ(force_scale(input), 0.0);
  for (int i = 0; i < 5; ++i)
    input.contacts.push_back({.a = 0, .b = ground_index, .normal_force = Vec2(0.0, 100.0 * i + 1.0)});
  EXPECT_EQ(force_scale(input), 400.0) << "the one of five above 301 N, with two digits";
  input.contacts.push_back(input.contacts.back());
  input.contacts.back().b = 1;
  input.force_scale = 7.0;
  EXPECT_EQ(force_scale(input), 7.0);
}

TEST(Picture, SaysHowManyBodiesLieBeyondItsFraming) {
  Sample<2> sample;
  sample.add({0.0, 1.0}, true);
  sample.add({3.0, 1.0}, false);
  sample.add({9.0, 1.0}, false);
  sample.add({0.0, 5.0}, false);
  sample.states.removed[3] = 1;
  const PageContent content = page_content<2>(sample.input(), {Vec2(-1.0, 0.0), Vec2(4.0, 2.0)}, small);
  EXPECT_EQ(content.asleep, 1);
  EXPECT_EQ(content.awake, 2);
  EXPECT_EQ(content.outside, 1);
  EXPECT_EQ(content.farthest, 5.0);
}

TEST(Picture, HoldsEachBodyOnceAsVectorsIn2D) {
  const TemporaryFolder folder;
  Sample<2> sample;
  sample.add_rows(5);
  sample.states.removed[3] = 1;
  PictureParams params;
  params.asleep = {1.0, 0.0, 0.0};
  params.awake = {{0.0, 1.0, 0.0}};
  draw_pile<2>(folder / "a.svg", folder / "a.png", sample.input(), params);
  const std::string svg = bytes_of(folder / "a.svg");
  // 10 asleep and 10 awake, one of those removed; the legend adds a swatch of each.
  EXPECT_EQ(fills(svg, 100, 0, 0), 11U);
  EXPECT_EQ(fills(svg, 0, 100, 0), 10U);
}

/// A body that sleeps at the upper of two periodic sides, and the colour of the picture at its image behind the lower.
template <int Dim>
Colour colour_of_image(double period) {
  const TemporaryFolder folder;
  Sample<Dim> sample;
  sample.add(Vec<Dim>::Unit(Dim - 1) * 0.7, false);
  sample.add(Vec<Dim>::Unit(Dim - 1) * 0.7 + Vec<Dim>::Unit(0) * 2.9, true);
  PictureInput<Dim> input = sample.input();
  input.sides.low = -Vec<Dim>::Unit(0);
  input.sides.period = Vec<Dim>::Unit(0) * period;
  draw_pile<Dim>(folder / "a.svg", folder / "a.png", input, small);
  Vec<Dim> arm = sample.shapes[0].reference;
  arm[0] += 0.7;
  arm[Dim - 1] += Dim == 2 ? 0.2 : 0.39;
  const Vec<Dim> seen = sample.states.pose[1] * arm - input.sides.period;
  return PngImage(folder / "a.png").at(layout_of<Dim>(with_images(input), small).projection.on_page(seen));
}

TEST(Picture, DrawsABodyThatReachesThroughAPeriodicSideBehindTheOppositeOneToo) {
  const auto dark = [](const Colour& colour) { return colour.red + colour.green + colour.blue < 0.9; };
  EXPECT_TRUE(dark(colour_of_image<2>(4.0)));
  EXPECT_TRUE(dark(colour_of_image<3>(4.0)));
  EXPECT_FALSE(dark(colour_of_image<2>(6.0))) << "the body reaches to 4 m, the side is at 5 m";
  EXPECT_FALSE(dark(colour_of_image<3>(6.0)));
}

TEST(Picture, ShowsPeriodicSidesFromEdgeToEdgeAndCountsBodiesOnce) {
  Sample<3> sample;
  sample.add({2.9, 4.9, 0.7}, true);
  sample.obstacles.push_back({sample.shapes[0], {Vec3(3.0, 0.0, 0.7), identity_rotation<3>()}});
  PictureInput<3> input = sample.input();
  input.sides = {.low = Vec3(-1.0, -5.0, 0.0), .period = Vec3(4.0, 10.0, 0.0)};
  const PictureInput<3> all = with_images(input);
  EXPECT_EQ(all.states.size(), 4) << "a body at an edge of two sides has three images";
  EXPECT_EQ(all.obstacles.size(), 2U);
  const Framing<3> framing = framing_of(all);
  EXPECT_LE(framing.box.min().x(), -1.0);
  EXPECT_GE(framing.box.max().y(), 5.0);
  EXPECT_EQ(outlines_of(input.sides, framing.box).size(), 4U);
  const PageContent content = page_content<3>(input, framing.box, small);
  EXPECT_EQ(content.asleep, 1);
  EXPECT_TRUE(content.sides);
}

template <int Dim>
void expect_same_bytes() {
  const TemporaryFolder folder;
  Sample<Dim> sample;
  sample.add_rows(3);
  sample.add_pile(30.0);
  draw_pile<Dim>(folder / "a.svg", folder / "a.png", sample.input(), small);
  draw_pile<Dim>(folder / "b.svg", folder / "b.png", sample.input(), small);
  EXPECT_FALSE(bytes_of(folder / "a.svg").empty());
  EXPECT_EQ(without_image_numbers(bytes_of(folder / "a.svg")), without_image_numbers(bytes_of(folder / "b.svg")));
  EXPECT_EQ(bytes_of(folder / "a.png"), bytes_of(folder / "b.png"));
}

TEST(Picture, IsTheSameBytesForTheSameInput) {
  expect_same_bytes<2>();
  expect_same_bytes<3>();
}

template <int Dim>
void expect_drawn(const Sample<Dim>& sample) {
  const TemporaryFolder folder;
  draw_pile<Dim>(folder / "a.svg", folder / "a.png", sample.input(), small);
  const PngImage image(folder / "a.png");
  EXPECT_EQ(image.width(), small.width);
  EXPECT_LE(image.height(), small.height);
  const std::string svg = bytes_of(folder / "a.svg");
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

template <int Dim>
void expect_all_kinds_drawn() {
  Sample<Dim> sample;
  expect_drawn(sample);
  sample.add_pile(50.0);
  expect_drawn(sample);
  sample.add(Vec<Dim>::Zero(), true);
  expect_drawn(sample);
  sample.add(Vec<Dim>::Constant(1e6), false);
  expect_drawn(sample);
  sample.obstacles.push_back({make_shape<Dim>("slab", box_pieces<Dim>(Vec<Dim>::Constant(500.0)), Material{}), {}});
  expect_drawn(sample);
}

TEST(Picture, CanBeDrawnOfNothingOfAPileOfStraysAndWithinAHugeObstacle) {
  expect_all_kinds_drawn<2>();
  expect_all_kinds_drawn<3>();
}

TEST(Picture, NamesTheFileThatCannotBeWritten) {
  const Sample<2> sample;
  try {
    draw_pile<2>("/nowhere/a.svg", "/nowhere/a.png", sample.input());
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/nowhere/a.svg: cannot be written: No such file or directory");
  }
}

TEST(Picture, RefusesParametersByFieldValueAndRule) {
  PictureParams params;
  params.width = 10;
  try {
    draw_pile<2>("a.svg", "a.png", Sample<2>().input(), params);
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "picture.width = 10: must be 200 to 8000 px");
  }
}

}  // namespace
}  // namespace talus::picture_test
