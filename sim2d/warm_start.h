#pragma once
// Contact impulses that outlive their contacts. Box2D finds this step's impulses from the last step's, and its contacts
// die with the fixtures that freezing and thawing exchange; without their impulses a thawed heap slumps.
//
// Tried on heaps of 400 L shapes at rest, all frozen for two seconds and thawed; peak mean speed and mean way within
// the next second, the same heap never frozen in brackets:
//   nothing restored                        0.40 to 0.47 m/s, 48 to 79 mm (at most 0.0002 m/s, 0.02 mm)
//   impulses found by the points' places    0.0000 to 0.0002 m/s, at most 0.02 mm
//   by feature ids, with the fixtures' numbers in the broad phase kept (what is done here: less to store, and no
//   contact is ever measured from its other side): the same on the jammed stack below, on heaps at rest as calm
// A stack dropped from 60 m, in which bodies are jammed 0.26 m into each other, is left less calm: 0.0059 m/s, 0.70 mm
// (0.0005 m/s, 0.13 mm; nothing restored 0.25 m/s, 25 mm), since there the order of contacts decides how the jam is
// held. With that order restored too, by giving Box2D the pairs oldest first, even this heap does as if never frozen;
// it takes writing to the engine's contact manager behind its back, so it is left out.

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
class SleepingContacts {
 public:
  void keep(const SavedContact& contact);
  /// Removes all contacts of a body and appends them to `out`.
  void release(BodyIndex body, std::vector<SavedContact>& out);

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
  void forget(BodyIndex body);

  /// Before a step: contacts between sleepers are put away where `keeps` says so, the others made ready to be found.
  void start_step(std::span<const std::uint8_t> asleep, bool keeps);
  void end_step() { waiting_.clear(); }
  /// From PreSolve of a contact that has just begun.
  void apply(b2Contact& contact) const;
  bool empty() const { return waiting_.empty(); }

 private:
  SleepingContacts sleeping_;
  std::vector<SavedContact> waiting_;
};

}  // namespace talus::box2d
