#pragma once
// Bodies shaped like a mesh file.

#include <array>
#include <filesystem>
#include <string>

#include "common/mesh/mesh.h"
#include "common/params/field.h"

namespace talus {

struct MeshParams {
  double size = 1.0;     // longest side of its bounding box [m]
  std::string up = "y";  // the file's axis that points up
  double detail = 0.02;  // of the silhouette, 2D only [m]
};

inline constexpr std::array<std::string_view, 2> mesh_axes = {"y", "z"};

inline constexpr auto mesh_fields = std::to_array<Field<MeshParams>>({
    {{},
     {.name = "file",
      .required = true,
      .type = "text",
      .further_rule = "in or below the scene's folder, or absolute",
      .meaning = "Wavefront OBJ file of a closed surface; one with holes is refused with number and place. The folder "
                 "of a run gets a copy"}},
    {&MeshParams::size,
     {.name = "longest_side",
      .unit = "m",
      .range = length_range,
      .meaning = "the mesh is scaled until its longest side has this length: few files say what their unit is"}},
    {&MeshParams::up, {.name = "up", .choices = mesh_axes, .meaning = "the file's axis that points up"}},
    {&MeshParams::detail,
     {.name = "detail",
      .dimension = 2,
      .elsewhere = "`talus decompose` has made the parts",
      .unit = "m",
      .range = between(1e-3, 1e4),
      .meaning = "how far the outline may deviate from the mesh's silhouette along y. Fine: many pieces, each costs in "
                 "contacts"}},
});

/// The mesh scaled to `size`, z up.
Mesh fitted(const Mesh& mesh, const MeshParams& params);

/// The shape of a mesh file. Masses are those of the mesh (3D) or its silhouette (2D). In 3D it touches others with its
/// convex parts, read from parts_file(), which `talus decompose` makes; they reach out over hollows a little.
/// Throws std::invalid_argument as read_mesh(), repaired(), read_parts() and make_shape() do.
template <int Dim>
Shape<Dim> make_mesh_shape(std::string name, const std::filesystem::path& file, const MeshParams& params,
                           const Material& material);

}  // namespace talus
