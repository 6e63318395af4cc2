#include "tools/mesh/decompose_command.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/mesh/mesh_shape.h"
#include "tests/common/temporary_folder.h"

namespace talus::decompose_command_test {
namespace {

namespace fs = std::filesystem;

void decompose(const std::string& arguments) {
  CLI::App app;
  add_decompose_command(app);
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
  EXPECT_NE(text.find("parts: 4, volumes together"), std::string::npos) << text;
  const Shape<3> bunny = make_mesh_shape<3>("bunny", mesh, {}, {});
  EXPECT_EQ(bunny.pieces.size(), 4u);
  EXPECT_NEAR(bunny.bounds.sizes().maxCoeff(), 1.0, 0.1);
}

TEST(DecomposeCommand, RefusesWhatIsNoMesh) {
  EXPECT_THROW(decompose("nowhere.obj"), std::invalid_argument);
  EXPECT_THROW(decompose("nowhere.obj --parts 0"), CLI::ValidationError);
}

}  // namespace
}  // namespace talus::decompose_command_test
