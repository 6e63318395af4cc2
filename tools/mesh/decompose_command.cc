#include <algorithm>
#include <memory>
#include <optional>

#include "common/math/require.h"
#include "common/mesh/mesh.h"
#include "common/mesh/mesh_file.h"
#include "common/text/file.h"
#include "tools/commands/commands.h"
#include "tools/mesh/convex_parts.h"
#include "tools/mesh/decomposition.h"
#include "tools/output/output.h"

namespace talus {
namespace {

void print_report(const Mesh& mesh, const Decomposition& decomposition, const std::filesystem::path& file) {
  const std::vector<Mesh>& parts = decomposition.parts;
  const double volume = moments(mesh).volume;
  double sum = 0.0;
  std::size_t most = 0;
  for (const Mesh& part : parts) {
    sum += moments(part).volume;
    most = std::max(most, part.corners.size());
  }
  print_result("mesh: {} corners, {} triangles, volume {:.4g}, its hull {:.3g} times that\n", mesh.corners.size(),
               mesh.triangles.size(), volume, moments(hull_mesh(mesh.corners)).volume / volume);
  print_result("parts: {}, volume of their union {:.3g} times the mesh's, sum {:.3g} times, {} corners at most\n",
               parts.size(), decomposition.ratio, sum / volume, most);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    print_result("  part {}: {} corners, volume {:.3g} times the mesh's\n", i, parts[i].corners.size(),
                 moments(parts[i]).volume / volume);
  }
  print_result("usable from longest_side = {:.3g} m on: the thinnest part must be {} m wide\n",
               least_longest_side(mesh, parts), thinnest_piece_in_space);
  print_result("{}\n", file.string());
}

/// Parts of a mesh that has changed are of no use any more; others may have taken somebody's time.
bool may_replace(const std::filesystem::path& file, const std::string& text) {
  const std::optional<std::string> before = file_contents(file);
  if (!before || *before == text) return true;
  const auto head = [](const std::string& of) { return of.substr(0, of.find('\n')); };
  return before->starts_with(parts_mark) && head(*before) != head(text);
}

void decompose(const std::filesystem::path& mesh_file, const ConvexPartsParams& params, bool force) {
  const Mesh mesh = repaired(read_mesh(mesh_file));
  const Decomposition decomposition = decomposed(mesh, params);
  const std::string text = parts_text(mesh, decomposition.parts);
  require(force || may_replace(parts_file(mesh_file), text), "parts of mesh", parts_file(mesh_file).string(),
          "must not be there with other content; --force replaces it");
  write_file(parts_file(mesh_file), text);
  print_report(mesh, decomposition, parts_file(mesh_file));
}

}  // namespace

void add_decompose_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("decompose", "Cut a mesh into the convex parts with which it collides in 3D scenes");
  command->footer(
      "Writes MESH.parts.obj beside MESH.obj; a 3D scene with the mesh needs it. Repeat it when the mesh changes.\n"
      "When the volume of the parts' union differs from the mesh's by over 5 %, other numbers of parts and corners\n"
      "are tried; when none fits, the exit code is 1 and nothing is written. A convex mesh gives one part.");
  auto mesh = std::make_shared<std::string>();
  auto params = std::make_shared<ConvexPartsParams>();
  command->add_option("mesh", *mesh, "Wavefront OBJ file, closed surface")->required();
  command->add_option("--parts", params->parts, "Number of parts to try first; each costs time in every contact")
      ->check(whole_number(1, most_parts))
      ->capture_default_str();
  command->add_option("--corners", params->corners, "Corners of a part at most, tried first")
      ->check(whole_number(4, most_part_corners))
      ->capture_default_str();
  auto force = std::make_shared<bool>(false);
  command->add_flag("-f,--force", *force, "Replace other parts of the same mesh");
  command->callback([=, &exit_code] {
    decompose(*mesh, *params, *force);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
