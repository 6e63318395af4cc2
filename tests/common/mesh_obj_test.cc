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
