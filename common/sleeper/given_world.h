#pragma once
// The world of another engine, as a World.

#include <optional>
#include <span>
#include <vector>

#include "common/sleeper/body_columns.h"
#include "common/sleeper/shape_store.h"
#include "common/world/world.h"

namespace talus {

/// A world whose states and contacts are given after each step of a foreign engine. It simulates nothing: step() takes
/// over what was given. Bodies get the numbers of removed ones.
template <int Dim>
class GivenWorld final : public World<Dim> {
 public:
  explicit GivenWorld(const Vec<Dim>& gravity);

  /// Whether put() will use the number of a removed body, and which.
  std::optional<BodyIndex> free_number() const;
  BodyIndex put(const Shape<Dim>& shape, const Pose<Dim>& pose);

  /// The body has this shape from now on.
  void reshape(BodyIndex body, const Shape<Dim>& shape);

  /// Something that is no body, `moves` if it ever may. Its number may be that of a removed one.
  int add_obstacle(const Shape<Dim>& shape, const Pose<Dim>& pose, bool moves);
  using World<Dim>::place_obstacle;
  using World<Dim>::put_obstacle;

  /// Sorts the bodies into columns that fit bodies of this extent [m] > 0. Costs O(bodies).
  void sort_for(double extent);

  void give_dt(double dt) { this->set_dt(dt); }
  /// The state of an awake body after the step. Values must be finite.
  void give(BodyIndex body, const Pose<Dim>& pose, const Vec<Dim>& velocity, const Spin<Dim>& spin);
  /// The body, awake or asleep, is elsewhere.
  void place(BodyIndex body, const Pose<Dim>& pose);
  /// All contacts of the step: either side first, pairs in any order.
  void give_contacts(std::span<const Contact<Dim>> contacts);

 private:
  int number_of(const Shape<Dim>& shape);
  // Not called: put() adds the bodies.
  Pose<Dim> engine_add(BodyIndex, const BodyDef<Dim>& def) override { return def.pose; }
  void engine_remove(std::span<const BodyIndex> bodies) override;
  void engine_remove_obstacle(int number) override { free_obstacles_.push_back(number); }
  EngineTimes engine_step() override { return {}; }
  std::optional<BodyIndex> engine_read(BodyStates<Dim>&) override { return std::nullopt; }  // give() has written them
  // What is to be done in the foreign engine, the caller does.
  void engine_set_velocity(BodyIndex, const Vec<Dim>&, const Spin<Dim>&) override {}
  void engine_set_gravity(const Vec<Dim>&) override {}
  void engine_freeze(std::span<const BodyIndex>) override {}
  void engine_thaw(std::span<const BodyIndex>) override {}
  void engine_query_box(const Box<Dim>& box, std::vector<BodyIndex>& found) const override;
  void engine_contacts(std::vector<Contact<Dim>>& contacts) const override;
  bool engine_awake(BodyIndex body) const override { return this->states().asleep[body] == 0; }
  bool is_awake(BodyIndex body) const { return body >= 0 && this->states().asleep[body] == 0; }

  BodyColumns<Dim> columns_{1.0};
  ShapeStore<Dim> shapes_;
  std::vector<BodyIndex> free_;
  std::vector<int> free_obstacles_;
  /// Contact points of one pair that were given side by side.
  struct Run {
    std::int64_t pair = 0;  // ascending as (a, b) are
    std::size_t first = 0;
    std::size_t count = 0;
  };

  std::vector<Contact<Dim>> given_;  // in the form of World::contacts()
  std::vector<Run> runs_;            // scratch
};

}  // namespace talus
