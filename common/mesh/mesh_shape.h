#pragma once
// Bodies shaped like a mesh file.

#include <filesystem>
#include <string>

#include "common/mesh/mesh.h"

namespace talus {

struct MeshParams {
  double size = 1.0;     // longest side of its bounding box [m]
  std::string up = "y";  // the file's axis that points up
  double detail = 0.02;  // of the silhouette, 2D only [m]
};

/// The mesh scaled to `size`, z up.
Mesh fitted(const Mesh& mesh, const MeshParams& params);

/// The shape of a mesh file. Masses are those of the mesh (3D) or its silhouette (2D). In 3D it touches others with its
/// convex parts, read from parts_file(), which `talus decompose` makes; they reach out over hollows a little.
/// Throws std::invalid_argument as read_mesh(), repaired(), read_parts() and make_shape() do.
template <int Dim>
Shape<Dim> make_mesh_shape(std::string name, const std::filesystem::path& file, const MeshParams& params,
                           const Material& material);

}  // namespace talus
