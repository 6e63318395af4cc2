#pragma once
// All that a scene measures.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/measure/gate_counter.h"
#include "common/measure/load_meter.h"
#include "common/measure/region_meter.h"
#include "common/policy/observer.h"
#include "common/scene/scene.h"

namespace talus {

/// The gates, regions and loads of a scene. Regions and the forces of a frame are read at each frame of output.
template <int Dim>
class InstrumentMeters final : public Observer<Dim> {
 public:
  explicit InstrumentMeters(const Scene<Dim>& scene);

  bool needs_contacts() const override { return !loads_.empty() || !regions_.empty(); }
  void on_motion(const World<Dim>& world, double time) override;
  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

  const Instruments<Dim>& instruments() const { return instruments_; }
  // In the order of instruments().
  const std::vector<GateCounter<Dim>>& gates() const { return gates_; }
  const std::vector<RegionReading>& regions() const { return readings_; }
  const std::vector<LoadMeter<Dim>>& loads() const { return loads_; }
  /// Weight that ground and obstacles carry over that of all bodies, in the last frame; with loads only.
  std::optional<double> carried() const { return carried_; }
  /// Of the last reading.
  std::int64_t read_step() const { return read_step_; }

 private:
  void note_contacts(const World<Dim>& world);
  void read(const Frame<Dim>& frame);
  void weigh(const World<Dim>& world);

  Instruments<Dim> instruments_;
  double dt_;
  std::int64_t steps_per_frame_;
  double ground_;
  std::int64_t read_step_ = 0;
  std::vector<GateCounter<Dim>> gates_;
  std::vector<RegionMeter<Dim>> regions_;
  std::vector<RegionReading> readings_;
  std::vector<LoadMeter<Dim>> loads_;
  std::optional<LoadMeter<Dim>> everything_;  // with loads
  std::optional<double> carried_;
};

}  // namespace talus
