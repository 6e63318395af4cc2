// The screens of the monitor, as text.

#include "tools/monitor/pages.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "lcmtypes/piles_message.h"
#include "lcmtypes/run_message.h"
#include "lcmtypes/sleep_message.h"
#include "lcmtypes/wire.h"

namespace talus::pages_test {
namespace {

using talus_lcm::talus_run;
using talus_lcm::talus_stats;

const auto start = RunTable::Clock::time_point(std::chrono::hours(1));

/// A listener, the choice of a user, and the screen that both give.
struct Screen {
  Listener listener;
  Choice choice;
  Faults faults;
  RunTable::Clock::time_point now = start;

  Heard heard() const { return {listener, faults, "udpm://somewhere", now}; }
  Effect press(int key) { return obey(key, heard(), choice); }
  std::string text(int rows = 24, int columns = 80) const {
    Sheet sheet(rows, columns);
    draw(heard(), choice, sheet);
    return sheet.text();
  }
};

/// Sends the messages of one run.
class Sender {
 public:
  Sender(Screen& screen, std::int64_t id, const std::string& scene)
      : screen_(screen), encoder_(id), info_{.scene = scene, .backend = "box2d", .policy = "paper", .version = "1"} {
    info_.steps = 600;
    run(talus_run::BEGIN);
  }

  template <class Message>
  void send(Message message) {
    const Packet packet = encoder_.encode(message, {.utime = step_, .step = step_, .sim_time = 0.1 * step_});
    if (lose_ == 0) screen_.listener.hear({packet.channel, packet.bytes}, screen_.now);
    lose_ = std::max(lose_ - 1, 0);
  }
  void run(std::int8_t phase, const std::string& reason = {}) {
    send(to_run(info_, phase, reason, all_channels, encoder_));
  }
  void stats(int awake, int asleep) {
    ++step_;
    talus_stats stats{};
    stats.awake = awake;
    stats.asleep = asleep;
    stats.planned = stats.appeared = awake + asleep;
    stats.drift_estimate = 0.0125;
    stats.checked_share = 0.5;
    stats.timed = 1;
    stats.ms_step = stats.ms_solve = 1.25F;
    stats.real_time_factor = 8.5F;
    send(stats);
  }
  void pile(int layers, const LayerThresholds& thresholds = {}) {
    Pile<3> pile = in_space(make_pile<2>(Vec2::Zero(), 0.8, 100.0, {}));
    pile.layers.assign(static_cast<std::size_t>(layers), {.bottom = 0.0,
                                                          .top = 1.0,
                                                          .radius = 3.0,
                                                          .capacity = 10.0,
                                                          .count = 9,
                                                          .sleeping = 7,
                                                          .thresholds = thresholds});
    for (auto& message : to_piles(std::span(&pile, 1))) send(message);
  }
  void event(int body, SleepCause cause, bool woke) {
    const SleepEvent event{
        .body = body, .pile = 0, .layer = 1, .woke = woke, .cause = cause, .score = woke ? 0.0 : 0.75};
    for (auto& message : to_sleep(std::span(&event, 1))) send(message);
  }
  void lose(int messages) { lose_ = messages; }

 private:
  Screen& screen_;
  MessageEncoder encoder_;
  RunInfo info_;
  int step_ = 0;
  int lose_ = 0;
};

::testing::AssertionResult shows(const std::string& screen, const std::string& text) {
  if (screen.find(text) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "no \"" << text << "\" in\n" << screen;
}

TEST(MonitorPages, SayWhatIsWaitedForBeforeARunIsHeard) {
  EXPECT_TRUE(shows(Screen().text(), "waiting on udpm://somewhere"));
}

TEST(MonitorPages, ShowARunOnEightyColumns) {
  Screen screen;
  Sender run(screen, 42, "heap");
  run.stats(100, 0);
  run.stats(30, 70);
  run.pile(3);
  run.event(17, SleepCause::rest, false);
  const std::string text = screen.text();
  for (const char* part : {"talus monitor on udpm://somewhere", "0000002a heap box2d paper", "step 2 of 600  0.20 s",
                           "8.50 x real time", "100 of 100 bodies", "estimated drift 0.013 D, 50 % checked", "lost 0",
                           "awake 30, at most 100", "asleep 70, at most 70", "pile 0: 3 layers",
                           "    2 0.90    9/10       7", "      2     17 slept rest         0.75", "ms per step: 1.25",
                           "solve      1.250", "SLEEP          0.5", "q quit"})
    EXPECT_TRUE(shows(text, part));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 24);
}

TEST(MonitorPages, JoinNeighbouringLayersThatDoNotFit) {
  Screen screen;
  Sender run(screen, 42, "heap");
  run.pile(40);
  EXPECT_TRUE(shows(screen.text(), "  0-5 0.90   54/60      42"));
  screen.press('l');
  EXPECT_TRUE(shows(screen.text(60), "   39 0.90    9/10       7"));
}

TEST(MonitorPages, ShowTheThresholdsOfThePolicyForEachLayer) {
  Screen screen;
  Sender run(screen, 42, "heap");
  run.pile(3, {.sleep = 0.5, .wake = 0.8});
  EXPECT_TRUE(shows(screen.text(), "layer dens bodies/cap sleep wake>"));
  EXPECT_TRUE(shows(screen.text(), "    2 0.90    9/10       7  0.80"));
  screen.press('l');
  EXPECT_TRUE(shows(screen.text(60), "    2 0.90    9/10       7  0.80   0.50"));
}

TEST(MonitorPages, ShowWhatTheSceneMeasures) {
  Screen screen;
  Sender run(screen, 42, "silo");
  talus_lcm::talus_instruments instruments{};
  instruments.parts = instruments.gate_count = instruments.region_count = 1;
  instruments.gates.resize(1);
  instruments.gates[0].name = "slot";
  instruments.gates[0].forward = 70;
  instruments.gates[0].backward = 2;
  instruments.gates[0].jammed = 1;
  instruments.regions.resize(1);
  instruments.regions[0].name = "bulk";
  instruments.regions[0].bodies = 24;
  instruments.regions[0].packing = 0.613;
  instruments.regions[0].mean_speed = 0.025;
  instruments.load_count = 2;
  instruments.loads.resize(2);
  instruments.loads[0].name = "floor";
  instruments.loads[0].known = 1;
  instruments.loads[0].force[2] = -12345.0;
  instruments.loads[1].name = "wall";
  run.send(instruments);
  for (const char* part :
       {"gates, regions, loads", "slot       70 passed, 2 back, jammed", "bulk       24 bodies, 61.3 %, 0.025 m/s",
        "floor      (0, -1.23e+04) N", "wall       not known"})
    EXPECT_TRUE(shows(screen.text(), part));
  run.pile(3);
  EXPECT_TRUE(shows(screen.text(), "pile 0: 3 layers"));
  EXPECT_TRUE(shows(screen.text(), "i: all")) << "beside a pile there is less room";
  screen.press('i');
  EXPECT_TRUE(shows(screen.text(), "wall       not known"));
}

TEST(MonitorPages, FilterEventsByKey) {
  Screen screen;
  Sender run(screen, 42, "heap");
  run.event(17, SleepCause::rest, false);
  for (int body = 100; body < 400; ++body) run.event(body, SleepCause::momentum, true);
  screen.press('e');
  EXPECT_TRUE(shows(screen.text(), "399 woke  momentum"));
  EXPECT_TRUE(shows(screen.text(), "rest                1        0"));
  EXPECT_FALSE(shows(screen.text(), "17 slept"));  // 300 others came later
  screen.press('f');
  EXPECT_TRUE(shows(screen.text(), "events: woke"));
  screen.press('f');
  EXPECT_TRUE(shows(screen.text(), "17 slept rest"));
  screen.press('f');
  EXPECT_TRUE(shows(screen.text(), "events: rest"));
}

TEST(MonitorPages, SwitchBetweenRunsAndListAllSideBySide) {
  Screen screen;
  Sender first(screen, 0x1100000000000000, "first");
  screen.now += std::chrono::seconds(1);
  Sender second(screen, 0x0200000000000000, "second");
  first.stats(5, 6);
  second.stats(7, 8);
  EXPECT_TRUE(shows(screen.text(), "run 1 of 2"));
  EXPECT_TRUE(shows(screen.text(), "first box2d paper"));
  screen.press('2');
  EXPECT_TRUE(shows(screen.text(), "second box2d paper"));
  screen.press('\t');
  EXPECT_TRUE(shows(screen.text(), "first box2d paper"));
  screen.press('r');
  EXPECT_TRUE(shows(screen.text(), "   1     0.1      5      6    8.5"));
  EXPECT_TRUE(shows(screen.text(), "   2     0.1      7      8    8.5"));
}

TEST(MonitorPages, AlertToLossSilenceWavesAndFaults) {
  Screen screen;
  Sender run(screen, 42, "heap");
  run.stats(0, 30);
  run.lose(3);
  for (int i = 0; i < 4; ++i) run.stats(0, 30);
  for (int body = 0; body < 30; ++body) run.event(body, SleepCause::avalanche, true);
  EXPECT_TRUE(shows(screen.text(), "lost 3"));
  EXPECT_TRUE(shows(screen.text(), "! 0000002a: 3 of "));
  screen.now += std::chrono::seconds(4);
  screen.faults.undecodable = 1;
  screen.faults.last_undecodable = "TALUS_RUN: too short";
  screen.press('a');
  const std::string text = screen.text();
  EXPECT_TRUE(shows(text, "30 bodies woke in step 5: avalanche"));
  EXPECT_TRUE(shows(text, "silent for 4 s"));
  EXPECT_TRUE(shows(text, "undecodable 1, the last one on TALUS_RUN: too short"));
}

TEST(SleepHistory, CountsEachCause) {
  SleepHistory history;
  for (int cause = 0; cause <= last_cause; ++cause)
    history.add({.woke = true, .cause = static_cast<SleepCause>(cause)});
  for (const SleepCause cause : {SleepCause::score, SleepCause::check, SleepCause::motion})
    EXPECT_EQ(history.count({cause, true}), 1) << to_string(cause);
  EXPECT_EQ(history.newest(20, [](const SleepEvent&) { return true; }).size(), last_cause + 1U);
}

TEST(MonitorPages, WrapAnAlertThatIsWiderThanTheScreen) {
  Screen screen;
  Sender run(screen, 42, "heap");
  talus_stats stats{};
  stats.warning_count = 1;
  stats.warning_kind = {talus_stats::OVERLAP};
  stats.warning_step = {299};
  stats.warning_body = {45};
  stats.warning_bodies = {8};
  stats.warning_value = {0.14};
  stats.warning_text = {""};
  run.send(stats);
  screen.press('a');
  const std::string text = screen.text();
  EXPECT_TRUE(shows(text, "2a: warning: 8 bodies since step 299, at worst the overlap with"));
  EXPECT_TRUE(shows(text, "is 0.14 D and lasts"));
}

TEST(MonitorPages, QuitOnlyOnRequest) {
  Screen screen;
  EXPECT_EQ(screen.press('x'), Effect::redraw);
  EXPECT_EQ(screen.press('q'), Effect::quit);
}

RC_GTEST_PROP(MonitorPagesProperty, FitAnyTerminalAndObeyAnyKey, ()) {
  Screen screen;
  Sender run(screen, 42, "h\xC3\xA4uf \xE6\xB0\xB4");
  run.stats(3, 4);
  run.pile(*rc::gen::inRange(0, 60));
  run.event(3, SleepCause::rest, false);
  const int rows = *rc::gen::inRange(0, 60);
  const int columns = *rc::gen::inRange(0, 200);
  for (int press = 0; press < 10; ++press) {
    screen.press(*rc::gen::elementOf(
        std::vector<int>{'l', 'e', 'r', 'a', '?', 'f', 'p', 'n', '2', ' ', keys::up, keys::down, keys::escape}));
    Sheet sheet(rows, columns);
    draw(screen.heard(), screen.choice, sheet);
    RC_ASSERT(sheet.rows() == rows);
  }
}

TEST(CountHistory, KeepsAWholeRunInBoundedRoom) {
  CountHistory history;
  for (int i = 0; i < 100'000; ++i) history.add({.time = 0.1 * i, .awake = i});
  const auto samples = history.samples();
  EXPECT_LE(samples.size(), CountHistory::most_samples);
  EXPECT_GE(samples.size(), CountHistory::most_samples / 2);
  EXPECT_EQ(samples.front().awake, 0);
  EXPECT_EQ(samples.back().awake, 99'999);
  const double share = samples[samples.size() / 2].time / samples.back().time;
  EXPECT_NEAR(share, 0.5, 0.01);
}

TEST(RateMeter, MeasuresTheLastTwoSeconds) {
  RateMeter meter;
  for (int i = 0; i < 100; ++i) meter.add(1000, start + std::chrono::milliseconds(50 * i));
  const auto rate = meter.rate(start + std::chrono::milliseconds(4990));
  EXPECT_NEAR(rate.messages, 20.0, 3.0);
  EXPECT_NEAR(rate.bytes, 20e3, 3e3);
  EXPECT_EQ(meter.rate(start + std::chrono::seconds(8)).messages, 0.0);
}

TEST(Sheet, LeavesOutWhatDoesNotFitAndWhatMayBeWide) {
  Sheet sheet(1, 5);
  Area(sheet).put(0, 0,
                  "ä\xE6\xB0\xB4"
                  "cdefg");
  EXPECT_EQ(sheet.line(0), "ä?cde");
  Area(sheet).put(3, 9, "outside");
  EXPECT_EQ(sheet.text(), "ä?cde\n");
}

}  // namespace
}  // namespace talus::pages_test
