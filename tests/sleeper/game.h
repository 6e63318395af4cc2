#pragma once
// A game on an engine of one's own.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "common/math/require.h"
#include "common/sleeper/given_step.h"
#include "tests/sleeper/drops.h"
#include "tests/sleeper/support_chain.h"

namespace talus::test {

/// Boxes come, go, are teleported, pushed and carried; now and then the state is saved or loaded. Everything is drawn
/// from a seed, and what must hold is checked after each operation. `Scene` is SleepingBulletScene or the like.
template <typename Scene>
class Game {
 public:
  explicit Game(unsigned seed) : random_(seed) {
    lift_ = &scene_.add_lift(lift_size(), lift_at());
    save();
  }

  /// Stops at the first operation after which something is wrong, and says what; empty: nothing.
  std::string play(int operations) {
    for (int number = 0; number < operations; ++number) {
      const int what = static_cast<int>(random_() % 17);
      act(what);
      std::string wrong = lost();
      for (int i = 0; i < 10; ++i) step();
      wrong += lost() + hanging();
      if (!gone_.empty() && !refuses(gone_.back())) wrong += "a handle of a removed box is accepted; ";
      if (!wrong.empty()) return "operation " + std::to_string(number) + ", " + std::to_string(what) + ": " + wrong;
    }
    return {};
  }
  /// Nothing happens until all is at rest.
  void rest() {
    lift_speed_ = 0.0;
    for (int i = 0; i < 900; ++i) step();
  }
  /// Boxes without support. Each is woken by itself, from the top of the heap down, while those below it sleep. It
  /// counts if it then falls by more than nine tenths of a free fall.
  int floating() {
    std::vector<Body*> from_top = boxes_;
    std::ranges::sort(from_top, std::greater{}, [&](const Body* box) { return scene_.place(*box)[up]; });
    constexpr int steps = 6;
    const double free_fall = 9.81 * drop_dt * drop_dt * steps * (steps + 1) / 2;
    int count = 0;
    for (Body* box : from_top) {
      if (!scene_.sleeper->asleep(*box)) continue;
      const double height = scene_.place(*box)[up];
      scene_.sleeper->wake(*box);
      for (int i = 0; i < steps; ++i) scene_.step_engine();
      count += height - scene_.place(*box)[up] > 0.9 * free_fall ? 1 : 0;
    }
    return count;
  }
  /// Boxes that are lost or sleep in the ground, with their places; empty: none. One that falls again and again, since
  /// it is taken up or loaded, is within the ground for a step or two when it lands, until the engine pushes it out.
  std::string lost() const {
    std::string found;
    if (scene_.sleeper->size() != static_cast<int>(boxes_.size()) + 1) found += "other numbers of bodies; ";
    for (const Body* box : boxes_) {
      const Vector at = scene_.place(*box);  // a box at NaN passes no comparison, so it counts as lost
      if (scene_.sleeper->watches(*box) && at[up] > (scene_.sleeper->asleep(*box) ? 0.1 : -0.5) &&
          at.cwiseAbs().maxCoeff() < 100)
        continue;
      for (const double number : at) found += std::to_string(number) + " ";
    }
    return found;
  }
  bool refuses_removed() const {
    return std::ranges::all_of(gone_, [&](Handle handle) { return refuses(handle); });
  }
  int awake() const { return scene_.sleeper->awake(); }
  std::size_t boxes() const { return boxes_.size(); }
  static constexpr std::size_t most_boxes = 60;
  std::uint32_t highest_slot() const {
    std::uint32_t highest = 0;
    for (const Body* box : boxes_) highest = std::max(highest, scene_.sleeper->handle(*box).slot);
    return highest;
  }

  /// Sleeping boxes that no chain of touching bodies holds, now and when last called. A box may hang for a few steps,
  /// while the one below it begins to fall.
  std::string hanging() {
    constexpr double gap = 0.05;  // [m] by which a support may have moved away
    Vector ground = Vector::Constant(200.0);
    Vector ground_at = Vector::Zero();
    ground[up] = 2.0;
    ground_at[up] = -1.0;
    std::vector<ConvexPiece<dim>> pieces;
    for (const Body* box : boxes_) pieces.push_back(box_at<dim>(box_size<dim>(), scene_.pose(*box)));
    const std::vector<bool> holds =
        held<dim>(pieces, {box_at<dim>(ground, {ground_at}), box_at<dim>(lift_size(), {scene_.place(*lift_)})}, gap);
    std::string found;
    std::set<const Body*> hang;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (holds[i] || !scene_.sleeper->asleep(*boxes_[i])) continue;
      hang.insert(boxes_[i]);
      if (hung_.contains(boxes_[i])) found += "box " + std::to_string(i) + " hangs in the air; ";
    }
    hung_ = hang;
    return found;
  }

 private:
  using Body = typename Scene::Body;
  using Saved = typename Scene::Saved;
  static constexpr int dim = Scene::dimension;
  static constexpr int up = dim - 1;
  using Vector = Vec<dim>;

  bool refuses(Handle handle) const {
    try {
      scene_.sleeper->body(handle);
      return false;
    } catch (const InvalidValue&) {
      return true;
    }
  }
  double number(double low, double high) { return low + (high - low) * fraction(random_); }
  static Vector lift_size() {
    Vector size = Vector::Constant(3.0);
    size[up] = 4.0;  // it stands in the ground, so that nothing gets under it
    return size;
  }
  Vector lift_at() const {
    Vector at = Vector::Zero();
    at[0] = 6.0;
    at[up] = lift_height_ - 2.0;
    return at;
  }
  Pose<dim> anywhere() {
    Pose<dim> pose = drops<dim>(1, static_cast<unsigned>(random_())).front();
    pose.position[0] += number(-1, 7);
    return pose;
  }
  Body& any_box() { return *boxes_[random_() % boxes_.size()]; }

  void act(int what) {
    if (what < 7 && boxes_.size() < most_boxes) boxes_.push_back(&scene_.drop(anywhere()));
    if (boxes_.empty()) return;
    if (what == 8 || what == 9) take_away(any_box());
    if (what == 10) scene_.put(any_box(), anywhere().position);
    if (what == 11) scene_.push(any_box(), Vector::Constant(number(-3, 3)));
    if (what == 12) lift_speed_ = number(-0.3, 0.3);
    if (what == 13) turn_gravity(number(-1, 1));
    if (what == 14) save();
    if (what == 15) load();
    if (what == 16) scene_.sleeper->wake(any_box());
  }
  void turn_gravity(double aside) {
    gravity_ = aside;
    Vector gravity = Vector::Zero();
    gravity[0] = aside;
    gravity[up] = -9.81;
    scene_.set_gravity(gravity);
  }
  void take_away(Body& box) {
    gone_.push_back(scene_.sleeper->handle(box));
    std::erase(boxes_, &box);
    scene_.take_away(box);
  }
  void save() {
    saved_ = scene_.sleeper->snapshot();
    places_.clear();
    for (const SavedSleep& one : saved_) places_.push_back(scene_.save(scene_.sleeper->body(one.body)));
    saved_lift_ = lift_height_;
    saved_gravity_ = gravity_;
  }
  /// Boxes of the saved state that have left since do not come back; those that have come since leave.
  void load() {
    std::set<Handle> kept;
    for (const SavedSleep& one : saved_) kept.insert(one.body);
    for (Body* box : std::vector(boxes_))
      if (!kept.contains(scene_.sleeper->handle(*box))) take_away(*box);
    std::vector<SavedSleep> there;
    for (std::size_t i = 0; i < saved_.size(); ++i) {
      if (std::ranges::find(gone_, saved_[i].body) != gone_.end()) continue;
      scene_.load(scene_.sleeper->body(saved_[i].body), places_[i]);
      there.push_back(saved_[i]);
    }
    lift_height_ = saved_lift_;
    scene_.place_lift(*lift_, lift_at());
    turn_gravity(saved_gravity_);
    scene_.sleeper->restore(there);
    if (there.size() != saved_.size()) scene_.sleeper->wake_all();  // what lay on a box that is gone must not hang
  }
  void step() {
    const double dt = number(0.8, 1.2) * drop_dt;
    lift_height_ = std::clamp(lift_height_ + lift_speed_ * dt, 0.5, 2.0);
    scene_.move_lift(*lift_, lift_at(), dt);
    scene_.step(dt);
  }

  std::mt19937 random_;
  Scene scene_;
  Body* lift_ = nullptr;
  double lift_height_ = 1.0;  // of its top [m]
  double lift_speed_ = 0.0;   // [m/s]
  double gravity_ = 0.0;      // aside [m/s^2]
  std::vector<Body*> boxes_;
  std::vector<Handle> gone_;
  std::set<const Body*> hung_;  // when last checked
  std::vector<SavedSleep> saved_;
  std::vector<Saved> places_;
  double saved_lift_ = 0.0;
  double saved_gravity_ = 0.0;
};

/// Once nothing happens any more.
template <typename Scene>
void expect_sound(Game<Scene>& game) {
  game.rest();
  EXPECT_EQ(game.lost(), "");
  EXPECT_TRUE(game.refuses_removed());
  EXPECT_LE(game.awake(), 3) << game.boxes() << " boxes";
  EXPECT_LE(game.highest_slot(), game.most_boxes);  // the most there ever were at once, and the lift
  EXPECT_EQ(game.hanging(), "");
  EXPECT_LE(game.floating(), 1);  // one may be wedged between its neighbours by the load above it, which is gone then
}

}  // namespace talus::test
