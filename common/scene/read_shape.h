#pragma once
// Shapes in scene files: the kinds, and the keys that obstacles and sources share with them.

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh/mesh_shape.h"
#include "common/scene/scene.h"
#include "common/scene/scene_fields.h"
#include "common/scene/table_reader.h"
#include "common/world/world_description.h"

namespace talus {

inline constexpr std::array<std::string_view, 2> mesh_axes = {"y", "z"};

inline constexpr auto mesh_fields = std::to_array<Field<MeshParams>>({
    {{},
     {.name = "file",
      .required = true,
      .type = "text",
      .further_rule = "in or below the scene's folder, or absolute",
      .meaning = "Wavefront OBJ file of a closed surface; one with holes is refused with number and place. The folder "
                 "of a run gets a copy"}},
    {place_of<&MeshParams::size>,
     {.name = "longest_side",
      .unit = "m",
      .range = length_range,
      .meaning = "the mesh is scaled until its longest side has this length: few files say what their unit is"}},
    {place_of<&MeshParams::up>, {.name = "up", .choices = mesh_axes, .meaning = "the file's axis that points up"}},
    {place_of<&MeshParams::detail>,
     {.name = "detail",
      .dimension = 2,
      .elsewhere = "`talus decompose` has made the parts",
      .unit = "m",
      .range = between(1e-3, 1e4),
      .meaning = "how far the outline may deviate from the mesh's silhouette along y. Fine: many pieces, each costs in "
                 "contacts"}},
});

/// A kind of shape that is made of convex pieces.
template <int Dim>
struct ShapeKind {
  std::string_view name;
  /// Reads the keys of the kind. No pieces where one of them is wrong; throws InvalidValue where they make no shape
  /// together.
  std::function<std::vector<Piece<Dim>>(TableReader&)> read;
};

/// All such kinds. A new one is a struct of parameters with its fields and a function in common/shape/catalogue.h, and
/// a line in read_shape.cc.
template <int Dim>
std::vector<ShapeKind<Dim>> shape_kinds();

/// The names that `kind` may have: of the kinds above and "mesh".
template <int Dim>
std::vector<std::string> names_of_shape_kinds();

/// The table's `kind`, one of `kinds`; empty, with an error, if it is none.
std::string read_kind(TableReader& table, const std::vector<std::string>& kinds);

/// A rotation as scene files give it: an angle [rad], in 3D about an axis.
template <int Dim>
struct Turn {
  double angle = 0.0;
  Vec3 axis = Vec3::UnitZ();  // unit; means nothing in 2D

  /// By another angle about the same axis.
  Rotation<Dim> rotation(double by) const {
    if constexpr (Dim == 2)
      return Rotation<2>(by);
    else
      return Rotation<3>(Eigen::AngleAxisd(by, axis));
  }
  Rotation<Dim> rotation() const { return rotation(angle); }
};

/// `angle_deg`, in 3D about `axis`; nothing if neither is given.
template <int Dim>
std::optional<Turn<Dim>> read_turn(TableReader& table);
template <int Dim>
std::optional<Rotation<Dim>> read_rotation(TableReader& table);

/// The pose of a body's centre of mass that brings the origin of the axes in which its shape was described to `pose`.
template <int Dim>
Pose<Dim> pose_of_centre(const Shape<Dim>& shape, const Pose<Dim>& pose) {
  return {pose * Vec<Dim>(-shape.reference), pose.rotation};
}

/// The shape that the keys of `kind` describe, of a stone all its variants; none, with an error at the key or at the
/// table, if one of them is wrong or the engines cannot simulate such a shape. `seed`: of the scene.
template <int Dim>
std::vector<Shape<Dim>> read_shape(TableReader& table, const std::string& kind, const std::string& name,
                                   const Material& material, std::uint64_t seed);

inline constexpr Key colour_key = {
    .name = "colour",
    .type = "text",
    .further_rule = "a name or `\"#rrggbb\"`",
    .default_text = "by the shape's number",
    .meaning =
        "of the bodies in pictures, films and in `talus view`, asleep darker. Names: `black`, `blue`, `brown`, "
        "`green`, `grey`, `orange`, `pink`, `purple`, `red`, `sky`, `white`, `yellow`"};
inline constexpr std::string_view compound_kind = "compound";
inline constexpr Key parts_key = {.name = "parts",
                                  .required = true,
                                  .type = "tables",
                                  .further_rule = "one or more",
                                  .meaning = "the shapes that it is made of: `[[shape.NAME.parts]]`"};

/// A part of a compound as the file gives it.
template <int Dim>
struct PartParams {
  std::string shape;
  Vec<Dim> position = Vec<Dim>::Zero();
};

template <int Dim>
inline constexpr auto part_fields = std::to_array<Field<PartParams<Dim>>>({
    {{},
     {.name = "shape",
      .required = true,
      .type = "text",
      .further_rule = "name of a shape that has not this one as a part",
      .meaning = "which shape; of a `stone` the first of its variants"}},
    {place_of<&PartParams<Dim>::position>,
     {.name = "position",
      .type = "point",
      .unit = "m",
      .range = coordinate_range,
      .default_text = "origin",
      .meaning = "where the origin of the part's own axes goes, in those of the compound. Where parts overlap the mass "
                 "of both counts; deeper than 0.005 m, of small parts less, `talus check` warns"}},
    {{}, angle_key},
    {{}, axis_key},
});

/// `[shape.NAME]`, with all shapes that a compound refers to.
template <int Dim>
class BodyShapes {
 public:
  /// `root`: the table that has `[shape.NAME]`.
  BodyShapes(TableReader& root, std::uint64_t seed) : root_(root), seed_(seed), names_(root.names_of_tables("shape")) {}

  /// The shape of this name, of a stone all its variants, read once; none where it is wrong.
  const std::vector<Shape<Dim>>& read(const std::string& name, TableReader& table);

  /// Whether a compound has it as a part.
  bool is_part(const std::string& name) const { return parts_.contains(name); }

 private:
  std::vector<Shape<Dim>> read_anew(const std::string& name, TableReader& table);
  std::vector<Shape<Dim>> read_compound(const std::string& name, TableReader& table);
  std::optional<CompoundPart<Dim>> read_part(TableReader& table);

  TableReader& root_;
  std::uint64_t seed_;
  std::vector<std::string> names_;
  std::map<std::string, std::vector<Shape<Dim>>> done_;
  std::set<std::string> parts_;
  std::vector<std::string> under_way_;  // compounds, each a part of the one before
};

/// Throws unless the engines can simulate bodies of these shapes: where they are read, so that the error has its place
/// in the file.
template <int Dim>
void check_alone(const std::vector<Shape<Dim>>& shapes);

/// All shapes that bodies may have, as scene files name them.
class ShapeNames {
 public:
  /// The next shapes in WorldDescription::shapes, the variants of one name; `count` is 0 where they are wrong.
  void add(const std::string& name, int count) {
    names_.push_back(name);
    firsts_.push_back(shapes_);
    counts_.push_back(count);
    shapes_ += count;
    complete_ = complete_ && count > 0;
  }
  /// The last shape added is a part of compounds, so that bodies have it only where it is named.
  void mark_part() { parts_.push_back(names_.back()); }
  /// A shape that no body has, since it is only a part of compounds.
  void add_part(const std::string& name) {
    names_.push_back(name);
    firsts_.push_back(shapes_);
    counts_.push_back(0);
    mark_part();
  }
  /// Those of names() that bodies have where none is named.
  std::vector<std::string> names_of_bodies() const {
    std::vector<std::string> names;
    for (const std::string& name : names_)
      if (std::ranges::count(parts_, name) == 0) names.push_back(name);
    return names;
  }
  /// More shapes, which have no name.
  void add_unnamed(int count) { shapes_ += count; }

  /// Whether no shape was wrong, so that rules that depend on them can be checked.
  bool complete() const { return complete_; }
  std::span<const std::string> names() const { return names_; }
  /// The numbers of the variants of a name; none for an unknown one.
  std::vector<int> variants(std::string_view name) const {
    std::vector<int> numbers;
    for (std::size_t i = 0; i < names_.size(); ++i)
      for (int k = 0; names_[i] == name && k < counts_[i]; ++k) numbers.push_back(firsts_[i] + k);
    return numbers;
  }

 private:
  std::vector<std::string> names_;
  std::vector<int> firsts_;
  std::vector<int> counts_;
  std::vector<std::string> parts_;
  int shapes_ = 0;
  bool complete_ = true;
};

}  // namespace talus
