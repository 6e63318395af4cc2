#include "common/mesh/mesh_shape.h"

#include <fmt/format.h>

#include "common/math/require.h"
#include "common/mesh/mesh.h"
#include "common/mesh/mesh_file.h"
#include "common/mesh/parts_volume.h"
#include "common/mesh/silhouette.h"
#include "common/shape/catalogue.h"

namespace talus {
namespace {

Mesh scaled(Mesh mesh, double factor, bool y_up) {
  for (Vec3& corner : mesh.corners) corner = factor * (y_up ? Vec3(corner.x(), -corner.z(), corner.y()) : corner);
  return mesh;
}

}  // namespace

Mesh fitted(const Mesh& mesh, const MeshParams& params) {
  require(std::isfinite(params.size) && params.size > 0.0, "mesh.size", params.size, "must be finite and above 0 m");
  return scaled(mesh, params.size / longest_side(mesh), params.up == "y");
}

template <>
Shape<3> make_mesh_shape(std::string name, const std::filesystem::path& file, const MeshParams& params,
                         const Material& material) {
  const Mesh mesh = repaired(read_mesh(file));
  const Mesh body = fitted(mesh, params);
  const double factor = params.size / longest_side(mesh);
  const std::vector<Mesh> parts = read_parts(parts_file(file), mesh);
  const double ratio = volume_ratio(parts, mesh);
  require(fills_mesh(ratio, parts_refused), "parts of mesh", parts_file(file).string(),
          fmt::format("must have the mesh's volume within {:.0f} %, but have {:.3g} times that; make them again with "
                      "`talus decompose`",
                      100.0 * parts_refused, ratio));
  std::vector<Piece<3>> pieces;
  for (const Mesh& part : parts)
    pieces.push_back(hull_pieces<3>(scaled(part, factor, params.up == "y").corners).front());
  const Moments<3> integrals = moments(body);
  Shape<3> shape = make_shape<3>(std::move(name), std::move(pieces), material,
                                 {integrals.volume, integrals.centre, integrals.inertia()});
  shape.filling = ratio;
  return shape;
}

template <>
Shape<2> make_mesh_shape(std::string name, const std::filesystem::path& file, const MeshParams& params,
                         const Material& material) {
  const Mesh body = fitted(repaired(read_mesh(file)), params);
  return make_shape<2>(std::move(name), polygon_pieces<2>(silhouette(body, params.detail)), material);
}

}  // namespace talus
