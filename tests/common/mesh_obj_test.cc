// Wavefront OBJ files, sound and damaged.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "common/mesh/mesh.h"
#include "common/mesh/mesh_file.h"
#include "common/mesh/obj_text.h"
#include "common/mesh/parts_volume.h"
#include "tests/common/temporary_folder.h"

namespace talus::mesh_obj_test {
namespace {

const std::string tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// A prism of unit height over a polygon, its two ends one face each.
std::string prism(const std::vector<Vec2>& outline) {
  const std::size_t count = outline.size();
  std::string text;
  std::string bottom = "f";
  std::string top = "f";
  std::string sides;
  for (std::size_t i = 0; i < 2 * count; ++i)
    text += fmt::format("v {} {} {}\n", outline[i % count].x(), outline[i % count].y(), i / count);
  for (std::size_t i = 1; i <= count; ++i) {
    const std::size_t next = i % count + 1;
    bottom += fmt::format(" {}", count + 1 - i);
    top += fmt::format(" {}", count + i);
    sides += fmt::format("f {} {} {} {}\n", i, next, next + count, i + count);
  }
  return text + bottom + "\n" + top + "\n" + sides;
}

class ObjFile : public testing::Test {
 protected:
  Mesh read(const std::string& text) {
    std::ofstream(file_, std::ios::binary) << text;
    return repaired(read_mesh(file_));
  }
  /// What is said about a file that must be refused.
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "was read";
  }
  void expect_refused(const std::string& text, const std::string& part) {
    const std::string told = refusal(text);
    EXPECT_NE(told.find(part), std::string::npos) << told;
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "mesh.obj";
};

TEST_F(ObjFile, WithACornerThatIsNotThreeFiniteNumbersIsRefusedWithItsLine) {
  for (const char* corner : {"v inf 0 0", "v 0 nan 0", "v 0 0 1e999", "v 0 0", "v 0 0 0x1", "v a b c"}) {
    SCOPED_TRACE(corner);
    expect_refused("# a comment\r\n" + std::string(corner) + "\n" + tetrahedron, "mesh.obj:2: a corner must be three");
  }
}

TEST_F(ObjFile, WithAFaceOfLessThanThreeCornersIsRefusedWithItsLine) {
  for (const char* face : {"f", "f 1", "f 1 2", "f 1/1 2/2"}) {
    SCOPED_TRACE(face);
    expect_refused(tetrahedron + face + "\n", "mesh.obj:9: a face must have 3 to 255 corners");
  }
}

TEST_F(ObjFile, WithAFaceOfACornerThatDoesNotExistIsRefusedWithItsLine) {
  expect_refused(tetrahedron + "f 1 2 5\n", "mesh.obj:9: a face's corner must be one of the file's 4 corners, not 5");
  expect_refused(tetrahedron + "f 1 2 0\n", "mesh.obj:9: a face's corner must be the number of a corner");
  expect_refused(tetrahedron + "f 1 2 -5\n", "mesh.obj:9");
  expect_refused(tetrahedron + "f 1 2 x\033[2J\n", "not x?[2J");
}

TEST_F(ObjFile, WithAHugeFaceIsRefused) {
  std::string face = "f";
  for (int i = 0; i < 100000; ++i) face += fmt::format(" {}", i % 4 + 1);
  expect_refused(tetrahedron + face + "\n", "mesh.obj:9: a face must have 3 to 255 corners, not 100000");
}

TEST_F(ObjFile, AboveTheLargestSizeIsRefusedUnread) {
  std::ofstream(file_) << tetrahedron;
  std::filesystem::resize_file(file_, largest_obj_file + 1);
  EXPECT_THROW(read_mesh(file_), std::invalid_argument);
}

TEST_F(ObjFile, IsReadWithoutTheFilesThatItNames) {
  EXPECT_NEAR(moments(read("mtllib /dev/zero\nusemtl any\n" + tetrahedron)).volume, 1.0 / 6.0, 1e-12);
}

/// Corners -1 to 1, faces of four corners.
const std::string cube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// `text` with each `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

TEST_F(ObjFile, IsReadAsOtherProgramsWriteIt) {
  const std::string unended = cube.substr(0, cube.size() - 1);
  for (const auto& [how, text] : std::vector<std::pair<std::string, std::string>>{
           {"a byte order mark", "\xEF\xBB\xBF" + cube},
           {"continued lines", with(cube, " ", " \\\n ")},
           {"continued lines of Windows", with(cube, " ", "\\\r\n ")},
           {"comments at the ends of lines", with(cube, "\n", " # of a cube\n")},
           {"comments without a blank", with(cube, "\n", "\t# of a cube\n# a\n")},
           {"tabs and trailing blanks", with(with(cube, " ", "\t"), "\n", " \t\n")},
           {"lines of Windows", with(cube, "\n", "\r\n")},
           {"lines of old Macs", with(cube, "\n", "\r")},
           {"no line end at the end", unended},
           {"a backslash at the end", unended + "\\"},
           {"colours", with(with(cube, "1\nv", "1 0.5 0.5 0.5\nv"), "1\nf 1 4", "1 0.5 0.5 0.5\nf 1 4")},
           {"a weight", with(cube, "1\nv", "1 1.0\nv")},
           {"normals", "vn 0 0 1\n" + with(with(cube, "f 1 4 3 2", "f 1//1 4//1 3//1 2//1"), "f 5 6", "f 5//1 6")},
           {"groups and objects", with(cube, "f 5", "g side one\no other #2\ns off\nf 5")}}) {
    SCOPED_TRACE(how);
    const Mesh mesh = read(text);
    EXPECT_EQ(mesh.corners.size(), 8U);
    EXPECT_NEAR(moments(mesh).volume, 8.0, 1e-12);
  }
}

TEST_F(ObjFile, ThatIsNoTextInUtf8IsRefusedWithTheReason) {
  std::string wide;
  for (const char letter : cube) wide += {letter, '\0'};
  expect_refused("\xFF\xFE" + wide, "must be text in UTF-8, not in UTF-16");
  expect_refused(wide, "must be text in UTF-8, but has zero bytes");
  expect_refused("", "must hold faces");
  expect_refused("\xEF\xBB\xBF", "must hold faces");
  expect_refused("v 0 0 1e31\n" + cube, "mesh.obj:1: a corner must be three numbers from -1e30 to 1e30");
}

TEST_F(ObjFile, NamesTheFirstOfContinuedLines) {
  expect_refused("v 0 \\\n0 0\nv 1 \\\n0 x\n", "mesh.obj:3: a corner must be three");
}

/// Cubes of side 1, each with corners of its own, their lowest corners as given.
std::string cubes(const std::vector<Vec3>& places, double size = 1.0) {
  std::string text;
  int first = 1;
  for (const Vec3& place : places) {
    text += fmt::format("o cube{}\n", first);
    for (int i = 0; i < 8; ++i)
      text += fmt::format("v {} {} {}\n", place.x() + size * (i & 1), place.y() + size * (i >> 1 & 1),
                          place.z() + size * (i >> 2));
    for (const auto& f : std::vector<std::array<int, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
      text += fmt::format("f {} {} {} {}\n", first + f[0], first + f[1], first + f[2], first + f[3]);
    first += 8;
  }
  return text;
}

TEST_F(ObjFile, MayHaveClosedPiecesThatTouch) {
  for (const auto& [how, places] : std::vector<std::pair<std::string, std::vector<Vec3>>>{
           {"at a corner", {{0, 0, 0}, {1, 1, 1}}},
           {"at an edge", {{0, 0, 0}, {1, 1, 0}}},
           {"at a face", {{0, 0, 0}, {1, 0, 0}}},
           {"around an edge", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}},
           {"at three edges of one", {{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}}}) {
    SCOPED_TRACE(how);
    const Moments<3> whole = moments(read(cubes(places)));
    Vec3 centre = Vec3::Zero();
    for (const Vec3& place : places) centre += place + Vec3::Constant(0.5);
    EXPECT_NEAR(whole.volume, static_cast<double>(places.size()), 1e-12);
    EXPECT_NEAR((whole.centre - centre / static_cast<double>(places.size())).norm(), 0.0, 1e-12);
  }
}

TEST_F(ObjFile, CountsCornersBackFromTheFace) {
  EXPECT_NEAR(moments(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                           "f -4/1 -2/2 -3/3\nf -4 -3 -1\nf -3 -2 -1\nf -2//1 -4//1 -1//1\n"))
                  .volume,
              1.0 / 6.0, 1e-12);
}

TEST_F(ObjFile, MayHaveConcaveFaces) {
  const std::vector<Vec2> u = {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  EXPECT_NEAR(moments(read(prism(u))).volume, 5.0, 1e-12);
  const std::vector<Vec2> cross = {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                                   {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  EXPECT_NEAR(moments(read(prism(cross))).volume, 5.0, 1e-12);
  const std::vector<Vec2> collinear = {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}};
  EXPECT_NEAR(moments(read(prism(collinear))).volume, 3.0, 1e-12);
}

TEST_F(ObjFile, MayHaveFacesOfTheMostCorners) {
  std::vector<Vec2> circle;
  for (std::size_t i = 0; i < most_face_corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(most_face_corners);
    circle.emplace_back(std::cos(angle), std::sin(angle));
  }
  EXPECT_NEAR(moments(read(prism(circle))).volume, std::numbers::pi, 1e-3);
}

TEST_F(ObjFile, MayHaveAFaceOfManyTeeth) {
  std::vector<Vec2> zigzag;
  for (int i = 0; i < 127; ++i) zigzag.emplace_back(i, i % 2 == 0 ? 5 : 0);
  for (int i = 126; i >= 0; --i) zigzag.emplace_back(i, i % 2 == 0 ? 6 : 1);
  std::reverse(zigzag.begin(), zigzag.end());
  EXPECT_NEAR(moments(read(prism(zigzag))).volume, 126.0, 1e-9);
}

TEST_F(ObjFile, UnionOfPartsCountsOverlapsOnce) {
  const Mesh one = read(prism({{0, 0}, {2, 0}, {2, 1}, {0, 1}}));
  const Mesh other = read(prism({{1, 0}, {3, 0}, {3, 1}, {1, 1}}));
  EXPECT_NEAR(union_volume(std::vector<Mesh>{one, other}), 3.0, 1e-9);
  EXPECT_NEAR(union_volume(std::vector<Mesh>{one}), 2.0, 1e-9);
  EXPECT_EQ(union_volume({}), 0.0);
}

}  // namespace
}  // namespace talus::mesh_obj_test
