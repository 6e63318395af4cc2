#include "common/simulation/state_hash.h"

#include <bit>

namespace talus {
namespace {

struct Fnv1a {
  std::uint64_t hash = 0xcbf29ce484222325U;

  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value + 0.0);  // + 0.0: both zeros count as one
    for (int shift = 0; shift < 64; shift += 8) hash = (hash ^ ((bits >> shift) & 0xffU)) * 0x100000001b3U;
  }
  template <typename Derived>
  void add(const Eigen::MatrixBase<Derived>& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) add(values[i]);
  }
  void add(const Rotation<2>& rotation) { add(rotation.angle()); }
  void add(const Rotation<3>& rotation) { add(rotation.coeffs()); }
};

}  // namespace

template <int Dim>
std::uint64_t state_hash(const BodyStates<Dim>& states) {
  Fnv1a fnv;
  for (std::size_t i = 0; i < states.shape.size(); ++i) {
    fnv.add(states.pose[i].position);
    fnv.add(states.pose[i].rotation);
    fnv.add(states.velocity[i]);
    fnv.add(states.spin[i]);
  }
  return fnv.hash;
}

template std::uint64_t state_hash(const BodyStates<2>&);
template std::uint64_t state_hash(const BodyStates<3>&);

}  // namespace talus
