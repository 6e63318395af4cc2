#include "common/measure/pile_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/pile/angle_of_repose.h"
#include "common/pile/profile.h"
#include "common/shape/convex_distance.h"

namespace talus {
namespace {

constexpr double largest_held_share = 0.05;
constexpr double leaning_gap = 0.05;   // [D]; engines keep bodies so far apart at most
constexpr double even_spread = 0.577;  // 1 / sqrt(3)
constexpr double spread_margin = 0.05;
constexpr double lowest_pile = 2.0;  // [D]; in a lower bed gaps between bodies count as the outside

template <int Dim>
bool holds(const std::vector<ConvexPiece<Dim>>& obstacle, const PlacedBody<Dim>& body, double extent) {
  const double reach = 0.5 * body.bounds.sizes().minCoeff() + leaning_gap * extent;
  ConvexPiece<Dim> centre;
  centre.corners = {body.centre};
  centre.edges = {std::array{0, 0}};
  return std::ranges::any_of(obstacle, [&](const ConvexPiece<Dim>& piece) {
    const Box<Dim> bounds = piece.bounds();
    return height<Dim>(bounds.max()) > height<Dim>(body.centre) &&
           bounds.squaredExteriorDistance(body.centre) < reach * reach && signed_distance(piece, centre, reach) < reach;
  });
}

template <int Dim>
using Pieces = std::vector<std::vector<ConvexPiece<Dim>>>;

template <int Dim>
Pieces<Dim> pieces_of(const WorldDescription<Dim>& world) {
  Pieces<Dim> pieces;
  for (const Obstacle<Dim>& obstacle : world.obstacles)
    pieces.push_back(convex_pieces_at(obstacle.shape, obstacle.pose));
  return pieces;
}

/// Bodies beside an obstacle that reaches above their centre. What lies on a level slab does not count.
template <int Dim>
std::size_t held_bodies(std::span<const PlacedBody<Dim>> bodies, const Pieces<Dim>& obstacles, double extent) {
  return std::ranges::count_if(bodies, [&](const PlacedBody<Dim>& body) {
    return std::ranges::any_of(obstacles, [&](const auto& obstacle) { return holds<Dim>(obstacle, body, extent); });
  });
}

/// Mean heights of the surface in the four quarters of `radius`, from the middle outwards [m].
std::array<double, 4> heights_of_quarters(std::span<const ProfileBin> profile, double radius) {
  std::array<double, 4> sum{};
  std::array<double, 4> columns{};
  for (const ProfileBin& bin : profile) {
    const double quarter = 4.0 * std::abs(bin.at) / radius;
    if (quarter >= 4.0) continue;
    sum[static_cast<std::size_t>(quarter)] += bin.columns * bin.height;
    columns[static_cast<std::size_t>(quarter)] += bin.columns;
  }
  for (std::size_t i = 0; i < 4; ++i) sum[i] /= std::max(columns[i], 1.0);
  return sum;
}

bool falls_outwards(std::span<const ProfileBin> profile, double radius, double extent) {
  const std::array<double, 4> quarters = heights_of_quarters(profile, radius);
  for (std::size_t i = 0; i + 1 < 4; ++i)
    if (quarters[i + 1] > quarters[i] + 0.25 * extent) return false;
  return true;
}

/// Empty where the bodies are a heap with a slope.
template <int Dim>
std::string why_no_heap(const ShapeStatistics<Dim>& shape, std::size_t held, double extent) {
  if (static_cast<double>(held) > largest_held_share * shape.bodies)
    return fmt::format("obstacles hold {} of the {} bodies", held, shape.bodies);
  if (shape.repose.bins < 3) return "the surface is narrower than three strips of D/2";
  if (!falls_outwards(shape.profile, shape.r95, extent))
    return "the surface does not fall from its middle outwards, as that of one heap does";
  if (shape.repose.apex < lowest_pile * extent) return "the heap is lower than two bodies";
  if (shape.repose.angle < min_angle_of_repose) return "the surface is flatter than 5 degrees";
  return {};
}

/// Whether a point lies in a piece, or within its radius of a face.
template <int Dim>
bool inside(const ConvexPiece<Dim>& piece, const Vec<Dim>& point) {
  return piece.bounds().contains(point) && std::ranges::all_of(piece.normals, [&](const Vec<Dim>& normal) {
           const auto along = [&](const Vec<Dim>& corner) { return normal.dot(corner); };
           const auto [low, high] = std::ranges::minmax(piece.corners, {}, along);
           return along(point) >= along(low) - piece.radius && along(point) <= along(high) + piece.radius;
         });
}

/// The part of the plane that bodies cover, seen from above, less what obstacles take of it at one height.
template <int Dim>
class Section {
 public:
  explicit Section(std::span<const PlacedBody<Dim>> bodies) {
    Box<Dim> all;
    for (const PlacedBody<Dim>& body : bodies) all.extend(body.bounds);
    low_ = all.min();
    width_ = horizontal<Dim>(Vec<Dim>(all.sizes())).maxCoeff() / cells;
    for (int axis = 0; axis + 1 < Dim; ++axis)
      count_[axis] = std::max(1, static_cast<int>(std::ceil(all.sizes()[axis] / width_)));
    covered_.assign(static_cast<std::size_t>(count_[0]) * count_[1], 0);
    for (const PlacedBody<Dim>& body : bodies)
      each_cell(body.bounds, [this](int x, int y) { covered_[index(x, y)] = 1; });
  }

  /// Covers gaps up to `widest` [m] between covered cells, along x and then along y.
  void close_gaps(double widest) {
    const int cells_wide = static_cast<int>(widest / width_);
    for (int y = 0; y < count_[1]; ++y) close_line(index(0, y), 1, count_[0], cells_wide);
    for (int x = 0; x < count_[0]; ++x) close_line(index(x, 0), count_[0], count_[1], cells_wide);
  }

  void cut(const ConvexPiece<Dim>& piece, double at) {
    each_cell(piece.bounds(), [&](int x, int y) {
      if (inside(piece, middle(x, y, at))) covered_[index(x, y)] = 0;
    });
  }

  /// [m^2], in 2D [m].
  double area() const { return static_cast<double>(std::ranges::count(covered_, 1)) * std::pow(width_, Dim - 1); }

 private:
  static constexpr int cells = Dim == 2 ? 4000 : 400;  // along the longer side

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * count_[0] + x; }

  void close_line(std::size_t first, int step, int length, int widest) {
    int last = -1;  // covered cell before; -1: none yet
    for (int i = 0; i < length; ++i) {
      if (covered_[first + static_cast<std::size_t>(i) * step] == 0) continue;
      for (int gap = last + 1; last >= 0 && i - last - 1 <= widest && gap < i; ++gap)
        covered_[first + static_cast<std::size_t>(gap) * step] = 1;
      last = i;
    }
  }

  Vec<Dim> middle(int x, int y, double at) const {
    Vec<Dim> point;
    point[0] = low_[0] + (x + 0.5) * width_;
    if constexpr (Dim == 3) point[1] = low_[1] + (y + 0.5) * width_;
    point[Dim - 1] = at;
    return point;
  }

  /// Calls do_cell for each cell whose middle lies in the box, seen from above.
  template <typename Function>
  void each_cell(const Box<Dim>& box, const Function& do_cell) const {
    const auto [x_first, x_last] = range(box, 0);
    const auto [y_first, y_last] = Dim == 3 ? range(box, 1) : std::pair(0, 0);
    for (int y = y_first; y <= y_last; ++y)
      for (int x = x_first; x <= x_last; ++x) do_cell(x, y);
  }

  std::pair<int, int> range(const Box<Dim>& box, int axis) const {
    const auto cell = [&](double place) { return (place - low_[axis]) / width_ - 0.5; };
    const double end = count_[axis];
    const double first = std::clamp(std::ceil(cell(box.min()[axis])), 0.0, end);
    const double last = std::clamp(std::floor(cell(box.max()[axis])), -1.0, end - 1.0);
    return {static_cast<int>(first), static_cast<int>(last)};
  }

  Vec<Dim> low_;
  double width_ = 0.0;                 // of a cell [m]
  std::array<int, 2> count_ = {1, 1};  // of cells along x and y
  std::vector<std::uint8_t> covered_;  // by cell
};

/// How the solid volume is spread over the height.
struct Spread {
  double volume = 0.0;     // [m^3], in 2D [m^2]
  double floor = 0.0;      // lowest point [m]
  double mean = 0.0;       // above it [m]
  double deviation = 0.0;  // standard deviation [m]
};

template <int Dim>
Spread spread_of(std::span<const PlacedBody<Dim>> bodies) {
  Spread spread;
  spread.floor = height<Dim>(bodies.front().bounds.min());
  for (const PlacedBody<Dim>& body : bodies) spread.floor = std::min(spread.floor, height<Dim>(body.bounds.min()));
  double moment = 0.0;
  double squares = 0.0;
  for (const PlacedBody<Dim>& body : bodies) {
    const double above = height<Dim>(body.centre) - spread.floor;
    const double own = height<Dim>(Vec<Dim>(body.bounds.sizes()));
    spread.volume += body.volume;
    moment += body.volume * above;
    squares += body.volume * (above * above + own * own / 12.0);  // a box's
  }
  spread.mean = moment / spread.volume;
  spread.deviation = std::sqrt(std::max(0.0, squares / spread.volume - spread.mean * spread.mean));
  return spread;
}

std::string few(std::size_t bodies) {
  return fmt::format("{} still, fewer than {}", bodies == 1 ? "1 body lies" : fmt::format("{} bodies lie", bodies),
                     min_bodies_for_slope);
}

template <int Dim>
Applicable<double> packing_of_bed(std::span<const PlacedBody<Dim>> bodies, const Pieces<Dim>& obstacles,
                                  double extent) {
  const Spread spread = spread_of<Dim>(bodies);
  if (2.0 * spread.mean < lowest_pile * extent) return {.why_not = "the bed is lower than two bodies"};
  if (std::abs(spread.deviation / spread.mean - even_spread) > spread_margin)
    return {.why_not = "the bodies are no bed with upright walls and a level surface"};
  Section<Dim> section(bodies);
  section.close_gaps(0.5 * extent);
  for (const auto& obstacle : obstacles)
    for (const ConvexPiece<Dim>& piece : obstacle) section.cut(piece, spread.floor + spread.mean);
  return {.value = spread.volume / (section.area() * 2.0 * spread.mean)};
}

/// How full the cone (3D) or wedge (2D) below the slope is of solid matter; a body counts where its centre is.
template <int Dim>
double packing_of_heap(std::span<const PlacedBody<Dim>> bodies, const AngleOfRepose& slope,
                       const ProfileGrid<Dim>& grid) {
  double solid = 0.0;
  for (const PlacedBody<Dim>& body : bodies) {
    const double above = height<Dim>(body.centre) - grid.base;
    const double radius = (horizontal<Dim>(body.centre) - grid.centre).norm();
    if (above >= 0.0 && above < slope.apex && radius <= slope.foot * (1.0 - above / slope.apex)) solid += body.volume;
  }
  return solid / tip_volume<Dim>(Profile<Dim>::base_area(slope.foot), slope.apex);
}

}  // namespace

template <int Dim>
PileForm pile_form(std::span<const PlacedBody<Dim>> bodies, const ShapeStatistics<Dim>& shape,
                   const ProfileGrid<Dim>& grid, const WorldDescription<Dim>& world, double extent) {
  const auto neither = [](const std::string& why) { return PileForm{{.why_not = why}, {.why_not = why}}; };
  if (bodies.size() < min_bodies_for_slope) return neither(few(bodies.size()));
  if (!is_straight_down(world.down)) return neither("gravity is not vertical");
  const Pieces<Dim> obstacles = pieces_of(world);
  const std::size_t held = held_bodies<Dim>(bodies, obstacles, extent);
  const std::string why_no = why_no_heap(shape, held, extent);
  PileForm form;
  if (why_no.empty()) {
    form.slope.value = shape.repose;
    form.packing.value = packing_of_heap<Dim>(bodies, shape.repose, grid);
    return form;
  }
  form.slope.why_not = why_no;
  if (static_cast<double>(held) > largest_held_share * shape.bodies)
    form.packing = packing_of_bed<Dim>(bodies, obstacles, extent);
  else
    form.packing.why_not = why_no;
  return form;
}

template PileForm pile_form(std::span<const PlacedBody<2>>, const ShapeStatistics<2>&, const ProfileGrid<2>&,
                            const WorldDescription<2>&, double);
template PileForm pile_form(std::span<const PlacedBody<3>>, const ShapeStatistics<3>&, const ProfileGrid<3>&,
                            const WorldDescription<3>&, double);

}  // namespace talus
