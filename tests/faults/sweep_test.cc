// A sweep on a full disk.

#include <gtest/gtest.h>

#include "tests/faults/faults.h"

namespace talus::sweep_fault_test {
namespace {

TEST(SweepFault, AFullDiskStopsASweepWhichGoesOnLater) {
  const TemporaryFolder folder;
  const Outcome outcome = shell_in(folder, mount_namespace + R"(
[ "$in_namespace" = false ] && echo skipped && exit 3
$in_namespace bash -c '
mkdir disk && mount -t tmpfs -o size=2m none disk && head -c 1900000 /dev/zero >disk/other
sweep="sweep drop_in_a_pile_2d --set run.frames=60 --seeds 6 --jobs 1 --out disk/sweep"
"$TALUS" $sweep; code=$?
rm disk/other; mount -o remount,size=40m disk && "$TALUS" $sweep >&2 || code=99
exit $code')");
  if (outcome.out == "skipped\n") return;  // no rights for a small disk here
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("no space left on the disk: no run begins any more"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("3 of 6: "), outcome.err.rfind("3 of 6: ")) << outcome.err;
  EXPECT_NE(outcome.err.find("6 runs, 6 finished, 0 failed"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::sweep_fault_test
