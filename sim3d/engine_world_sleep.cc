// The parts of EngineWorld that let bodies sleep and find them.

#include <algorithm>

#include "sim3d/engine_world.h"
#include "sim3d/plane.h"
#include "sim3d/states.h"

namespace talus::bullet {
namespace {

struct Finder final : btBroadphaseAabbCallback {
  explicit Finder(std::vector<BodyIndex>& into) : found(into) {}
  bool process(const btBroadphaseProxy* proxy) override {
    const int index = static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
    if (index >= 0) {
      found.push_back(index);
    }
    return true;
  }
  std::vector<BodyIndex>& found;
};

}  // namespace

template <int Dim>
void EngineWorld<Dim>::freeze(std::span<const BodyIndex> bodies) {
  for (const BodyIndex body : bodies) {
    const std::size_t i = known(body);
    if (states_.asleep[i] == 0) {
      freezer_.freeze(objects_[i], shape_of(i));
      put_to_sleep(states_, body);
    }
  }
  std::erase_if(listed_, [this](BodyIndex body) { return rigid_body(static_cast<std::size_t>(body)) == nullptr; });
  relist();
}

template <int Dim>
void EngineWorld<Dim>::thaw(std::span<const BodyIndex> bodies) {
  const auto before = static_cast<std::ptrdiff_t>(listed_.size());
  for (const BodyIndex body : bodies) {
    const std::size_t i = known(body);
    if (states_.asleep[i] != 0) {
      if (rigid_body(i) == nullptr) {
        freezer_.thaw(objects_[i], shape_of(i), description_.engine_sleep);
        listed_.push_back(body);
      }
      objects_[i]->activate(true);
      states_.asleep[i] = 0;
    }
  }
  std::sort(listed_.begin() + before, listed_.end());
  std::inplace_merge(listed_.begin(), listed_.begin() + before, listed_.end());
  relist();
}

// Bullet's lists in the order of indices, whatever the order of freezing and thawing was.
template <int Dim>
void EngineWorld<Dim>::relist() {
  rigid_.clear();
  awake_.clear();
  for (const BodyIndex body : listed_) {
    const auto i = static_cast<std::size_t>(body);
    rigid_.push_back(rigid_body(i));
    if (states_.asleep[i] == 0) {
      awake_.push_back(body);
    }
  }
  engine_.world.set_bodies(rigid_);
  if (!description_.skips.sleepers) {
    list_sleepers();
  }
}

template <int Dim>
void EngineWorld<Dim>::list_sleepers() {
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (objects_[i] != nullptr && rigid_body(i) == nullptr) {
      engine_.world.list(*objects_[i]);
    }
  }
}

// The broadphase knows where a body was before the last step and where it would have gone undisturbed. Looked for only
// when asked and kept aside, since telling the broadphase would change the order of pairs and so the run.
template <int Dim>
void EngineWorld<Dim>::find_strayed() const {
  strayed_.clear();
  for (const btRigidBody* body : rigid_) {
    btVector3 low;
    btVector3 high;
    body->getAabb(low, high);
    const auto* proxy = static_cast<const btDbvtProxy*>(body->getBroadphaseProxy());
    if (!proxy->leaf->volume.Contain(btDbvtVolume::FromMM(low, high))) {
      strayed_.push_back(body->getUserIndex());
    }
  }
  strayed_known_ = true;
}

template <int Dim>
void EngineWorld<Dim>::near(const Box<Dim>& box, std::vector<BodyIndex>& found) const {
  if (!strayed_known_) {
    find_strayed();
  }
  const auto before = static_cast<std::ptrdiff_t>(found.size());
  btVector3 low = to_bullet(Vec<Dim>(box.min()));
  btVector3 high = to_bullet(Vec<Dim>(box.max()));
  Finder finder(found);
  const_cast<Engine&>(engine_).broadphase.aabbTest(low, high, finder);
  for (const BodyIndex body : strayed_) {
    btVector3 body_low;
    btVector3 body_high;
    rigid_body(static_cast<std::size_t>(body))->getAabb(body_low, body_high);
    if (TestAabbAgainstAabb2(low, high, body_low, body_high)) {
      found.push_back(body);
    }
  }
  std::sort(found.begin() + before, found.end());
  found.erase(std::unique(found.begin() + before, found.end()), found.end());
}

template void EngineWorld<2>::freeze(std::span<const BodyIndex>);
template void EngineWorld<3>::freeze(std::span<const BodyIndex>);
template void EngineWorld<2>::thaw(std::span<const BodyIndex>);
template void EngineWorld<3>::thaw(std::span<const BodyIndex>);
template void EngineWorld<2>::relist();
template void EngineWorld<3>::relist();
template void EngineWorld<2>::list_sleepers();
template void EngineWorld<3>::list_sleepers();
template void EngineWorld<2>::near(const Box<2>&, std::vector<BodyIndex>&) const;
template void EngineWorld<3>::near(const Box<3>&, std::vector<BodyIndex>&) const;
template void EngineWorld<2>::find_strayed() const;
template void EngineWorld<3>::find_strayed() const;

}  // namespace talus::bullet
