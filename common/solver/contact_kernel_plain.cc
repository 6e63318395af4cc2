// The solver's inner loops in plain loops.

#define TALUS_LANE_WIDTH 1
#include "common/solver/contact_kernel.h"

namespace talus::solver {

void solve_plain(const ContactArrays<2>& arrays, Pass pass) { solve<2>(arrays, pass); }
void solve_plain(const ContactArrays<3>& arrays, Pass pass) { solve<3>(arrays, pass); }

}  // namespace talus::solver
