// The record of a world that a program simulates, as the tools read it.
#include <gtest/gtest.h>

#include "common/sleeper/pile_sleeper.h"
#include "common/sleeper/step_buffer.h"
#include "lcmtypes/world_feed.h"
#include "talus/talus.h"
#include "tests/lcmtypes/scratch_file.h"
#include "tools/record/recorded_run.h"

namespace talus::program_record_test {
namespace {

/// Three discs that rise and a plate that a program moves; their engine is arithmetic.
class Program {
 public:
  explicit Program(const std::string& record) {
    for (int i = 0; i < 3; ++i) add(0.5);
    plate_ = sleeper_.add(box_traits<2>(0.0, {2.0, 0.5}), {Vec2(9, 1), Rotation<2>(0)}, BodyRole::kinematic);
    sleeper_.add_static({BoxPiece<2>{.pose = {}, .half = Vec2(20, 0.5)}}, {Vec2(0, -0.5), Rotation<2>(0)});
    sleeper_.observe(record_world<2>(record, {.name = "discs", .title = "Discs that rise", .dt = dt_}));
  }
  void add(double radius) {
    BodyTraits<2> traits = ball_traits<2>(3.0, radius);
    traits.pieces = {HullPiece<2>{.corners = {Vec2::Zero()}, .radius = radius}};
    discs_.push_back(sleeper_.add(traits, at(discs_.size())));
  }
  void remove_first() {
    sleeper_.remove(discs_.front());
    discs_.front() = {};
  }
  void step() {
    ++steps_;
    StepBuffer<2> buffer;
    for (std::size_t i = 0; i < discs_.size(); ++i)
      if (!(discs_[i] == Handle{})) buffer.add(discs_[i], at(i), Vec2(0, 1), Spin<2>(0.0));
    buffer.add(plate_, {Vec2(9, 1 + 0.01 * steps_), Rotation<2>(0)}, Vec2(0, 0.01 / dt_), Spin<2>(0.0));
    sleeper_.after_step(buffer.step(dt_));
  }

 private:
  Pose<2> at(std::size_t number) const {
    return {Vec2(2.0 * static_cast<double>(number), 1 + steps_ * dt_), Rotation<2>(0)};
  }

  double dt_ = 1.0 / 60.0;
  int steps_ = 0;
  PileSleeper<2> sleeper_{Vec2(0, -9.81)};
  std::vector<Handle> discs_;
  Handle plate_;
};

RecordedRun<2> read(const std::string& path) { return std::get<RecordedRun<2>>(read_run(path)); }

TEST(TheRecordOfAProgramsWorld, IsReadWithoutASceneFile) {
  const ScratchFile file;
  {
    Program program(file.path());
    for (int i = 0; i < 60; ++i) program.step();
  }
  const RecordedRun<2> run = read(file.path());
  EXPECT_EQ(run.scene.title, "Discs that rise");
  EXPECT_EQ(run.reason, "finished");
  EXPECT_EQ(run.last_step, 60);
  EXPECT_EQ(run.frames.frames(), 30U);
  ASSERT_EQ(run.scene.world.shapes.size(), 1U);
  EXPECT_NEAR(run.scene.world.shapes[0].mass, 3.0, 1e-12);
  ASSERT_EQ(run.last.size(), 3);
  EXPECT_NEAR(run.last.pose[2].position.y(), 2.0, 1e-6);  // poses are in single precision
  EXPECT_NEAR(run.scene.world.gravity, 9.81, 1e-12);
  ASSERT_EQ(run.scene.world.obstacles.size(), 2U);
  EXPECT_TRUE(run.damage.none());
}

TEST(TheRecordOfAProgramsWorld, HasBodiesAndShapesThatCameLater) {
  const ScratchFile file;
  {
    Program program(file.path());
    for (int i = 0; i < 10; ++i) program.step();
    program.add(0.25);
    for (int i = 0; i < 10; ++i) program.step();
  }
  const RecordedRun<2> run = read(file.path());
  ASSERT_EQ(run.last.size(), 4);
  EXPECT_EQ(run.scene.world.shapes.size(), 2U);
  EXPECT_EQ(run.last.shape, (std::vector{0, 0, 0, 1}));
}

/// With as many shapes as bodies the record would else grow with their square.
TEST(TheRecordOfAProgramsWorld, TellsEachShapeOnce) {
  const ScratchFile file;
  {
    Program program(file.path());
    for (int i = 0; i < 20; ++i) {
      program.add(0.3 + 0.01 * i);
      program.step();
    }
  }
  LogReader log(file.path());
  int shapes = 0;
  for (LogEvent event; log.next(event);) shapes += event.channel == "TALUS_SHAPES" ? 1 : 0;
  EXPECT_EQ(shapes, 21 + 2);  // and two obstacles
}

TEST(TheRecordOfAProgramsWorld, LeavesOutBodiesThatWereTakenOut) {
  const ScratchFile file;
  {
    Program program(file.path());
    for (int i = 0; i < 10; ++i) program.step();
    program.remove_first();
    for (int i = 0; i < 10; ++i) program.step();
  }
  EXPECT_EQ(read(file.path()).last.removed, (std::vector<std::uint8_t>{1, 0, 0}));
}

/// A ball, a triangle and a floor.
TEST(TheRecordOfAProgramsWorld, HasTheShapesThatACProgramGives) {
  const ScratchFile file;
  talus_sleeper* sleeper = nullptr;
  const talus_options options = talus_default_options(2);
  ASSERT_EQ(talus_create(&options, &sleeper), TALUS_OK);
  talus_body body{};
  body.size = sizeof body;
  talus_handle bodies[2] = {};
  ASSERT_EQ(talus_ball(sleeper, 3.0, 0.5, &body), TALUS_OK);
  ASSERT_EQ(talus_add(sleeper, &body, &bodies[0]), TALUS_OK);
  const double triangle[] = {3.0, 3.0, 6.0, 3.0, 3.0, 6.0};
  ASSERT_EQ(talus_convex(sleeper, 3.0, triangle, 3, &body), TALUS_OK);
  body.position[0] = 5.0;
  ASSERT_EQ(talus_add(sleeper, &body, &bodies[1]), TALUS_OK) << talus_message();
  const double floor[] = {-9.0, -2.0, 9.0, -2.0, 9.0, -1.0, -9.0, -1.0};
  const talus_piece piece = {floor, 4, 0.0};
  ASSERT_EQ(talus_show(sleeper, 0, &piece, 1), TALUS_OK) << talus_message();
  talus_label label{};
  label.size = sizeof label;
  label.engine = "arithmetic";
  ASSERT_EQ(talus_record(sleeper, file.path().c_str(), &label), TALUS_OK) << talus_message();
  talus_state states[2] = {};
  states[1].position[0] = 5.0;
  const talus_step step = {sizeof step, 1.0 / 60.0, 2, bodies, states, 0, nullptr};
  talus_changes changes{};
  changes.size = sizeof changes;
  for (int i = 0; i < 2; ++i) ASSERT_EQ(talus_after_step(sleeper, &step, &changes), TALUS_OK) << talus_message();
  talus_destroy(sleeper);

  const RecordedRun<2> run = read(file.path());
  ASSERT_EQ(run.scene.world.shapes.size(), 2U);
  const auto hull = [&](int shape) { return std::get<HullPiece<2>>(run.scene.world.shapes[shape].pieces.at(0)); };
  EXPECT_NEAR(hull(0).radius, 0.5, 1e-6);
  ASSERT_EQ(hull(1).corners.size(), 3U);
  EXPECT_NEAR((hull(1).corners[0] - Vec2(-1.0, -1.0)).norm(), 0.0, 1e-6);  // (3, 3) from the mean of the corners
  ASSERT_EQ(run.scene.world.obstacles.size(), 1U);
  EXPECT_NEAR(run.last.pose[1].position.x(), 5.0, 1e-6);
}

TEST(TheRecordOfAProgramsWorld, RefusesABadLabelAndAFolderThatIsNotThereAtOnce) {
  EXPECT_THROW(record_world<2>("a.lcm", {.dt = 0.0}), InvalidValue);
  PileSleeper<2> sleeper(Vec2(0, -9.81));
  EXPECT_THROW(sleeper.observe(record_world<2>("/no/such/folder/a.lcm")), std::system_error);
}

}  // namespace
}  // namespace talus::program_record_test
