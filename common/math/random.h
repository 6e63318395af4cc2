#pragma once
// Random numbers that are the same on every compiler: the standard pins its generators, not its distributions.

#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "common/math/vector.h"

namespace talus {

/// A generator of its own for each seed and row of numbers below 2^32.
inline std::mt19937_64 generator_of(std::uint64_t seed, std::span<const std::uint64_t> numbers) {
  std::vector<std::uint64_t> parts = {seed};
  parts.insert(parts.end(), numbers.begin(), numbers.end());
  if (const std::uint64_t high = seed >> 32U; high != 0) parts.push_back(high);  // std::seed_seq takes 32 bits of each
  std::seed_seq sequence(parts.begin(), parts.end());
  return std::mt19937_64(sequence);
}

/// Uniform in [0, 1), from the upper 53 bits of one draw.
inline double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

/// Uniform in [-1, 1).
inline double uniform_both_sides(std::mt19937_64& random) { return 2.0 * uniform(random) - 1.0; }

/// Each entry uniform within `spread` to both sides of 0, drawn axis by axis.
template <int Size>
Eigen::Matrix<double, Size, 1> uniform_within(const Eigen::Matrix<double, Size, 1>& spread, std::mt19937_64& random) {
  Eigen::Matrix<double, Size, 1> drawn;
  for (Eigen::Index axis = 0; axis < Size; ++axis) drawn[axis] = spread[axis] * uniform_both_sides(random);
  return drawn;
}

/// Uniform over all rotations (3D: Shoemake, "Uniform random rotations", Graphics Gems III, 1992).
template <int Dim>
Rotation<Dim> uniform_rotation(std::mt19937_64& random) {
  const double turn = 2.0 * std::numbers::pi;
  if constexpr (Dim == 2) {
    return Rotation<2>(turn * uniform(random));
  } else {
    const double share = uniform(random);
    const double first = turn * uniform(random);
    const double second = turn * uniform(random);
    const double a = std::sqrt(1.0 - share);
    const double b = std::sqrt(share);
    return Rotation<3>(b * std::cos(second), a * std::sin(first), a * std::cos(first), b * std::sin(second));
  }
}

}  // namespace talus
