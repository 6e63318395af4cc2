#include "common/shape/moments.h"

#include <array>
#include <numbers>

#include "common/shape/convex_hull.h"

namespace talus {
namespace {

using std::numbers::pi;

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
Moments<Dim> moments_of(const BoxPiece<Dim>& box) {
  const double volume = (2.0 * box.half).prod();
  const Matrix<Dim> turn = box.pose.rotation.toRotationMatrix();
  const Vec<Dim> local = volume / 3.0 * box.half.cwiseAbs2();
  return {volume, box.pose.position, turn * local.asDiagonal() * turn.transpose()};
}

template <int Dim>
double ball_volume(double radius) {
  return Dim == 2 ? pi * radius * radius : 4.0 / 3.0 * pi * radius * radius * radius;
}

// The mean of x^2 over a ball around the origin is r^2 / (Dim + 2).
template <int Dim>
Moments<Dim> ball_moments(const Vec<Dim>& centre, double radius) {
  const double volume = ball_volume<Dim>(radius);
  return {volume, centre, volume * radius * radius / (Dim + 2) * Matrix<Dim>::Identity()};
}

// A rod of half length h (rectangle or cylinder) between two halves of a ball. The flat side of a half ball lies h from
// the middle, its own centre `offset` further out.
template <int Dim>
Moments<Dim> capsule_moments(const Vec<Dim>& a, const Vec<Dim>& b, double r) {
  const double half = (b - a).norm() / 2.0;
  const Vec<Dim> axis = (b - a).normalized();
  const double rod = 2.0 * half * (Dim == 2 ? 2.0 * r : pi * r * r);
  const double caps = ball_volume<Dim>(r);
  const double offset = Dim == 2 ? 4.0 * r / (3.0 * pi) : 3.0 * r / 8.0;
  const double along = rod * half * half / 3.0 + caps * (half * half + 2.0 * half * offset + r * r / (Dim + 2));
  const double across = rod * r * r / (Dim + 1) + caps * r * r / (Dim + 2);
  const Matrix<Dim> second = across * Matrix<Dim>::Identity() + (along - across) * axis * axis.transpose();
  return {rod + caps, (a + b) / 2.0, second};
}

// Corners of the simplices, one on each edge or triangle of the surface, whose common tip is the first corner.
template <int Dim>
std::vector<std::array<int, Dim>> surface_simplices(const std::vector<Vec<Dim>>& corners) {
  std::vector<std::array<int, Dim>> simplices;
  if constexpr (Dim == 2) {
    for (int i = 1; i + 1 < static_cast<int>(corners.size()); ++i) simplices.push_back({i, i + 1});
  } else {
    for (const std::vector<int>& face : convex_hull_faces(corners))
      for (std::size_t i = 1; i + 1 < face.size(); ++i) simplices.push_back({face[0], face[i], face[i + 1]});
  }
  return simplices;
}

template <int Dim>
Moments<Dim> moments_of(const HullPiece<Dim>& hull) {
  if (hull.corners.size() == 1) return ball_moments<Dim>(hull.corners[0], hull.radius);
  if (hull.corners.size() == 2) return capsule_moments<Dim>(hull.corners[0], hull.corners[1], hull.radius);
  return moments_within<Dim>(hull.corners, surface_simplices<Dim>(hull.corners));
}

}  // namespace

// A simplex of volume V with one corner in the origin and the others the columns of E, s their sum:
// the integral of x is V s / (Dim + 1), that of x x^T is V (E E^T + s s^T) / ((Dim + 1)(Dim + 2)).
template <int Dim>
Moments<Dim> moments_within(std::span<const Vec<Dim>> corners, std::span<const std::array<int, Dim>> boundary) {
  const Vec<Dim>& tip = corners.front();
  double volume = 0.0;
  Vec<Dim> first = Vec<Dim>::Zero();
  Matrix<Dim> second = Matrix<Dim>::Zero();
  for (const std::array<int, Dim>& simplex : boundary) {
    Matrix<Dim> edges;
    for (int k = 0; k < Dim; ++k) edges.col(k) = corners[simplex[k]] - tip;
    const double part = edges.determinant() / (Dim == 2 ? 2.0 : 6.0);
    const Vec<Dim> sum = edges.rowwise().sum();
    volume += part;
    first += part / (Dim + 1) * sum;
    second += part / ((Dim + 1) * (Dim + 2)) * (edges * edges.transpose() + sum * sum.transpose());
  }
  const Vec<Dim> centre = first / volume;
  return {volume, tip + centre, second - volume * centre * centre.transpose()};
}

template <int Dim>
Moments<Dim>& Moments<Dim>::operator+=(const Moments& other) {
  const double total = volume + other.volume;
  const Vec<Dim> apart = other.centre - centre;
  second += other.second + volume * other.volume / total * apart * apart.transpose();
  centre += other.volume / total * apart;
  volume = total;
  return *this;
}

template <int Dim>
Inertia<Dim> Moments<Dim>::inertia() const {
  if constexpr (Dim == 2)
    return Inertia<2>(second.trace());
  else
    return second.trace() * Inertia<3>::Identity() - second;
}

template <int Dim>
Moments<Dim> moments(const Piece<Dim>& piece) {
  return std::visit([](const auto& kind) { return moments_of(kind); }, piece);
}

template struct Moments<2>;
template struct Moments<3>;
template Moments<2> moments(const Piece<2>&);
template Moments<3> moments(const Piece<3>&);
template Moments<2> moments_within<2>(std::span<const Vec<2>>, std::span<const std::array<int, 2>>);
template Moments<3> moments_within<3>(std::span<const Vec<3>>, std::span<const std::array<int, 3>>);

}  // namespace talus
