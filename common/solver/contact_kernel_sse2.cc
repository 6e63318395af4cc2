// The solver's inner loops in SSE2.

#if defined(__SSE2__) && !defined(TALUS_PLAIN_LANES)
#define TALUS_LANE_WIDTH 4
#include "common/solver/contact_kernel.h"

namespace talus::solver {

void solve_sse2(const ContactArrays<2>& arrays, Pass pass) { solve<2>(arrays, pass); }
void solve_sse2(const ContactArrays<3>& arrays, Pass pass) { solve<3>(arrays, pass); }

}  // namespace talus::solver
#endif
