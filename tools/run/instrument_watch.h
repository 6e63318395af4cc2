#pragma once
// The gates, regions and loads of a run.

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/measure/gate_counter.h"
#include "common/measure/load_meter.h"
#include "common/measure/region_meter.h"
#include "common/policy/observer.h"
#include "common/scene/scene.h"
#include "tools/output/csv.h"

namespace talus {

/// Measures what the scene has as [[gate]], [[region]] and [[load]], and writes gates.csv, regions.csv and loads.csv:
/// a row for each of them and each frame of output. docs/files.md explains columns and keys.
template <int Dim>
class InstrumentWatch final : public Observer<Dim> {
 public:
  InstrumentWatch(const Scene<Dim>& scene, const std::filesystem::path& folder);

  bool needs_contacts() const override { return !loads_.empty(); }
  void on_motion(const World<Dim>& world, double time) override;
  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

  /// Appends `gates`, `regions` and `loads` to a summary.
  void add_to(nlohmann::ordered_json& summary) const;
  /// A line for each.
  std::vector<std::string> lines() const;

 private:
  void write_rows(const Frame<Dim>& frame);
  void weigh(const World<Dim>& world);

  Instruments<Dim> instruments_;
  double dt_;
  std::int64_t steps_per_frame_;
  double ground_;
  std::int64_t written_step_ = 0;
  std::vector<GateCounter<Dim>> gates_;
  std::vector<RegionMeter<Dim>> regions_;
  std::vector<RegionReading> readings_;  // the last of each region
  std::vector<LoadMeter<Dim>> loads_;
  std::optional<LoadMeter<Dim>> everything_;  // with loads
  std::optional<double> carried_;             // of the weight of all bodies, in the last frame
  GrowingCsv gates_csv_;
  GrowingCsv regions_csv_;
  GrowingCsv loads_csv_;
};

}  // namespace talus
