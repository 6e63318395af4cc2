// The toy engine under the whole loop: sources, piles, policies.

#include "common/simulation/make_policy.h"
#include "common/simulation/simulation.h"
#include "common/simulation/state_hash.h"
#include "tests/backends/backend.h"

namespace talus::toy_engine_test {
namespace {

using ToyEngine = BackendTest<Toy>;

Scene<3> rain(const std::string& policy, const WorldDescription<3>& world) {
  Scene<3> scene;
  scene.world = world;
  scene.policy.kind = policy;
  Source<3> source;
  source.shapes.push_back(1);
  source.count = 20;
  source.position = up<3>(10.0);
  source.spread = {3.0, 3.0, 0.0};
  scene.sources = {source};
  scene.piles.resize(1);
  return scene;
}

TEST_F(ToyEngine, FallsBySemiImplicitEulerAndStopsOnTheGround) {
  const auto world = make_toy_world(description());
  const BodyIndex body = world->add(at(up<3>(20.0), 1, Vec3(2.0, 0.0, 0.0)));
  run(*world, 1.0);
  const double fallen = 10.0 / 3600.0 * 60 * 61 / 2.0;
  EXPECT_NEAR(height_of(*world, body), 20.0 - fallen, 1e-9);
  run(*world, 2.0);
  EXPECT_DOUBLE_EQ(height_of(*world, body), 0.5);
  EXPECT_NEAR(pose(*world, body).position.x(), 6.0, 1e-9) << "without friction";
}

TEST_F(ToyEngine, AFrozenBodyStaysUntilItIsThawed) {
  const auto world = make_toy_world(description());
  const BodyIndex body = world->add(at(up<3>(20.0), 1, Vec3(0.0, 0.0, -3.0)));
  freeze(*world, body);
  run(*world, 1.0);
  EXPECT_EQ(height_of(*world, body), 20.0);
  thaw(*world, body);
  world->step();
  EXPECT_NEAR(height_of(*world, body), 20.0 - 10.0 / 3600.0, 1e-12) << "from rest";
}

TEST_F(ToyEngine, RunsASceneUnderEveryPolicyToTheSameBitsTwice) {
  for (const char* policy : {"full", "paper", "adaptive"}) {
    std::vector<std::uint64_t> hashes;
    for (int round = 0; round < 2; ++round) {
      const Scene<3> scene = rain(policy, description());
      Simulation<3> simulation(scene, make_toy_world(scene.world), make_policy(scene));
      for (int step = 0; step < 600; ++step) simulation.step();
      EXPECT_EQ(simulation.world().states().size(), 20) << policy;
      EXPECT_TRUE(simulation.world().awake().empty() || scene.policy.kind != "adaptive") << "all have come to rest";
      hashes.push_back(state_hash(simulation.world().states()));
    }
    EXPECT_EQ(hashes[0], hashes[1]) << policy;
  }
}

}  // namespace
}  // namespace talus::toy_engine_test
