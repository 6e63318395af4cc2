#include "common/scene/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "common/mesh/mesh_shape.h"
#include "common/pile/pile_fields.h"
#include "common/scene/instrument_fields.h"
#include "common/scene/policy_fields.h"
#include "common/scene/read_body.h"
#include "common/scene/read_motion.h"
#include "common/scene/read_obstacle.h"
#include "common/scene/read_scene.h"
#include "common/scene/read_source.h"
#include "common/scene/scene_fields.h"
#include "common/shape/catalogue.h"
#include "common/shape/shape_fields.h"
#include "common/world/world_fields.h"

namespace talus {
namespace {

constexpr std::string_view head =
    "| key | type, unit | default | range | meaning; what goes wrong with a bad value |\n"
    "| --- | --- | --- | --- | --- |\n";

template <typename T>
std::string_view type_of() {
  if constexpr (requires { typename T::value_type; } && !std::is_same_v<T, std::string>) {
    using Part = typename T::value_type;
    if constexpr (std::is_same_v<T, std::optional<Part>>) return type_of<Part>();
    if constexpr (std::is_same_v<T, std::vector<double>>) return "number or numbers";
    if constexpr (std::is_same_v<Part, int>) return "whole numbers";
    return std::is_same_v<Part, double> ? "vector" : "points";
  } else {
    if constexpr (std::is_same_v<T, std::string>) return "text";
    if constexpr (std::is_same_v<T, bool>) return "true or false";
    return std::is_integral_v<T> ? "whole number" : "number";
  }
}

/// A number as people write it: 1e6, not 1e+06.
std::string number_text(double number) {
  std::string text = fmt::format("{:.10g}", number);
  if (std::abs(number) >= 1e6 && text.ends_with("00000")) text = fmt::format("{:g}", number);
  const std::size_t exponent = text.find("e+");
  if (exponent == std::string::npos) return text;
  return text.substr(0, exponent + 1) + text.substr(text.find_first_not_of("+0", exponent + 1));
}

template <typename T>
std::string default_of(const Key& key, const T& value) {
  std::vector<std::string> parts;
  for (const double number : numbers_of(&value)) parts.push_back(number_text(as_written(key, number)));
  const bool all_same = !parts.empty() && std::ranges::count(parts, parts.front()) == std::ssize(parts);
  if (all_same) return parts.front();
  return parts.empty() ? fmt::format("`{}`", field_text(key, value)) : fmt::format("[{}]", fmt::join(parts, ", "));
}

template <>
std::string default_of(const Key& /*key*/, const bool& value) {
  return value ? "true" : "false";
}

std::string limits_of(const Key& key) {
  const Range any;
  const Range& range = key.range;
  if (range.low == any.low && range.high == any.high) return "";
  if (range.high == any.high) return fmt::format("at least {}", number_text(range.low));
  const std::string low = key.not_below.empty() ? number_text(range.low) : fmt::format("`{}`", key.not_below);
  return fmt::format("{}{}, {}{}", range.low_excluded ? "(" : "[", low, number_text(range.high),
                     range.high_excluded ? ")" : "]");
}

std::string rules_of(const Key& key) {
  std::vector<std::string> rules;
  for (const std::string_view choice : key.choices) rules.push_back(fmt::format("`\"{}\"`", choice));
  if (const std::string limits = limits_of(key); !limits.empty()) rules.push_back(limits);
  if (!key.further_rule.empty()) rules.emplace_back(key.further_rule);
  return fmt::format("{}", fmt::join(rules, ", "));
}

std::string row_of(const Key& key, std::string_view type, const std::string& standard) {
  std::string meaning = key.dimension == 0 ? "" : fmt::format("{}D only: ", key.dimension);
  meaning += key.meaning;
  const std::string unit = key.unit.empty() ? "" : fmt::format(", {}", key.unit);
  return fmt::format("| `{}` | {}{} | {} | {} | {} |\n", key.name, key.type.empty() ? type : key.type, unit,
                     key.required ? "required" : standard, rules_of(key), meaning);
}

/// The row of a key whose value has this default; none of a key that code of its own reads.
std::string row_of(const Key& key, const ConstValue& standard) {
  const auto row = [&](auto where) {
    if constexpr (std::is_same_v<decltype(where), std::monostate>) {
      return row_of(key, key.choices.empty() ? "number" : "text", std::string(key.default_text));
    } else {
      const bool constant = key.default_text.empty() && !key.required;
      return row_of(key, type_of<std::remove_cvref_t<decltype(*where)>>(),
                    constant ? default_of(key, *where) : std::string(key.default_text));
    }
  };
  return std::visit(row, standard);
}

template <typename S>
std::string rows_of(std::type_identity_t<Fields<S>> fields) {
  const S defaults{};
  std::string rows;
  for (const Field<S>& field : fields) rows += row_of(field.key, value_of(defaults, field));
  return rows;
}

std::string rows_of_shape() {
  std::vector<std::string> kinds = names_of_shape_kinds<3>();
  kinds.emplace_back(compound_kind);
  const Key kind = {.name = "kind", .required = true, .meaning = "decides which of the keys below belong here"};
  std::string row = row_of(kind, "text", "");
  row.replace(row.find("|  |"), 4, fmt::format("| `\"{}\"` |", fmt::join(kinds, "\"`, `\"")));
  return row + row_of(colour_key, "text", std::string(colour_key.default_text)) +
         rows_of<Material>(body_material_fields) + rows_of<Material>(surface_fields);
}

std::vector<std::pair<std::string, std::string>> tables_of_shapes() {
  return {
      {"[shape.NAME]", rows_of_shape()},
      {"[shape.NAME] box", rows_of<BoxParams<3>>(box_fields<3>)},
      {"[shape.NAME] L", rows_of<LParams>(l_fields)},
      {"[shape.NAME] ball", rows_of<BallParams>(ball_fields)},
      {"[shape.NAME] capsule", rows_of<CapsuleParams>(capsule_fields)},
      {"[shape.NAME] cylinder", rows_of<CylinderParams>(cylinder_fields)},
      {"[shape.NAME] cone", rows_of<ConeParams>(cone_fields)},
      {"[shape.NAME] ellipse", rows_of<EllipseParams<3>>(ellipse_fields<3>)},
      {"[shape.NAME] stone", rows_of<StoneParams>(stone_fields)},
      {"[shape.NAME] hull", rows_of<HullParams<3>>(hull_fields<3>)},
      {"[shape.NAME] polygon", rows_of<PolygonParams>(polygon_fields)},
      {"[shape.NAME] ring", rows_of<RingParams>(ring_fields)},
      {"[shape.NAME] mesh", rows_of<MeshParams>(mesh_fields)},
      {"[shape.NAME] compound", row_of(parts_key, "tables", "")},
      {"[[shape.NAME.parts]]", rows_of<PartParams<3>>(part_fields<3>)},
  };
}

}  // namespace

std::vector<std::pair<std::string, std::string>> key_tables() {
  std::vector<std::pair<std::string, std::string>> rows = {
      {"root", rows_of<Scene<3>>(scene_fields<3>)},
      {"[world]", rows_of<WorldDescription<3>>(world_fields<3>)},
      {"[world.gravity_motion]", row_of(gravity_motion_kind_key, "text", "")},
      {"[world.gravity_motion] sine", rows_of<Motion<3>>(gravity_sine_fields<3>)},
      {"[world.gravity_motion] turn", rows_of<Motion<3>>(gravity_turn_fields<3>)},
      {"[world.gravity_motion] path", rows_of<Motion<3>>(gravity_path_fields<3>)},
      {"[world.solver]", rows_of<SolverParams>(solver_fields)},
      {"[ground]", rows_of<Ground>(ground_fields) + rows_of<Material>(surface_fields)},
      {"[[obstacle]]", rows_of<Pose<3>>(obstacle_fields<3>) + rows_of<Material>(surface_fields)},
      {"[obstacle.motion]", row_of(motion_kind_key, "text", "")},
      {"[obstacle.motion] sine", rows_of<Motion<3>>(sine_fields<3>)},
      {"[obstacle.motion] turn", rows_of<Motion<3>>(turn_fields<3>)},
      {"[obstacle.motion] path", rows_of<Motion<3>>(path_fields<3>)},
      {"[obstacle.motion] belt", rows_of<Motion<3>>(belt_fields<3>)},
      {"[[obstacle]] container", rows_of<ContainerParams<3>>(container_fields<3>)},
      {"[[obstacle]] round container", rows_of<ConvexContainerParams>(convex_container_fields)},
      {"[[body]]", rows_of<BodyParams<3>>(body_fields<3>)},
      {"[[source]]", rows_of<Source<3>>(source_fields<3>)},
      {"[source.scale]", rows_of<ScaleParams>(scale_fields)},
      {"[[event]]", rows_of<Event<3>>(event_fields<3>)},
      {"[[pile]]", rows_of<PileParams<3>>(pile_fields<3>)},
      {"[pile.boundary]", rows_of<BoundaryParams>(boundary_fields) + rows_of<Material>(surface_fields)},
      {"[[gate]]", rows_of<GateParams<3>>(gate_fields<3>)},
      {"[[region]]", rows_of<RegionParams<3>>(region_fields<3>)},
      {"[[load]]", rows_of<LoadParams<3>>(load_fields<3>)},
      {"[policy]", rows_of<PolicyParams>(policy_fields)},
      {"[policy] paper", rows_of<PaperParams>(paper_fields)},
      {"[policy.adaptive]", rows_of<AdaptiveParams>(adaptive_fields)},
      {"[run]", rows_of<RunParams>(run_fields)},
  };
  const auto of_shapes = tables_of_shapes();
  const auto bodies = std::ranges::find(rows, "[[body]]", [](const auto& row) { return row.first; });
  rows.insert(bodies, of_shapes.begin(), of_shapes.end());
  for (auto& [name, text] : rows) text.insert(0, head);
  return rows;
}

std::string with_reference(std::string_view document) {
  constexpr std::string_view keys_mark = "<!-- keys: ";
  constexpr std::string_view end_mark = "<!-- end -->";
  const auto tables = key_tables();
  std::istringstream lines{std::string(document)};
  std::string result;
  bool any = false;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const bool begins = line.starts_with(keys_mark);
    any = any || begins;
    if (begins == inside && (begins || line == end_mark))
      throw std::invalid_argument(fmt::format("line {}: {} must be one of a pair of marks", number, line));
    if (line == end_mark) inside = false;
    if (!inside) result += line + "\n";
    if (!begins) continue;
    inside = true;
    const std::string name = line.substr(keys_mark.size(), line.rfind(" -->") - keys_mark.size());
    const auto found = std::ranges::find(tables, name, [](const auto& table) { return table.first; });
    if (found == tables.end())
      throw std::invalid_argument(fmt::format("line {}: {} names no table of keys", number, line));
    result += "\n" + found->second + "\n";
  }
  if (inside) throw std::invalid_argument("the last mark has no <!-- end -->");
  if (!any) throw std::invalid_argument("must have a mark, as <!-- keys: [run] -->");
  return result;
}

}  // namespace talus
