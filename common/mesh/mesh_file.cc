#include "common/mesh/mesh_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <fstream>
#include <stdexcept>

#include "common/math/require.h"
#include "common/mesh/mesh_repair.h"

namespace talus {
namespace {

// One mesh for each object or group of the file; every one holds all the file's corners.
std::vector<Mesh> read_objects(const std::filesystem::path& file) {
  tinyobj::ObjReaderConfig config;
  config.triangulate = true;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  const bool ok = std::filesystem::is_regular_file(file) && reader.ParseFromFile(file.string(), config);
  require(ok, "mesh file", file.string(), "must be a readable Wavefront OBJ file. " + reader.Error());
  const std::vector<double>& values = reader.GetAttrib().vertices;
  std::vector<Mesh> objects;
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    Mesh& mesh = objects.emplace_back();
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      mesh.corners.emplace_back(values[i], values[i + 1], values[i + 2]);
    }
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
      mesh.triangles.push_back({shape.mesh.indices[i].vertex_index, shape.mesh.indices[i + 1].vertex_index,
                                shape.mesh.indices[i + 2].vertex_index});
    }
  }
  return objects;
}

std::string header(const Mesh& mesh) { return fmt::format("# convex parts of mesh {:016x}", content_hash(mesh)); }

}  // namespace

Mesh read_mesh(const std::filesystem::path& file) {
  Mesh whole;
  for (Mesh& object : read_objects(file)) {
    whole.triangles.insert(whole.triangles.end(), object.triangles.begin(), object.triangles.end());
    whole.corners = std::move(object.corners);
  }
  require(!whole.triangles.empty(), "mesh file", file.string(), "must hold faces");
  return whole;
}

std::filesystem::path parts_file(const std::filesystem::path& mesh_file) {
  std::filesystem::path result = mesh_file;
  return result.replace_extension(".parts.obj");
}

void write_parts(const std::filesystem::path& file, const Mesh& mesh, const std::vector<Mesh>& parts) {
  std::ofstream out(file);
  out << header(mesh) << '\n';
  int first = 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    out << fmt::format("o part_{}\n", i);
    for (const Vec3& corner : parts[i].corners) {
      out << fmt::format("v {} {} {}\n", corner.x(), corner.y(), corner.z());
    }
    for (const auto& triangle : parts[i].triangles) {
      out << fmt::format("f {} {} {}\n", triangle[0] + first, triangle[1] + first, triangle[2] + first);
    }
    first += static_cast<int>(parts[i].corners.size());
  }
  out.close();
  if (!out) {
    throw std::runtime_error("cannot write " + file.string());
  }
}

std::vector<Mesh> read_parts(const std::filesystem::path& file, const Mesh& mesh) {
  std::string line;
  std::ifstream in(file);
  const std::string command = "as `talus decompose` does";
  require(static_cast<bool>(std::getline(in, line)), "parts of mesh", file.string(), "must be made first, " + command);
  require(line == header(mesh), "parts of mesh", file.string(),
          "must be made anew, " + command + ": the mesh has changed");
  std::vector<Mesh> parts;
  for (const Mesh& object : read_objects(file)) {
    parts.push_back(repaired(object));
  }
  return parts;
}

}  // namespace talus
