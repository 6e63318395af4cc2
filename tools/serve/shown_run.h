#pragma once
// A simulation for the browser: one step at a time, and what there is to see of it.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/policy/sleep_event.h"
#include "common/scene/read_scene.h"

namespace talus {

/// Writes frames for one page.
class BlockWriter {
 public:
  virtual ~BlockWriter() = default;
};

/// One state of a run, copied, so that pages can be served while the run goes on.
class Snapshot {
 public:
  virtual ~Snapshot() = default;
  /// What pages know before the first frame. The same object for all snapshots of a run.
  virtual std::shared_ptr<const std::string> head() const = 0;
  virtual std::int64_t step() const = 0;
  virtual std::unique_ptr<BlockWriter> make_writer() const = 0;
  /// The block (frame_stream.h) of this state. `writer`: of a snapshot of the same run. `events`: since the page's last
  /// frame.
  virtual std::string block(BlockWriter& writer, std::span<const SleepEvent> events) const = 0;
  /// Its contacts (contact_stream.h); none where the run does not show them.
  virtual std::string contacts() const { return {}; }
};

/// A scene that is being simulated, in 2D or 3D.
class ShownRun {
 public:
  virtual ~ShownRun() = default;
  /// Throws NonFiniteState as Simulation does.
  virtual void step() = 0;
  virtual bool finished() const = 0;
  /// Length of a step [s].
  virtual double dt() const = 0;
  /// Sleep events of the last step.
  virtual std::span<const SleepEvent> events() const = 0;
  virtual std::shared_ptr<const Snapshot> snapshot() const = 0;
  /// Whether snapshots have contacts from now on. Costs nothing while false.
  virtual void show_contacts(bool show) = 0;
  /// What is known of a body here only (body_account.h), as JSON.
  virtual std::string account(std::int64_t body) const = 0;
  /// By hand between steps: wakes a body and adds `velocity` [m/s], an entry for each axis, to its own; or takes it out
  /// of the world. The text returned says what is wrong; then nothing is done. Empty: done.
  virtual std::string kick(std::int64_t body, std::span<const double> velocity) = 0;
  virtual std::string remove(std::int64_t body) = 0;
  /// From the next step on pulls a body by `point` [m], in its own axes, to `target` [m], until release():
  /// common/simulation/pull.h.
  virtual std::string pull(std::int64_t body, std::span<const double> point, std::span<const double> target) = 0;
  virtual void release() = 0;
  /// Adds a body of a shape of the scene at rest, at the lowest free place from `position` [m] upwards.
  virtual std::string add(const std::string& shape, std::span<const double> position) = 0;
  /// Takes an obstacle away, by its number in the page's head.
  virtual std::string cut(std::int64_t obstacle) = 0;
  /// The present state as a scene file (saved_scene.h), which throws as that does.
  virtual std::string saved() const = 0;
};

/// Starts the scene on the engine of that name; an empty name: the first that can simulate it. `file`: of the scene.
/// Throws as make_simulation() does, and without `force` std::invalid_argument where the scene lies outside of the
/// engine's window.
std::unique_ptr<ShownRun> show_run(const AnyScene& scene, const std::string& backend, const std::filesystem::path& file,
                                   bool force);

}  // namespace talus
