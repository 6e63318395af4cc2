// Threads that share the work of a step: run.threads.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "common/scene/read_scene.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "common/world/warning.h"
#include "tests/backends/backend.h"

namespace talus::threads_test {
namespace {

/// As the tools have one; with it the run is watched for bodies that get past others.
template <int Dim>
struct WarningList final : Observer<Dim> {
  void on_frame(const Frame<Dim>& frame) override {
    warnings.clear();
    for (const Warning& warning : frame.warnings) warnings.push_back(account(warning));
  }
  std::vector<std::string> warnings;
};

template <typename Backend>
class ThreadsTest : public BackendTest<Backend> {
 protected:
  static constexpr int dim = Backend::dim;

  struct Outcome {
    std::uint64_t hash = 0;
    std::vector<std::string> warnings;
    std::size_t most_awake = 0;
    bool operator==(const Outcome&) const = default;
  };

  /// A rain of `shape` onto a plate that moves.
  static Outcome rain(const std::string& shape, const std::string& policy, const std::string& sides, int threads) {
    const bool plane = dim == 2;
    const Scene<dim> scene = std::get<Scene<dim>>(parse_scene(
        fmt::format("title = \"rain\"\ndimension = {}\nrun.threads = {}\npolicy.kind = \"{}\"\n{}shape.a = {{{}}}\n"
                    "pile = [{{}}]\n"
                    "obstacle = [{{kind = \"box\", size = {}, position = {}, motion = {{kind = \"path\", times = [0, "
                    "9], shifts = {}}}}}]\n"
                    "source = [{{count = 1500, rate = 1500, position = {}, velocity = {}, grid = {}, spacing = {}}}]\n",
                    dim, threads, policy, sides, shape, plane ? "[60, 1]" : "[8, 8, 1]",
                    plane ? "[0, 0.5]" : "[0, 0, 0.5]", plane ? "[[0, 0], [2, 0]]" : "[[0, 0, 0], [2, 0, 0]]",
                    plane ? "[0, 12]" : "[0, 0, 12]", plane ? "[0, -14]" : "[0, 0, -14]",
                    plane ? "[60, 1]" : "[10, 10, 1]", plane ? "[1.6, 0]" : "[1.6, 1.6, 0]"),
        "text"));
    auto simulation = simulation_on<Backend>(scene);
    WarningList<dim> watcher;
    simulation.add_observer(watcher);
    Outcome outcome;
    for (int step = 0; step < 90; ++step) {
      simulation.step();
      outcome.most_awake = std::max(outcome.most_awake, simulation.world().awake().size());
    }
    outcome.hash = state_hash(simulation.world().states());
    outcome.warnings = watcher.warnings;
    return outcome;
  }

  static void expect_the_same_bits(const std::string& shape, const std::string& sides = "") {
    for (const std::string policy : {"full", "adaptive"}) {
      const Outcome one = rain(shape, policy, sides, 1);
      EXPECT_GT(one.most_awake, std::size_t{bodies_to_share}) << "else nothing is shared";
      EXPECT_TRUE(rain(shape, policy, sides, 3) == one) << policy;
    }
  }
};

TYPED_TEST_SUITE(ThreadsTest, SmallStepsBackends, BackendName);

// Their pieces meet in Bullet without a call for each pair.
TYPED_TEST(ThreadsTest, GiveTheSameBitsForBodiesOfSeveralPieces) {
  TestFixture::expect_the_same_bits("kind = \"L\", arm_x = 1.0, arm_z = 1.0, thickness = 0.4" +
                                    std::string(TypeParam::dim == 3 ? ", depth = 0.4" : ""));
}

TYPED_TEST(ThreadsTest, GiveTheSameBitsForBalls) {
  TestFixture::expect_the_same_bits("kind = \"ball\", radius = 0.5, rolling_friction = 0.02");
}

TYPED_TEST(ThreadsTest, GiveTheSameBitsBetweenPeriodicSides) {
  TestFixture::expect_the_same_bits(
      "kind = \"box\", size = " + std::string(TypeParam::dim == 2 ? "[0.8, 0.8]" : "[0.8, 0.8, 0.8]"),
      "world.periodic_x = [-60, 60]\n");
}

}  // namespace
}  // namespace talus::threads_test
