#pragma once
// A simulation for the browser: one step at a time, and what there is to see of it.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "common/scene/read_scene.h"
#include "tools/serve/page_hub.h"

namespace talus {

/// A scene that is being simulated, in 2D or 3D.
class ShownRun {
 public:
  virtual ~ShownRun() = default;
  /// Throws NonFiniteState as Simulation does.
  virtual void step() = 0;
  virtual bool finished() const = 0;
  /// Whether it finished since the world came to rest.
  virtual bool at_rest() const = 0;
  /// Of a run that has finished: looks how far its sleeping bodies would move, as `talus run` does; later frames have
  /// the result. Ends without one where `stop` returns true.
  virtual void probe_drift(const std::function<bool()>& stop) = 0;
  /// Whether the present state is a frame of output of the scene.
  virtual bool is_output() const = 0;
  /// Length of a step [s].
  virtual double dt() const = 0;
  /// What pages are told before the first frame, as JSON: {"kind": "begin", "box": corners of what is to be seen at
  /// first [m]}.
  virtual std::string beginning() const = 0;
  /// The present state, with all that happened since the last call.
  virtual ShownFrame frame() = 0;
  /// Whether frames have contacts from now on, also where the scene records none. Costs nothing while false.
  virtual void show_contacts(bool show) = 0;
  /// What only this process has of a body (body_account.h), as JSON.
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
  /// Takes an obstacle away, by its number in the scene.
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
