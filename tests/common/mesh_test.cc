#include "common/mesh/mesh.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>

#include "common/mesh/mesh_file.h"
#include "common/mesh/mesh_shape.h"
#include "common/mesh/silhouette.h"
#include "common/shape/catalogue.h"
#include "common/shape/polygon.h"
#include "common/shape/surface.h"
#include "tests/common/shape_generators.h"
#include "tests/common/temporary_folder.h"

namespace talus::mesh_test {
namespace {

// The surface of a shape as a soup: every face a fan of triangles with corners of its own.
Mesh soup(const Shape<3>& shape, int segments = 8) {
  Mesh mesh;
  for (const Loop<3>& face : faces(shape, segments)) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const int first = static_cast<int>(mesh.corners.size());
      mesh.corners.insert(mesh.corners.end(), {face[0], face[i], face[i + 1]});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  return mesh;
}

const Shape<3> box = make_shape<3>("box", box_pieces<3>({1.0, 2.0, 3.0}), {.density = 1.0});

void expect_refused(const std::function<void()>& call, const std::string& part) {
  try {
    call();
    ADD_FAILURE() << "no mention of " << part;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(MeshRepair, MergesCornersAndDropsTrianglesWithoutAreaOrThereTwice) {
  Mesh mesh = soup(box);
  mesh.corners[4] += Vec3::Constant(1e-9);
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back(mesh.triangles[3]);
  const Mesh whole = repaired(mesh);
  EXPECT_EQ(whole.corners.size(), 8u);
  EXPECT_EQ(whole.triangles.size(), 12u);
  EXPECT_NEAR(moments(whole).volume, 6.0, 1e-7);  // one corner may be the one that was moved
}

RC_GTEST_PROP(MeshRepair, TurnsTrianglesOutwardsWhicheverWayTheyWere, ()) {
  Mesh mesh = soup(box);
  for (auto& triangle : mesh.triangles)
    if (*rc::gen::arbitrary<bool>()) std::swap(triangle[0], triangle[1]);
  const Moments<3> integrals = moments(repaired(mesh));
  RC_ASSERT(std::abs(integrals.volume - 6.0) < 1e-12);
  RC_ASSERT((integrals.inertia() - box.inertia).norm() < 1e-12);
}

TEST(MeshRepair, RefusesWhatHasNoInside) {
  Mesh open = soup(box);
  open.triangles.pop_back();
  expect_refused([&] { repaired(open); }, "single triangle = 3");
  Mesh fin = soup(box);
  fin.corners.push_back({9.0, 9.0, 9.0});
  fin.triangles.push_back({0, 1, static_cast<int>(fin.corners.size()) - 1});
  expect_refused([&] { repaired(fin); }, "more than two triangles = 1");
  const Mesh flat = {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, {{0, 1, 2}, {0, 2, 1}}};
  expect_refused([&] { repaired(flat); }, "mesh volume");
  Mesh infinite = soup(box);
  infinite.corners[5].y() = INFINITY;
  expect_refused([&] { repaired(infinite); }, "must be finite");
  Mesh wrong = soup(box);
  wrong.triangles[2][1] = 999;
  expect_refused([&] { repaired(wrong); }, "999");
  expect_refused([&] { repaired({}); }, "mesh triangles");
}

TEST(Silhouette, OfABoxIsItsFrontFace) {
  const std::vector<Vec2> outline = silhouette(repaired(soup(box)), 1e-3);
  EXPECT_EQ(outline.size(), 4u);
  EXPECT_NEAR(signed_area(outline), 3.0, 1e-5);  // counted in ticks of 2e-7 m
}

TEST(Silhouette, KeepsWhatIsNotConvex) {
  const Shape<3> l = make_shape<3>(
      "l", polygon_pieces<3>(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}}, 0.4), {});
  EXPECT_NEAR(signed_area(silhouette(soup(l), 1e-3)), 0.51, 1e-5);
  EXPECT_THROW(silhouette(soup(l), 0.0), std::invalid_argument);
  EXPECT_THROW(silhouette(soup(l), 100.0), std::invalid_argument);
}

TEST(Silhouette, StraysByTheDetailAtMostAndHasNoMoreCornersThanThatTakes) {
  const Mesh ball = repaired(soup(make_shape<3>("ball", ball_pieces<3>(1.0), {}), 64));
  std::size_t corners_before = 65;
  for (const double detail : {0.001, 0.01, 0.1}) {
    const std::vector<Vec2> outline = silhouette(ball, detail);
    EXPECT_LT(outline.size(), corners_before);
    corners_before = outline.size();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 middle = (outline[i] + outline[(i + 1) % outline.size()]) / 2.0;
      EXPECT_NEAR(outline[i].norm(), 1.0, 1e-6);
      EXPECT_GT(middle.norm(), 1.0 - detail - 0.0013);  // the ball's own 64 corners fall short by 0.0012
    }
  }
}

// An L of the catalogue's default size in a file with y up and a hundredth as unit.
class MeshFile : public testing::Test {
 protected:
  void SetUp() override {
    const std::vector<Vec2> outline = {{0, 0}, {100, 0}, {100, 40}, {40, 40}, {40, 100}, {0, 100}};
    std::ofstream out(file_);
    for (const int depth : {-20, 20})
      for (const Vec2& corner : outline) out << "v " << corner.x() << " " << corner.y() << " " << depth << "\n";
    out << "f 1 2 3 4 5 6\nf 7 8 9 10 11 12\n";  // turned the same way: one is inside out
    for (int i = 1; i <= 6; ++i) {
      const int next = i % 6 + 1;
      out << "f " << i << " " << next << " " << next + 6 << " " << i + 6 << "\n";
    }
  }
  // The two arms in the file's axes, where a z-up box's depth and height change places.
  static std::vector<Mesh> arms() { return {arm({50, 20, 0}, {100, 40, 40}), arm({20, 70, 0}, {40, 60, 40})}; }
  static Mesh arm(const Vec3& centre, const Vec3& size) {
    Mesh mesh = soup(make_shape<3>("arm", box_pieces<3>(size), {}));
    for (Vec3& corner : mesh.corners) corner += centre;
    return repaired(mesh);
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "l.obj";
  MeshParams params_ = {.size = 1.0, .detail = 1e-3};
};

TEST_F(MeshFile, GivesTheShapeThatItDescribesInThePlane) {
  const Shape<2> flat = make_mesh_shape<2>("l", file_, params_, {.density = 1.0});
  const Shape<2> expected = make_shape<2>("l", l_pieces<2>({}), {.density = 1.0});
  EXPECT_NEAR(flat.mass, expected.mass, 1e-5);  // the silhouette is counted in ticks of 1e-7 m
  EXPECT_NEAR(flat.inertia(0, 0), expected.inertia(0, 0), 1e-5);
  EXPECT_EQ(flat.pieces.size(), 2u);
}

TEST_F(MeshFile, GivesTheShapeThatItDescribesInSpaceOnceItsPartsAreMade) {
  const Mesh mesh = repaired(read_mesh(file_));
  write_parts(parts_file(file_), mesh, arms());
  const Shape<3> solid = make_mesh_shape<3>("l", file_, params_, {.density = 1.0});
  const Shape<3> expected = make_shape<3>("l", l_pieces<3>({}), {.density = 1.0});
  EXPECT_NEAR(solid.mass, expected.mass, 1e-12);
  EXPECT_LT((solid.inertia - expected.inertia).norm(), 1e-12);
  EXPECT_TRUE(solid.bounds.isApprox(expected.bounds, 1e-12));
  EXPECT_EQ(solid.pieces.size(), 2u);
}

TEST_F(MeshFile, RefusesPartsThatAreMissingOrMadeOfAnotherMesh) {
  expect_refused([&] { make_mesh_shape<3>("l", file_, params_, {}); }, "l.parts.obj");
  write_parts(parts_file(file_), repaired(soup(box)), arms());
  expect_refused([&] { make_mesh_shape<3>("l", file_, params_, {}); }, "must be made again");
  std::filesystem::remove(parts_file(file_));
  ASSERT_EQ(mkfifo(parts_file(file_).c_str(), 0600), 0);
  expect_refused([&] { make_mesh_shape<3>("l", file_, params_, {}); }, "must be a regular file");
}

TEST_F(MeshFile, RefusesPartsThatDoNotFillTheMesh) {
  const Mesh mesh = repaired(read_mesh(file_));
  write_parts(parts_file(file_), mesh, {arms().front()});
  expect_refused([&] { make_mesh_shape<3>("l", file_, params_, {}); }, "but have 0.625 times that");
  write_parts(parts_file(file_), mesh, {});
  expect_refused([&] { make_mesh_shape<3>("l", file_, params_, {}); }, "but have 0 times that");
}

TEST_F(MeshFile, RefusesParametersAndFilesThatGiveNoShape) {
  expect_refused([&] { make_mesh_shape<2>("l", "nowhere.obj", params_, {}); }, "nowhere.obj");
  expect_refused([&] { make_mesh_shape<2>("l", folder_.path(), params_, {}); }, "mesh file");
  expect_refused([&] { make_mesh_shape<2>("l", file_, {.size = 0.0}, {}); }, "mesh.size");
  std::ofstream(file_) << "v 0 0 0\n";
  expect_refused([&] { make_mesh_shape<2>("l", file_, params_, {}); }, "must hold faces");
}

}  // namespace
}  // namespace talus::mesh_test
