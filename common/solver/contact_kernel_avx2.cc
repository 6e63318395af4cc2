// The solver's inner loops in AVX2.

#ifdef __AVX2__
#define TALUS_LANE_WIDTH 8
#include "common/solver/contact_kernel.h"

namespace talus::solver {

void solve_avx2(const ContactArrays<2>& arrays, Pass pass) { solve<2>(arrays, pass); }
void solve_avx2(const ContactArrays<3>& arrays, Pass pass) { solve<3>(arrays, pass); }

}  // namespace talus::solver
#endif
