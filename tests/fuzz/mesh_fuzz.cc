// Input: the text of an OBJ file. It is read as a body's shape in 2D, and in 3D with itself as its one convex part.
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "common/mesh/mesh.h"
#include "common/mesh/mesh_file.h"
#include "common/mesh/mesh_shape.h"
#include "common/shape/shape.h"
#include "tests/common/temporary_folder.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/limits.h"

namespace {

using namespace talus;

template <int Dim>
void require_sound(const Shape<Dim>& shape) {
  fuzz::require_that(shape.mass > 0.0 && std::isfinite(shape.mass), "a shape has a finite mass above 0");
  fuzz::require_that(shape.bounds.min().allFinite() && shape.bounds.max().allFinite(), "a shape has finite bounds");
}

void make_shapes(const std::filesystem::path& file, const Mesh& mesh) {
  write_parts(parts_file(file), mesh, {mesh});
  require_sound(make_mesh_shape<2>("mesh", file, {}, {}));
  require_sound(make_mesh_shape<3>("mesh", file, {}, {}));
}

void read_as_mesh(const std::filesystem::path& file, std::string_view input) {
  const fuzz::TimeLimit limit;
  try {
    const Mesh mesh = repaired(read_mesh(file));
    if (fuzz::costly_part_is_due(input)) make_shapes(file, mesh);
  } catch (const std::invalid_argument& error) {
    fuzz::require_that(*error.what() != '\0', "a refused mesh has a reason");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  const std::filesystem::path file = folder / "mesh.obj";
  const std::string_view input = fuzz::text({data, size});
  std::ofstream(file, std::ios::binary) << input;
  read_as_mesh(file, input);
  return 0;
}
