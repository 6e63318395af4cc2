#pragma once
// The gates, regions and loads of a run.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/measure/instrument_meters.h"
#include "tools/output/csv.h"

namespace talus {

/// Writes what the scene measures by [[gate]], [[region]] and [[load]] to gates.csv, regions.csv, loads.csv and
/// profiles.csv: a row for each of them and each frame of output. docs/files.md explains columns and keys.
template <int Dim>
class InstrumentWatch final : public Observer<Dim> {
 public:
  InstrumentWatch(const Scene<Dim>& scene, const std::filesystem::path& folder);

  bool needs_contacts() const override { return meters_.needs_contacts(); }
  void on_motion(const World<Dim>& world, double time) override { meters_.on_motion(world, time); }
  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

  const InstrumentMeters<Dim>& meters() const { return meters_; }
  /// Appends `gates`, `regions` and `loads` to a summary.
  void add_to(nlohmann::ordered_json& summary) const;
  /// A line for each.
  std::vector<std::string> lines() const;

 private:
  void write_rows();

  InstrumentMeters<Dim> meters_;
  double dt_;  // [s]
  std::int64_t written_step_ = 0;
  GrowingCsv gates_csv_;
  GrowingCsv regions_csv_;
  GrowingCsv loads_csv_;
  GrowingCsv profiles_csv_;
};

}  // namespace talus
