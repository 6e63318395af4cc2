#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "common/measure/pile_form.h"

namespace talus {

/// The shape of a pile, as summary.json and `talus compare` have it. What does not apply is null, with the reason in
/// `angle_of_repose_reason` and `packing_reason`, which else are null. Arguments as of pile_form().
template <int Dim>
nlohmann::ordered_json shape_json(std::span<const PlacedBody<Dim>> bodies, const ShapeStatistics<Dim>& shape,
                                  const ProfileGrid<Dim>& grid, const WorldDescription<Dim>& world, double extent);

}  // namespace talus
