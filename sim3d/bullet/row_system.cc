#include "sim3d/bullet/row_system.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace talus::bullet {

void RowOrder::sort(std::span<const RowBodies> rows, int bodies, std::int32_t fixed, std::vector<std::int32_t>& place) {
  reached_.assign(bodies, 0);
  starts_.assign(1, 0);
  place.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::int32_t& a = reached_[rows[i].a];
    std::int32_t& b = reached_[rows[i].b];
    const std::int32_t level = std::max(a, b);
    place[i] = level;
    a = rows[i].a == fixed ? 0 : level + 1;
    b = rows[i].b == fixed ? 0 : level + 1;
    if (std::ssize(starts_) < level + 2) starts_.push_back(0);
    ++starts_[level + 1];
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  for (std::int32_t& each : place) each = starts_[each]++;
}

void keep_order(std::size_t rows, std::vector<std::int32_t>& place) {
  place.resize(rows);
  std::iota(place.begin(), place.end(), 0);
}

namespace {

/// Whether all residuals are at most `residual`, as Bullet rounds them.
bool rows_at_rest(std::span<const PackedRow> rows, std::span<const float> changes, float residual) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto change =
        static_cast<float>(static_cast<double>(changes[i]) * (1.0 / static_cast<double>(rows[i].gain())));
    if (!(change * change <= residual)) return false;
  }
  return true;
}

PackedBody& at(std::vector<PackedBody>& bodies, std::int32_t i) { return bodies[i]; }

void solve_normals(std::vector<PackedRow>& rows, std::vector<PackedBody>& bodies, std::vector<float>& changes) {
  const Lanes lowest = splat(0);
  const Lanes highest = splat(std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < rows.size(); ++i)
    changes[i] = solve(rows[i], at(bodies, rows[i].a), at(bodies, rows[i].b), lowest, highest);
}

}  // namespace

void RowSystem::clear(int bodies, std::int32_t fixed) {
  fixed_ = fixed;
  bodies_.assign(bodies, {splat(0), splat(0), splat(0)});
  pushes_.clear();
  deep_contacts_.clear();
  deep_rhs_.clear();
}

void RowSystem::arrange(std::span<const RowBodies> contacts, int directions, bool by_level) {
  const std::size_t rows = contacts.size() * directions;
  contacts_.resize(contacts.size());
  frictions_.resize(rows);
  contact_changes_.resize(contacts.size());
  friction_changes_.resize(rows);
  if (!by_level) {
    keep_order(contacts.size(), contact_place_);
    keep_order(rows, friction_place_);
    return;
  }
  friction_bodies_.clear();
  for (const RowBodies& contact : contacts) friction_bodies_.insert(friction_bodies_.end(), directions, contact);
  order_.sort(contacts, static_cast<int>(bodies_.size()), fixed_, contact_place_);
  order_.sort(friction_bodies_, static_cast<int>(bodies_.size()), fixed_, friction_place_);
}

void RowSystem::add_deep(std::size_t contact, float rhs) {
  deep_contacts_.push_back(contact_place_[contact]);
  deep_rhs_.push_back(rhs);
}

void RowSystem::solve(const Settings& settings) {
  solve_deep(settings);
  for (int i = 0; i < settings.iterations; ++i) {
    solve_contacts();
    solve_frictions(settings.release_unpressed);
    if (at_rest(settings.residual)) return;
  }
}

void RowSystem::solve_deep(const Settings& settings) {
  if (deep_contacts_.empty()) return;
  pushes_ = bodies_;
  for (PackedBody& body : pushes_) {
    body.linear = splat(0);
    body.angular = splat(0);
  }
  deep_.clear();
  for (std::size_t i = 0; i < deep_contacts_.size(); ++i) {
    PackedRow& row = deep_.emplace_back(contacts_[deep_contacts_[i]]);
    float normal[4];
    store(normal, row.normal);
    row.normal = lanes(normal[0], normal[1], normal[2], deep_rhs_[i]);
    row.applied = 0;
  }
  std::vector<float>& changes = friction_changes_;
  changes.resize(std::max(changes.size(), deep_.size()));
  for (int i = 0; i < settings.iterations; ++i) {
    solve_normals(deep_, pushes_, changes);
    if (rows_at_rest(deep_, changes, settings.residual)) return;
  }
}

void RowSystem::solve_contacts() { solve_normals(contacts_, bodies_, contact_changes_); }

void RowSystem::solve_frictions(bool release_unpressed) {
  unpressed_.clear();
  for (std::size_t i = 0; i < frictions_.size(); ++i) {
    PackedRow& row = frictions_[i];
    const float push = contacts_[row.contact].applied;
    if (push > 0) {
      const Lanes limit = splat(row.friction() * push);
      friction_changes_[i] = talus::bullet::solve(row, at(bodies_, row.a), at(bodies_, row.b), -limit, limit);
    } else {
      friction_changes_[i] = 0;
      if (release_unpressed && row.applied != 0) unpressed_.push_back(i);
    }
  }
  for (const std::size_t i : unpressed_) {
    PackedRow& row = frictions_[i];
    apply(row, at(bodies_, row.a), at(bodies_, row.b), splat(0 - row.applied));
    row.applied = 0;
  }
}

bool RowSystem::at_rest(float residual) const {
  return rows_at_rest(contacts_, contact_changes_, residual) && rows_at_rest(frictions_, friction_changes_, residual);
}

}  // namespace talus::bullet
