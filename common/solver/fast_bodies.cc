#include "common/solver/fast_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/shape/convex_piece.h"

namespace talus {
namespace {

constexpr float thickness_share = 0.5F;  // of the thinnest piece, which a body goes in a step before it is fast
constexpr float negligible = 1e-4F;      // of that way: normals and arms of contacts hardly change over it
constexpr int longest_search = 32;       // gaps, after which pieces that turn past each other are taken for touching

}  // namespace

template <int Dim>
std::optional<float> first_touch(const StepMotion<Dim>& a, const StepMotion<Dim>& b, float turns, float near,
                                 const std::function<PieceGap<Dim>(float)>& gap_at) {
  const VecF<Dim> approach = a.way - b.way;
  float share = 0.0F;
  for (int i = 0; i < longest_search; ++i) {
    const PieceGap<Dim> gap = gap_at(share);
    if (gap.distance <= near) return share;
    const float closing = approach.dot(gap.normal) + turns;
    if (closing <= 0.0F) return std::nullopt;
    share += gap.distance / closing;
    if (share > 1.0F) return std::nullopt;
  }
  return share;
}

template <int Dim>
FastBodies<Dim>::FastBodies(const WorldDescription<Dim>& description) : ground_(description.ground) {
  double thinnest = std::numeric_limits<double>::infinity();
  for (const Shape<Dim>& shape : description.shapes) {
    reach_ = std::max(reach_, static_cast<float>(bounding_radius(shape)));
    thinnest = std::min(thinnest, least_width(shape));
    materials_.push_back(shape.material);
    std::vector<Corner>& corners = corners_.emplace_back();
    for (const ConvexPiece<Dim>& piece : convex_pieces(shape))
      for (const Vec<Dim>& corner : piece.corners) corners.push_back({corner, piece.radius});
  }
  for (const Obstacle<Dim>& obstacle : description.obstacles)
    obstacle_reaches_.push_back(static_cast<float>(bounding_radius(obstacle.shape)));
  limit_ = thickness_share * static_cast<float>(thinnest);
}

template <int Dim>
void FastBodies<Dim>::expect(const ContactSolver<Dim>& solver, int bodies, float dt) {
  expected_.resize(bodies);
  found_.clear();
  longest_ = 0.0F;
  for (int slot = 1; slot <= bodies; ++slot) {
    const SolverBody<Dim>& body = solver.body(slot);
    expected_[slot - 1] = {dt * body.velocity, dt * body.spin};
    longest_ = std::max(longest_, way_of(motion(slot)));
    if (is_fast(slot)) found_.push_back(slot);
  }
}

template <int Dim>
StepMotion<Dim> FastBodies<Dim>::drift(const StepMotion<Dim>& motion, float reach) const {
  const float way = way_of(motion, reach);
  return way > limit_ || way < negligible * limit_ ? StepMotion<Dim>{} : motion.after(0.5F);
}

template <int Dim>
void FastBodies<Dim>::follow(const ContactSolver<Dim>& solver) {
  found_.clear();
  for (int slot = 1; slot <= std::ssize(expected_); ++slot) {
    const StepMotion<Dim> moved{solver.body(slot).way, solver.body(slot).turn};
    if (stray(moved, motion(slot)) <= limit_) continue;
    expected_[slot - 1] = moved;
    longest_ = std::max(longest_, way_of(moved));
    found_.push_back(slot);
  }
}

/// How far a point of a body that has moved comes out of the path on which it was expected at most.
template <int Dim>
float FastBodies<Dim>::stray(const StepMotion<Dim>& moved, const StepMotion<Dim>& expected) const {
  const float squared_reach = reach_ * reach_;
  const float length = expected.way.squaredNorm() + squared_reach * expected.turn.squaredNorm();
  const float along = expected.way.dot(moved.way) + squared_reach * expected.turn.dot(moved.turn);
  const float share = length > 0.0F ? std::clamp(along / length, 0.0F, 1.0F) : 0.0F;
  return way_of({moved.way - share * expected.way, moved.turn - share * expected.turn});
}

template <int Dim>
bool FastBodies<Dim>::passes(const ContactSolver<Dim>& solver, const ContactPoint<Dim>& point) const {
  return solver.gap_after(point) < -corner();
}

template <int Dim>
void FastBodies<Dim>::meet_ground(int slot, int shape, const Pose<Dim>& pose, bool buried,
                                  std::vector<ContactPoint<Dim>>& found) const {
  if (!ground_.present) return;
  ContactPoint<Dim> point;
  point.b = slot;
  point.friction = static_cast<float>(pair_friction(ground_.material.friction, materials_[shape].friction));
  point.restitution = static_cast<float>(pair_restitution(ground_.material.restitution, materials_[shape].restitution));
  for (const Corner& corner : corners_[shape]) {
    const Vec<Dim> arm = pose.rotation * corner.place - corner.radius * Vec<Dim>::Unit(Dim - 1);
    const Vec<Dim> place = pose.position + arm;
    point.gap = static_cast<float>(place[Dim - 1] - ground_.height);
    point.arm_a = place.template cast<float>();  // the ground never turns
    point.arm_b = arm.template cast<float>();
    const float after = point.gap + motion(slot).of(point.arm_b)[Dim - 1];
    if (after < 0.0F && (buried || point.gap > 0.0F)) found.push_back(point);
  }
}

template std::optional<float> first_touch(const StepMotion<2>&, const StepMotion<2>&, float, float,
                                          const std::function<PieceGap<2>(float)>&);
template std::optional<float> first_touch(const StepMotion<3>&, const StepMotion<3>&, float, float,
                                          const std::function<PieceGap<3>(float)>&);
template class FastBodies<2>;
template class FastBodies<3>;

}  // namespace talus
