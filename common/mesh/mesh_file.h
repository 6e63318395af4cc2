#pragma once
// Meshes and their convex parts in Wavefront OBJ files.

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/math/vector.h"
#include "common/mesh/mesh.h"

namespace talus {

/// Cuts a face, given as indices of corners in order, into triangles without new corners, by clipping ears. The face
/// may be concave; it should be nearly flat and not cross itself (else its triangles may overlap). Every edge of the
/// face, collinear ones too, is the edge of one triangle. Time grows with the square of the corners.
std::vector<std::array<int, 3>> face_triangles(std::span<const int> face, std::span<const Vec3> corners);

/// All surfaces of an OBJ file as one mesh, polygons cut into triangles, as it stands in the file: not yet repaired().
/// Throws std::invalid_argument as checked_obj_text() does, and with the file's name when it holds no surface.
Mesh read_mesh(const std::filesystem::path& file);

/// Where the convex parts of a mesh file lie: bunny.obj has them in bunny.parts.obj.
std::filesystem::path parts_file(const std::filesystem::path& mesh_file);

/// With what a file of parts begins.
inline constexpr const char* parts_mark = "# convex parts of mesh ";

/// Convex parts as a file has them: one OBJ object each, and the hash of the mesh that they were made of.
std::string parts_text(const Mesh& mesh, const std::vector<Mesh>& parts);

/// Writes that, or replaces a file as a whole. Throws std::runtime_error when it cannot be written.
void write_parts(const std::filesystem::path& file, const Mesh& mesh, const std::vector<Mesh>& parts);

/// Reads them back, each with its own corners. Throws std::invalid_argument when there is no such file, or when it was
/// made of another mesh.
std::vector<Mesh> read_parts(const std::filesystem::path& file, const Mesh& mesh);

}  // namespace talus
