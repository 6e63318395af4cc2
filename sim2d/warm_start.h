#pragma once
// Contact impulses that outlive their contacts. Box2D finds this step's impulses from the last step's, and its contacts
// die with the fixtures that freezing and thawing exchange; without their impulses a thawed heap slumps.
//
// Impulses are found again by feature ids, which needs the fixtures' numbers in the broad phase kept
// (EngineWorld::engine_freeze()). The order of contacts is not restored, so deeply jammed stacks are a little less calm
// after a thaw (lab/notes/tried_and_left.md).

#include <box2d/box2d.h>

#include <array>
#include <deque>
#include <span>
#include <vector>

#include "sim2d/tag.h"

namespace talus::box2d {

/// A point of a former contact. Its feature id names the corner and side it came from, so it is found again on new
/// fixtures: see EngineWorld::engine_freeze().
struct SavedPoint {
  static constexpr std::uint32_t no_point = 0xffffffff;
  std::uint32_t feature = no_point;
  float normal = 0.0F;   // [N s]
  float tangent = 0.0F;  // [N s]
};

struct SavedContact {
  Tag low{};  // the fixtures, smaller tag first
  Tag high{};
  std::array<SavedPoint, b2_maxManifoldPoints> points;
};

/// Contacts between sleepers: the engine has none of these. Every contact is in the lists of both its bodies.
class SavedContacts {
 public:
  void keep(const SavedContact& contact);
  /// Removes all contacts of a body and appends them to `out`.
  void release(BodyIndex body, std::vector<SavedContact>& out);
  /// Removes all contacts with an obstacle. Costs O(contacts).
  void drop(BodyIndex obstacle);

 private:
  struct Node {
    SavedContact contact;
    std::array<std::int32_t, 2> next{};  // in the lists of the owners of `low` and of `high`; -1 at the end
  };
  std::int32_t& next_of(std::int32_t node, BodyIndex body);
  void unlink(std::int32_t node, BodyIndex body);

  std::deque<Node> nodes_;  // grows without copies and spare room
  std::vector<std::int32_t> free_;
  std::vector<std::int32_t> first_;  // by body; -1: none
};

/// Impulses saved since the last step, for contacts that the coming step makes.
class WarmStart {
 public:
  void save(b2Contact& contact);
  void save(const SavedContact& contact) { waiting_.push_back(contact); }
  void wake(BodyIndex body) { sleeping_.release(body, waiting_); }
  /// A body or an obstacle that leaves the world.
  void forget(BodyIndex side);

  /// Before a step: contacts between sleepers are put away where `keeps` says so, the others made ready to be found.
  void start_step(std::span<const std::uint8_t> asleep, bool keeps);
  void end_step() { waiting_.clear(); }
  /// From PreSolve of a contact that has just begun.
  void apply(b2Contact& contact) const;
  bool empty() const { return waiting_.empty(); }

 private:
  SavedContacts sleeping_;
  std::vector<SavedContact> waiting_;
};

}  // namespace talus::box2d
