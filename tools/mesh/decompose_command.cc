#include "tools/mesh/decompose_command.h"

#include <algorithm>
#include <memory>

#include "common/mesh/mesh_file.h"
#include "common/mesh/mesh_repair.h"
#include "common/shape/convex_hull.h"
#include "tools/mesh/convex_parts.h"
#include "tools/output/output.h"

namespace talus {

namespace {

double hull_volume(const Mesh& mesh) {
  std::vector<std::array<int, 3>> triangles;
  for (const std::vector<int>& face : convex_hull_faces(mesh.corners)) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) triangles.push_back({face[0], face[i], face[i + 1]});
  }
  return moments_within<3>(mesh.corners, triangles).volume;
}

void tell(const Mesh& mesh, const std::vector<Mesh>& parts, const std::filesystem::path& file) {
  const double volume = moments(mesh).volume;
  double sum = 0.0;
  std::size_t most = 0;
  for (const Mesh& part : parts) {
    sum += moments(part).volume;
    most = std::max(most, part.corners.size());
  }
  print_result("mesh: {} corners, {} triangles, volume {:.4g}, its hull {:.3g} times that\n", mesh.corners.size(),
               mesh.triangles.size(), volume, hull_volume(mesh) / volume);
  print_result("parts: {}, volumes together {:.3g} times the mesh's, {} corners at most\n", parts.size(), sum / volume,
               most);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    print_result("  part {}: {} corners, volume {:.3g} times the mesh's\n", i, parts[i].corners.size(),
                 moments(parts[i]).volume / volume);
  }
  print_result("{}\n", file.string());
}

void decompose(const std::filesystem::path& mesh_file, const ConvexPartsParams& params) {
  const Mesh mesh = repaired(read_mesh(mesh_file));
  const std::vector<Mesh> parts = convex_parts(mesh, params);
  write_parts(parts_file(mesh_file), mesh, parts);
  tell(mesh, parts, parts_file(mesh_file));
}

}  // namespace

void add_decompose_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("decompose", "Cut a mesh into the convex parts with which it collides in 3D scenes");
  command->footer(
      "Writes MESH.parts.obj beside MESH.obj; a scene in 3D with the mesh needs it. To be made anew when the mesh\n"
      "changes. Look at how far the parts' volumes together are from 1: more parts follow the surface better.");
  auto mesh = std::make_shared<std::string>();
  auto params = std::make_shared<ConvexPartsParams>();
  command->add_option("mesh", *mesh, "Wavefront OBJ file, closed surface")->required();
  command->add_option("--parts", params->parts, "Parts at most; each costs in every contact")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--corners", params->corners, "Corners of a part at most")
      ->check(CLI::Range(4, 128))
      ->capture_default_str();
  command->callback([=] { decompose(*mesh, *params); });
}

}  // namespace talus
