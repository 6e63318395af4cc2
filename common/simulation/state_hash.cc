#include "common/simulation/state_hash.h"

#include <bit>

#include "common/math/hash.h"

namespace talus {
namespace {

void add(Fnv1a& hash, double value) {
  hash.add(std::bit_cast<std::uint64_t>(value + 0.0));  // + 0.0: both zeros count as one
}
template <typename Derived>
void add(Fnv1a& hash, const Eigen::MatrixBase<Derived>& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i) add(hash, values[i]);
}
void add(Fnv1a& hash, const Rotation<2>& rotation) { add(hash, rotation.angle()); }
void add(Fnv1a& hash, const Rotation<3>& rotation) { add(hash, rotation.coeffs()); }

}  // namespace

template <int Dim>
std::uint64_t state_hash(const BodyStates<Dim>& states) {
  Fnv1a hash;
  for (std::size_t i = 0; i < states.shape.size(); ++i) {
    add(hash, states.pose[i].position);
    add(hash, states.pose[i].rotation);
    add(hash, states.velocity[i]);
    add(hash, states.spin[i]);
  }
  return hash.value();
}

template std::uint64_t state_hash(const BodyStates<2>&);
template std::uint64_t state_hash(const BodyStates<3>&);

}  // namespace talus
