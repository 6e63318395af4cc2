#include "tools/run/shape_json.h"

#include "common/math/angle.h"
#include "tools/run/json_null.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

template <int Dim>
Json shape_json(std::span<const PlacedBody<Dim>> bodies, const ShapeStatistics<Dim>& shape,
                const ProfileGrid<Dim>& grid, const WorldDescription<Dim>& world, double extent) {
  const PileForm form = pile_form<Dim>(bodies, shape, grid, world, extent);
  const auto& slope = form.slope.value;
  return {{"height_m", shape.peak},
          {"centre_height_m", shape.centre_height},
          {"r50_m", shape.r50},
          {"r95_m", shape.r95},
          {"angle_of_repose_deg", slope ? Json(in_degrees(slope->angle)) : Json()},
          {"angle_of_repose_standard_error_deg", slope ? Json(in_degrees(slope->standard_error)) : Json()},
          {"angle_of_repose_reason", or_null(form.slope.why_not)},
          {"packing", or_null(form.packing.value)},
          {"packing_reason", or_null(form.packing.why_not)}};
}

template Json shape_json(std::span<const PlacedBody<2>>, const ShapeStatistics<2>&, const ProfileGrid<2>&,
                         const WorldDescription<2>&, double);
template Json shape_json(std::span<const PlacedBody<3>>, const ShapeStatistics<3>&, const ProfileGrid<3>&,
                         const WorldDescription<3>&, double);

}  // namespace talus
