#pragma once
// Which bodies are where.

#include <optional>
#include <unordered_map>
#include <vector>

#include "common/math/grid.h"
#include "common/world/body.h"

namespace talus {

/// Bodies by the vertical column that holds their centre of mass. Those larger than a column are in all answers.
template <int Dim>
class BodyColumns {
 public:
  /// `width` of a column [m] > 0.
  explicit BodyColumns(double width) : columns_(width) {}

  /// Puts a body of `extent` [m], or moves it. Costs next to nothing while it stays in its column.
  void put(BodyIndex body, const Vec<Dim>& position, double extent);
  void take_out(BodyIndex body);

  /// Appends candidates for the bodies that touch `box`, in any order, each once.
  void query(const Box<Dim>& box, std::vector<BodyIndex>& found) const;

 private:
  using Columns = Grid<Dim - 1>;
  using Column = typename Columns::Cell;
  struct Hash {
    std::size_t operator()(const Column& column) const;
  };

  void append_columns(const Column& first, const Column& last, std::vector<BodyIndex>& found) const;

  struct Place {
    bool large = false;
    std::optional<Column> column;
  };

  Columns columns_;
  std::unordered_map<Column, std::vector<BodyIndex>, Hash> bodies_;  // its order reaches no result: World sorts
  std::vector<Place> places_;                                        // [body]
  std::vector<BodyIndex> large_;
};

}  // namespace talus
