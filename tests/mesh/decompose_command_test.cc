#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/mesh/mesh_shape.h"
#include "tests/common/temporary_folder.h"
#include "tools/commands/commands.h"

namespace talus::decompose_command_test {
namespace {

namespace fs = std::filesystem;

void decompose(const std::string& arguments) {
  CLI::App app;
  int exit_code = exit_codes::success;
  add_decompose_command(app, exit_code);
  app.parse("decompose " + arguments, false);
}

TEST(DecomposeCommand, MakesThePartsThatASceneNeeds) {
  const TemporaryFolder folder;
  const fs::path mesh = folder / "bunny.obj";
  fs::copy_file(fs::path(TALUS_SOURCE_DIR) / "scenes/shapes/bunny.obj", mesh);
  testing::internal::CaptureStdout();
  decompose(mesh.string() + " --parts 4 --corners 10");
  const std::string text = testing::internal::GetCapturedStdout();
  EXPECT_NE(text.find("252 corners, 500 triangles"), std::string::npos) << text;
  const Shape<3> bunny = make_mesh_shape<3>("bunny", mesh, {}, {});
  const std::string count = "parts: " + std::to_string(bunny.pieces.size()) + ", volume of their union";
  EXPECT_NE(text.find(count), std::string::npos) << text;
  EXPECT_NEAR(bunny.bounds.sizes().maxCoeff(), 1.0, 0.1);
}

TEST(DecomposeCommand, ReplacesOtherPartsOfTheSameMeshOnlyByForce) {
  const TemporaryFolder folder;
  const fs::path parts = folder / "tetrahedron.parts.obj";
  const auto write_mesh = [&](int height) {
    std::ofstream(folder / "tetrahedron.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 " << height << "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  };
  testing::internal::CaptureStdout();
  write_mesh(1);
  decompose(folder / "tetrahedron.obj");
  const auto whole = fs::file_size(parts);
  decompose(folder / "tetrahedron.obj");
  std::ofstream(parts, std::ios::app) << "# by hand\n";
  EXPECT_THROW(decompose(folder / "tetrahedron.obj"), std::invalid_argument);
  EXPECT_EQ(fs::file_size(parts), whole + 10);
  decompose((folder / "tetrahedron.obj") + " --force");
  EXPECT_EQ(fs::file_size(parts), whole);
  write_mesh(2);
  EXPECT_NO_THROW(decompose(folder / "tetrahedron.obj")) << "the old parts are of no use any more";
  testing::internal::GetCapturedStdout();
}

// Two shells that overlap: the mesh counts the overlap twice, its parts do not.
TEST(DecomposeCommand, ThatFailsLeavesAnOlderFileOfPartsAsItIs) {
  const TemporaryFolder folder;
  std::ofstream mesh(folder / "boxes.obj");
  for (const double at : {0.0, 0.2}) {
    for (int i = 0; i < 8; ++i)
      mesh << "v " << at + (i & 1) << ' ' << at / 2 + (i >> 1 & 1) << ' ' << at / 2 + (i >> 2) << '\n';
    mesh << "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n";
  }
  mesh.close();
  EXPECT_THROW(decompose(folder / "boxes.obj"), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder / "boxes.parts.obj"));
  std::ofstream(folder / "boxes.parts.obj") << "older";
  EXPECT_THROW(decompose(folder / "boxes.obj"), std::runtime_error);
  EXPECT_EQ(fs::file_size(folder / "boxes.parts.obj"), 5u);
}

TEST(DecomposeCommand, RefusesWhatIsNoMesh) {
  EXPECT_THROW(decompose("nowhere.obj"), std::invalid_argument);
  EXPECT_THROW(decompose("nowhere.obj --parts 0"), CLI::ValidationError);
}

}  // namespace
}  // namespace talus::decompose_command_test
