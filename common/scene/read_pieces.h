#pragma once
// Shapes that are convex pieces and nothing else, kind by kind.

#include <string_view>
#include <vector>

#include "common/scene/table_reader.h"
#include "common/shape/shape.h"

namespace talus {

/// A kind and the reader of its keys, which gives no pieces where it noted an error and may throw
/// std::invalid_argument where the keys do not make a shape together.
template <int Dim>
struct PiecesKind {
  std::string_view name;
  std::vector<Piece<Dim>> (*read)(TableReader& table);
};

/// All such kinds.
template <int Dim>
std::vector<PiecesKind<Dim>> pieces_kinds();

}  // namespace talus
