#include "tools/bench/truth_cell.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tools/bench/bench_case.h"
#include "tools/bench/covering_design.h"
#include "tools/bench/paper_figures.h"
#include "tools/run/find_scene.h"

namespace talus {
namespace {

/// A shape of the design in one dimension.
struct CellShape {
  std::string_view keys;     // of its tables
  double extent;             // D [m]
  double bulk;               // volume that a body takes up in a heap, with the gaps around it [m^3], in 2D [m^2]
  std::string_view further;  // tables of further shapes, whose friction is filled in
};

struct CellShapes {
  std::string_view name;
  CellShape flat;
  CellShape solid;
};

// Bulk is a rough guess: it sets how large a bin is, of which some bodies spill.
constexpr auto cell_shapes = std::to_array<CellShapes>({
    {"L",
     {"kind = \"L\"\narm_x = 1.0\narm_z = 1.0\nthickness = 0.4\n", 1.41, 0.9, ""},
     {"kind = \"L\"\narm_x = 1.0\narm_z = 1.0\nthickness = 0.4\ndepth = 0.4\n", 1.47, 0.55, ""}},
    {"box",
     {"kind = \"box\"\nsize = [1.0, 1.0]\n", 1.41, 1.1, ""},
     {"kind = \"box\"\nsize = [1.0, 1.0, 1.0]\n", 1.73, 1.6, ""}},
    {"stick",
     {"kind = \"box\"\nsize = [2.0, 0.2]\n", 2.01, 0.6, ""},
     {"kind = \"box\"\nsize = [2.0, 0.2, 0.2]\n", 2.02, 0.25, ""}},
    {"plate",
     {"kind = \"box\"\nsize = [1.6, 0.2]\n", 1.61, 0.45, ""},
     {"kind = \"box\"\nsize = [1.6, 1.6, 0.2]\n", 2.27, 1.1, ""}},
    {"triangle",
     {"kind = \"hull\"\ncorners = [[-0.6, -0.35], [0.6, -0.35], [0.0, 0.69]]\n", 1.3, 0.85, ""},
     {"kind = \"hull\"\ncorners = [[0.42, 0.42, 0.42], [0.42, -0.42, -0.42], [-0.42, 0.42, -0.42], [-0.42, -0.42, "
      "0.42]]\n",
      1.35, 0.45, ""}},
    {"disc",
     {"kind = \"ball\"\nradius = 0.25\n", 1.5, 1.15, "kind = \"ball\"\nradius = 0.75\n"},
     {"kind = \"ball\"\nradius = 0.25\n", 1.5, 1.3, "kind = \"ball\"\nradius = 0.75\n"}},
    {"ring",
     {"kind = \"ring\"\nouter_radius = 0.5\ninner_radius = 0.3\n", 1.0, 0.9, ""},
     {"kind = \"ring\"\nouter_radius = 0.5\ninner_radius = 0.3\ndepth = 0.25\n", 1.03, 0.35, ""}},
    {"bunny",
     {"kind = \"mesh\"\nfile = \"shapes/bunny.obj\"\nlongest_side = 1.0\ndetail = 0.05\n", 1.3, 0.8, ""},
     {"kind = \"mesh\"\nfile = \"shapes/bunny.obj\"\nlongest_side = 1.0\n", 1.5, 0.4, ""}},
});

constexpr std::array frictions = {0.1, 0.2, 0.35, 0.6, 1.0};
constexpr std::array rates = {0.5, 6.6, 50.0, 0.0};  // [1/s]; 0: all at once
constexpr std::array gravities = {1.62, 9.81, 25.0};
enum class CellGround { flat, slope, bin, hopper };

/// A cell's values, and the lengths that follow from them.
struct CellPlan {
  const CellShape& shape;
  int dimension;
  double friction;
  double rate;
  CellGround ground;
  double gravity;
  int bodies;

  double slope() const { return ground == CellGround::slope ? 0.7 * std::atan(friction) : 0.0; }
  double spacing() const { return 1.1 * shape.extent; }
  /// Bodies side by side, so that a body leaves the spout at about 10 m/s.
  int abreast() const { return rate == 0.0 ? 8 : static_cast<int>(std::ceil(rate * spacing() / 12.0)); }
  int columns() const { return dimension == 2 ? abreast() : static_cast<int>(std::ceil(std::sqrt(abreast()))); }
  int at_once() const { return dimension == 2 ? columns() : columns() * columns(); }
  int rows() const { return rate == 0.0 ? (bodies + at_once() - 1) / at_once() : 1; }
  double half_source() const { return 0.5 * (columns() - 1) * spacing(); }

  double bin_width() const { return (dimension == 2 ? 10.0 : 4.5) * shape.extent; }
  /// Seven tenths of the bodies fill it.
  double bin_height() const {
    const double area = dimension == 2 ? bin_width() : bin_width() * bin_width();
    return std::max(0.4 * shape.extent, 0.7 * bodies * shape.bulk / area);
  }

  double outlet_width() const { return 4.0 * shape.extent; }
  double outlet_height() const { return 2.5 * shape.extent; }
  double hopper_top() const { return outlet_height() + hopper_wall * std::sin(hopper_angle) * shape.extent; }

  static constexpr double slope_length = 60.0;                             // [D]
  static constexpr double hopper_wall = 10.0;                              // length [D]
  static constexpr double hopper_angle = 50.0 * std::numbers::pi / 180.0;  // of the walls [rad]
};

double degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

/// A point or a size: x, in 3D y, and z.
std::string point(const CellPlan& plan, double x, double y, double z) {
  if (plan.dimension == 2) return fmt::format("[{:.6g}, {:.6g}]", x, z);
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x, y, z);
}

/// A slab 1 D thick whose upper face falls by `angle` along the direction `along` (0: x, 1: y; `sign` turns it round),
/// with the middle of that face `x` and `z` from the origin.
std::string slab(const CellPlan& plan, int along, double sign, double angle, double x, double z, double length,
                 double width) {
  const double thickness = plan.shape.extent;
  const double middle = x - 0.5 * thickness * std::sin(angle);
  const double down = z - 0.5 * thickness * std::cos(angle);
  std::string text = "\n[[obstacle]]\nkind = \"box\"\n";
  text += fmt::format("size = {}\n",
                      along == 0 ? point(plan, length, width, thickness) : point(plan, width, length, thickness));
  text += fmt::format("position = {}\n",
                      along == 0 ? point(plan, sign * middle, 0.0, down) : point(plan, 0.0, sign * middle, down));
  if (plan.dimension == 2) {
    text += fmt::format("angle_deg = {:.6g}\n", -sign * degrees(angle));
  } else {
    text += fmt::format("angle_deg = {:.6g}\naxis = {}\n", (along == 0 ? sign : -sign) * degrees(angle),
                        along == 0 ? "[0.0, 1.0, 0.0]" : "[1.0, 0.0, 0.0]");
  }
  return text + fmt::format("friction = {}\n", plan.friction);
}

/// The ground plane and what stands on it.
std::string ground_text(const CellPlan& plan) {
  const double extent = plan.shape.extent;
  // The plane meets the upper face of a slope at its lower end.
  const double height = -0.5 * CellPlan::slope_length * extent * std::sin(plan.slope());
  std::string text = fmt::format("\n[ground]\nheight = {:.6g}\nfriction = {}\n", height, plan.friction);
  if (plan.ground == CellGround::slope) {
    const double length = CellPlan::slope_length * extent;
    text += slab(plan, 0, 1.0, plan.slope(), 0.0, 0.0, length, length);
  }
  if (plan.ground == CellGround::bin) {
    text += fmt::format("\n[[obstacle]]\nkind = \"container\"\ninner_size = {}\nwall = 1.0\nfriction = {}\n",
                        point(plan, plan.bin_width(), plan.bin_width(), plan.bin_height()), plan.friction);
  }
  if (plan.ground == CellGround::hopper) {
    const double length = CellPlan::hopper_wall * extent;
    const double out = 0.5 * (plan.outlet_width() + length * std::cos(CellPlan::hopper_angle));
    const double up = 0.5 * (plan.outlet_height() + plan.hopper_top());
    for (int along = 0; along < plan.dimension - 1; ++along)
      for (const double sign : {-1.0, 1.0})
        text += slab(plan, along, sign, -CellPlan::hopper_angle, out, up, length, 2.0 * length);
  }
  return text;
}

std::string source_text(const CellPlan& plan) {
  const double extent = plan.shape.extent;
  double height = 5.0 * extent + plan.half_source() * std::tan(plan.slope());
  if (plan.ground == CellGround::bin) height += plan.bin_height();
  if (plan.ground == CellGround::hopper) height += plan.hopper_top();
  const double fall = std::sqrt(2.0 * plan.gravity * 5.0 * extent);  // [m/s]
  const double clearing = plan.rate / plan.at_once() * 1.2 * extent;
  std::string text = fmt::format("\n[[source]]\ncount = {}\nrate = {:g}\nposition = {}\nvelocity = {}\n", plan.bodies,
                                 plan.rate == 0.0 ? 1e6 : plan.rate, point(plan, 0.0, 0.0, height),
                                 point(plan, 0.0, 0.0, -std::max(fall, clearing)));
  if (plan.at_once() > 1) {
    text += plan.dimension == 2 ? fmt::format("grid = [{}, {}]\n", plan.columns(), plan.rows())
                                : fmt::format("grid = [{0}, {0}, {1}]\n", plan.columns(), plan.rows());
    text += fmt::format("spacing = {}\n", point(plan, plan.spacing(), plan.spacing(), plan.spacing()));
  }
  if (plan.rate > 0.0) text += fmt::format("ride_above = {:.6g}\n", 5.0 * extent);
  return text;
}

/// The friction of bodies. A slope is 0.7 of the friction angle steep, so balls with this rolling friction stay on it.
std::string friction_text(const CellPlan& plan) {
  constexpr double rolling = 0.8;  // over friction
  std::string text = fmt::format("friction = {}\n", plan.friction);
  if (plan.shape.keys.find("ball") != std::string_view::npos)
    text += fmt::format("rolling_friction = {:.6g}\n", rolling * plan.friction);
  return text;
}

std::string scene_text(const CellPlan& plan, const std::string& name) {
  std::string text =
      fmt::format("title = \"{}\"\ndimension = {}\n\n[world]\ngravity = {}\n", name, plan.dimension, plan.gravity);
  text += "\n[world.solver]\nwarm_friction = true\n";
  text += ground_text(plan);
  text += fmt::format("\n[shape.body]\n{}{}", plan.shape.keys, friction_text(plan));
  if (!plan.shape.further.empty())
    text += fmt::format("\n[shape.large]\n{}{}", plan.shape.further, friction_text(plan));
  const double end = (plan.rate > 0.0 ? plan.bodies / plan.rate : 0.0) + calm_time(plan.gravity);
  return text + source_text(plan) + fmt::format("\n[run]\nframes = {}\n", std::llround(30.0 * end));
}

TruthGeometry geometry_of(const CellPlan& plan) {
  TruthGeometry geometry;
  geometry.slope = plan.slope();
  if (plan.ground == CellGround::slope)
    geometry.inside_half_width = 0.49 * CellPlan::slope_length * plan.shape.extent * std::cos(plan.slope());
  if (plan.ground == CellGround::bin) geometry.inside_half_width = 0.5 * plan.bin_width();
  if (plan.ground == CellGround::hopper) geometry.inside_above = plan.outlet_height();
  return geometry;
}

std::vector<int> numbers_of_values() {
  std::vector<int> numbers;
  for (const TruthFactor& factor : truth_factors()) numbers.push_back(static_cast<int>(factor.values.size()));
  return numbers;
}

}  // namespace

double calm_time(double gravity) { return 10.0 * std::sqrt(9.81 / gravity); }

bool TruthGeometry::has_spill() const { return std::isfinite(inside_half_width) || std::isfinite(inside_above); }

const std::vector<TruthFactor>& truth_factors() {
  static const std::vector<TruthFactor> all = [] {
    std::vector<TruthFactor> factors = {{"dimension", {"2d", "3d"}},
                                        {"friction", {"f0.1", "f0.2", "f0.35", "f0.6", "f1"}},
                                        {"shape", {}},
                                        {"pour", {"r0.5", "r6.6", "r50", "at_once"}},
                                        {"ground", {"flat", "slope", "bin", "hopper"}},
                                        {"gravity", {"g1.62", "g9.81", "g25"}}};
    for (const CellShapes& shape : cell_shapes) factors[2].values.push_back(shape.name);
    return factors;
  }();
  return all;
}

TruthCell truth_cell(const std::vector<int>& values, const TruthBodies& bodies) {
  const auto value = [&](std::size_t factor) { return static_cast<std::size_t>(values.at(factor)); };
  std::string name;
  for (std::size_t f = 0; f < values.size(); ++f)
    name += (f == 0 ? "" : "-") + std::string(truth_factors()[f].values.at(value(f)));
  const int dimension = 2 + values[0];
  const CellShapes& shapes = cell_shapes.at(value(2));
  const double rate = rates.at(value(3));
  const CellPlan plan{dimension == 2 ? shapes.flat : shapes.solid,
                      dimension,
                      frictions.at(value(1)),
                      rate,
                      static_cast<CellGround>(values[4]),
                      gravities.at(value(5)),
                      rate > 0.0 && rate < 1.0 ? bodies.slow : bodies.most};
  return {name, dimension, plan.friction, geometry_of(plan), scene_text(plan, name), {}};
}

std::optional<TruthCell> truth_cell_named(std::string_view name, const TruthBodies& bodies) {
  std::vector<int> values;
  for (const TruthFactor& factor : truth_factors()) {
    const std::string_view part = name.substr(0, name.find('-'));
    name.remove_prefix(std::min(name.size(), part.size() + 1));
    const auto found = std::ranges::find(factor.values, part);
    if (found == factor.values.end()) return std::nullopt;
    values.push_back(static_cast<int>(found - factor.values.begin()));
  }
  return name.empty() ? std::optional(truth_cell(values, bodies)) : std::nullopt;
}

std::vector<TruthCell> truth_design(std::uint64_t seed, int count, const TruthBodies& bodies) {
  std::vector<TruthCell> cells;
  for (const std::vector<int>& values : covering_design(numbers_of_values(), count, seed))
    cells.push_back(truth_cell(values, bodies));
  return cells;
}

std::vector<TruthCell> truth_scenes() {
  std::vector<std::string> names;
  for (const paper::Example& example : paper::table_1) names.emplace_back(example.scene);
  names.emplace_back("several_sizes");
  std::vector<TruthCell> cells;
  for (const std::string& name : names) {
    for (const int dimension : {2, 3}) {
      TruthCell cell{fmt::format("{}_{}d", name, dimension), dimension, 0.6, {}, "", {}};
      if (name == "rings_in_a_box") cell.geometry.inside_half_width = dimension == 2 ? 10.0 : 3.0;
      cells.push_back(cell);
    }
  }
  return cells;
}

std::vector<TruthCell> truth_scene_files(const std::vector<std::string>& given) {
  std::vector<std::filesystem::path> files;
  for (const std::string& each : given) {
    if (!std::filesystem::is_directory(each)) {
      files.push_back(find_scene(each));
      continue;
    }
    const std::size_t before = files.size();
    for (const auto& entry : std::filesystem::directory_iterator(each))
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
    if (files.size() == before) throw std::invalid_argument(fmt::format("--scenes {}: no .toml file in it", each));
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end());
  }
  std::vector<TruthCell> cells;
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string();
    if (std::ranges::find(cells, name, &TruthCell::name) != cells.end())
      throw std::invalid_argument(fmt::format("--scenes {}: another scene is named {} too", file.string(), name));
    cells.push_back({name, dimension_of(file.string()), 0.6, {}, "", file});
  }
  return cells;
}

}  // namespace talus
