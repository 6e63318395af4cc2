#include "common/mesh/mesh_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

#include "common/math/require.h"
#include "common/mesh/mesh.h"
#include "common/mesh/obj_text.h"
#include "common/shape/polygon.h"
#include "common/text/file.h"

namespace talus {
namespace {

// The face seen against its normal, so that it runs counter-clockwise.
std::vector<Vec2> flattened(std::span<const int> face, std::span<const Vec3> corners) {
  const auto corner = [&](std::size_t i) { return corners[face[i % face.size()]]; };
  Vec3 normal = Vec3::Zero();
  for (std::size_t i = 0; i < face.size(); ++i) normal += (corner(i) - corner(0)).cross(corner(i + 1) - corner(0));
  const Vec3 right = normal.norm() > 0.0 ? normal.unitOrthogonal() : Vec3::UnitX();
  const Vec3 up = normal.norm() > 0.0 ? Vec3(normal.normalized().cross(right)) : Vec3::UnitY();
  std::vector<Vec2> flat;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 from_first = corner(i) - corner(0);
    flat.emplace_back(right.dot(from_first), up.dot(from_first));
  }
  return flat;
}

bool in_triangle(const Vec2& point, const Vec2& a, const Vec2& b, const Vec2& c) {
  const bool within = cross(a, b, point) >= 0.0 && cross(b, c, point) >= 0.0 && cross(c, a, point) >= 0.0;
  return within && point != a && point != b && point != c;
}

// The corners that are left, as places in `flat`, and the current one.
bool is_ear(const std::vector<std::size_t>& left, std::size_t at, const std::vector<Vec2>& flat) {
  const Vec2& before = flat[left[(at + left.size() - 1) % left.size()]];
  const Vec2& here = flat[left[at]];
  const Vec2& after = flat[left[(at + 1) % left.size()]];
  return cross(before, here, after) > 0.0 && std::none_of(left.begin(), left.end(), [&](std::size_t other) {
           return in_triangle(flat[other], before, here, after);
         });
}

}  // namespace

std::vector<std::array<int, 3>> face_triangles(std::span<const int> face, std::span<const Vec3> corners) {
  const std::vector<Vec2> flat = flattened(face, corners);
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < face.size(); ++i) left.push_back(i);
  std::vector<std::array<int, 3>> triangles;
  // Of a face that does not cross itself, clipping an ear can make ears of its two neighbours only (O'Rourke 1998).
  std::vector<bool> no_ear(face.size(), false);
  std::size_t at = 1;
  std::size_t tried = 0;
  while (left.size() >= 3) {
    at %= left.size();
    // What has no ear is flat or crosses itself; any corner will do then.
    if (tried < left.size() && left.size() > 3 && (no_ear[left[at]] || !is_ear(left, at, flat))) {
      no_ear[left[at]] = true;
      ++at;
      ++tried;
      continue;
    }
    const std::size_t size = left.size();
    const std::size_t before = left[(at + size - 1) % size];
    const std::size_t after = left[(at + 1) % size];
    triangles.push_back({face[before], face[left[at]], face[after]});
    no_ear[before] = no_ear[after] = false;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    tried = tried < size ? 0 : tried;
  }
  return triangles;
}

namespace {

struct ObjFile {
  std::vector<Vec3> corners;
  std::vector<std::vector<std::array<int, 3>>> objects;  // triangles of each object or group
};

std::vector<std::array<int, 3>> triangles_of(const tinyobj::mesh_t& mesh, std::span<const Vec3> corners) {
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> face;
  auto index = mesh.indices.begin();
  for (const unsigned count : mesh.num_face_vertices) {
    face.clear();
    for (unsigned i = 0; i < count; ++i, ++index) face.push_back(index->vertex_index);
    const auto cut = face_triangles(face, corners);
    triangles.insert(triangles.end(), cut.begin(), cut.end());
  }
  return triangles;
}

ObjFile read_obj(const std::filesystem::path& file) {
  std::istringstream text(checked_obj_text(file));
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warnings;
  std::string errors;
  // tinyobj's own triangles are not used: of some concave faces they leave the surface open.
  const bool ok = tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, &text, nullptr, false, false);
  require(ok, "mesh file", file.string(), "must be a readable Wavefront OBJ file. " + errors);
  ObjFile result;
  const std::vector<double>& values = attributes.vertices;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    result.corners.emplace_back(values[i], values[i + 1], values[i + 2]);
  for (const tinyobj::shape_t& shape : shapes) result.objects.push_back(triangles_of(shape.mesh, result.corners));
  return result;
}

// The corners that `triangles` use, numbered in the order of their first use.
Mesh mesh_of(const std::vector<Vec3>& corners, std::vector<std::array<int, 3>> triangles) {
  Mesh mesh;
  std::unordered_map<int, int> number_of;
  for (auto& triangle : triangles) {
    for (int& corner : triangle) {
      const auto [entry, is_new] = number_of.try_emplace(corner, static_cast<int>(mesh.corners.size()));
      if (is_new) mesh.corners.push_back(corners[corner]);
      corner = entry->second;
    }
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

std::string header(const Mesh& mesh) { return fmt::format("{}{:016x}", parts_mark, content_hash(mesh)); }

}  // namespace

Mesh read_mesh(const std::filesystem::path& file) {
  ObjFile obj = read_obj(file);
  Mesh whole;
  for (const auto& object : obj.objects) whole.triangles.insert(whole.triangles.end(), object.begin(), object.end());
  whole.corners = std::move(obj.corners);
  require(!whole.triangles.empty(), "mesh file", file.string(), "must hold faces");
  return whole;
}

std::filesystem::path parts_file(const std::filesystem::path& mesh_file) {
  std::filesystem::path result = mesh_file;
  return result.replace_extension(".parts.obj");
}

std::string parts_text(const Mesh& mesh, const std::vector<Mesh>& parts) {
  std::string text = header(mesh) + '\n';
  int first = 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text += fmt::format("o part_{}\n", i);
    for (const Vec3& corner : parts[i].corners) text += fmt::format("v {} {} {}\n", corner.x(), corner.y(), corner.z());
    for (const auto& triangle : parts[i].triangles)
      text += fmt::format("f {} {} {}\n", triangle[0] + first, triangle[1] + first, triangle[2] + first);
    first += static_cast<int>(parts[i].corners.size());
  }
  return text;
}

void write_parts(const std::filesystem::path& file, const Mesh& mesh, const std::vector<Mesh>& parts) {
  write_file(file, parts_text(mesh, parts));
}

std::vector<Mesh> read_parts(const std::filesystem::path& file, const Mesh& mesh) {
  std::error_code unused;
  require(!std::filesystem::exists(file, unused) || std::filesystem::is_regular_file(file, unused), "parts of mesh",
          file.string(), readable_rule);
  const std::string expected = header(mesh) + '\n';
  std::string found(expected.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  const bool readable = static_cast<bool>(in) && in.read(found.data(), static_cast<std::streamsize>(found.size()));
  const std::string command = "as `talus decompose` does";
  require(readable || in.gcount() > 0, "parts of mesh", file.string(), "must be made first, " + command);
  require(found == expected, "parts of mesh", file.string(),
          "must be made again, " + command + ": the mesh has changed");
  const ObjFile obj = read_obj(file);
  std::vector<Mesh> parts;
  for (const auto& object : obj.objects) parts.push_back(repaired(mesh_of(obj.corners, object)));
  return parts;
}

}  // namespace talus
