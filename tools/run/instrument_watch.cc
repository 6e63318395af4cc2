#include "tools/run/instrument_watch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/math/angle.h"
#include "common/text/printable.h"
#include "tools/run/json_null.h"
#include "tools/run/run_files.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

template <int Dim>
Json numbers(const Eigen::Matrix<double, Dim, 1>& vector) {
  return std::vector<double>(vector.begin(), vector.end());
}

constexpr int torques_of(int dim) { return dim == 2 ? 1 : 3; }

/// Null where the span is not known or has no steps.
template <int Dim>
Json wrench_json(const Wrench<Dim>& wrench, const LoadSpan<Dim>& span) {
  if (!span.known || span.steps == 0) return nullptr;
  constexpr int torques = torques_of(Dim);
  return {{"force_N", numbers<Dim>(wrench.template head<Dim>())},
          {"torque_Nm", numbers<torques>(wrench.template tail<torques>())}};
}

template <int Dim>
Json gate_json(const std::string& name, const GateCounter<Dim>& gate) {
  Json jams = Json::array();
  for (const auto& jam : gate.jams()) jams.push_back({{"from_s", jam.from}, {"to_s", or_null(jam.to)}});
  return {{"name", name},
          {"forward", gate.forward()},
          {"backward", gate.backward()},
          {"net", gate.net()},
          {"rate_per_s", or_null(gate.rate())},
          {"first_s", or_null(gate.first())},
          {"last_s", or_null(gate.last())},
          {"jammed", gate.jammed()},
          {"jams", jams}};
}

std::optional<double> degrees(const Applicable<SurfacePlane>& surface, double SurfacePlane::*angle) {
  if (!surface.value) return std::nullopt;
  return in_degrees((*surface.value).*angle);
}

Json region_json(const std::string& name, const RegionReading& reading) {
  return {{"name", name},
          {"bodies", reading.bodies},
          {"packing", or_null(reading.packing)},
          {"packing_reason", or_null(reading.packing_reason)},
          {"solid_volume", reading.solid_volume},
          {"mean_speed_m_per_s", reading.mean_speed},
          {"kinetic_energy_J", reading.kinetic_energy},
          {"slope_deg", or_null(degrees(reading.surface, &SurfacePlane::angle))},
          {"slope_standard_error_deg", or_null(degrees(reading.surface, &SurfacePlane::standard_error))},
          {"slope_reason", or_null(reading.surface.why_not)}};
}

template <int Dim>
Json profile_json(const std::vector<double>& heights, const LoadMeter<Dim>& load) {
  Json slices = Json::array();
  for (std::size_t i = 0; i < load.profile().size(); ++i)
    slices.push_back({{"from_m", heights[i]}, {"to_m", heights[i + 1]}, {"force_N", numbers<Dim>(load.profile()[i])}});
  return slices;
}

template <int Dim>
Json load_json(const LoadParams<Dim>& params, const LoadMeter<Dim>& load) {
  return {{"name", params.name},
          {"mean", wrench_json<Dim>(load.whole().mean, load.whole())},
          {"least", wrench_json<Dim>(load.whole().least, load.whole())},
          {"most", wrench_json<Dim>(load.whole().most, load.whole())},
          {"at_end", wrench_json<Dim>(load.frame().mean, load.frame())},
          {"profile", profile_json(params.heights, load)},
          {"reason", or_null(load.reason())}};
}

template <int Dim>
std::string gate_line(const std::string& name, const GateCounter<Dim>& gate) {
  std::string line =
      fmt::format("gate {}: {} passed forward, {} backward", printable(name), gate.forward(), gate.backward());
  if (gate.first()) line += fmt::format(", from {:.4g} to {:.4g} s", *gate.first(), *gate.last());
  if (gate.rate()) line += fmt::format(", {:.4g} a second", *gate.rate());
  if (gate.jammed()) line += fmt::format("; jammed since {:.4g} s", gate.jams().back().from);
  const auto ended = std::ssize(gate.jams()) - (gate.jammed() ? 1 : 0);
  if (ended > 0) line += fmt::format("; {} jams that ended", ended);
  return line;
}

template <int Dim>
std::string region_line(const std::string& name, const RegionReading& reading) {
  const std::string packing =
      reading.packing ? fmt::format("packing {:.4g}", *reading.packing) : "no packing: " + reading.packing_reason;
  const std::optional<double> angle = degrees(reading.surface, &SurfacePlane::angle);
  const std::string slope =
      angle ? fmt::format("slope {:.3g} degrees", *angle) : "no slope: " + reading.surface.why_not;
  return fmt::format("region {}: {} bodies, {}, {}, mean speed {:.3g} m/s, kinetic energy {:.3g} J", printable(name),
                     reading.bodies, packing, slope, reading.mean_speed, reading.kinetic_energy);
}

template <int Dim>
std::string load_line(const std::string& name, const LoadMeter<Dim>& load) {
  const auto force = [](const LoadSpan<Dim>& span) {
    if (!span.known || span.steps == 0) return std::string("not known");
    return fmt::format("[{:.4g}] N", fmt::join(span.mean.data(), span.mean.data() + Dim, ", "));
  };
  std::string line =
      fmt::format("load {}: {} at the end, {} in the mean", printable(name), force(load.frame()), force(load.whole()));
  if (!load.reason().empty()) line += " (" + load.reason() + ")";
  return line;
}

template <int Dim>
std::vector<std::string> profile_columns() {
  if constexpr (Dim == 2)
    return {"step", "time_s", "load", "from_m", "to_m", "force_x_N", "force_z_N"};
  else
    return {"step", "time_s", "load", "from_m", "to_m", "force_x_N", "force_y_N", "force_z_N"};
}

template <int Dim>
std::vector<std::string> load_columns() {
  if constexpr (Dim == 2)
    return {"step", "time_s", "load", "force_x_N", "force_z_N", "torque_Nm"};
  else
    return {"step",      "time_s",      "load",        "force_x_N",  "force_y_N",
            "force_z_N", "torque_x_Nm", "torque_y_Nm", "torque_z_Nm"};
}

}  // namespace

template <int Dim>
InstrumentWatch<Dim>::InstrumentWatch(const Scene<Dim>& scene, const std::filesystem::path& folder)
    : meters_(scene), dt_(scene.world.dt) {
  const Instruments<Dim>& instruments = scene.instruments;
  if (!instruments.gates.empty())
    gates_csv_ = GrowingCsv(folder / run_files::gates, {"step", "time_s", "gate", "forward", "backward", "jammed"});
  if (!instruments.regions.empty())
    regions_csv_ =
        GrowingCsv(folder / run_files::regions, {"step", "time_s", "region", "bodies", "packing", "solid_volume",
                                                 "mean_speed_m_per_s", "kinetic_energy_J", "slope_deg"});
  if (std::ranges::any_of(instruments.loads, [](const LoadParams<Dim>& load) { return !load.heights.empty(); }))
    profiles_csv_ = GrowingCsv(folder / run_files::profiles, profile_columns<Dim>());
  if (!instruments.loads.empty()) loads_csv_ = GrowingCsv(folder / run_files::loads, load_columns<Dim>());
}

template <int Dim>
void InstrumentWatch<Dim>::on_frame(const Frame<Dim>& frame) {
  meters_.on_frame(frame);
  if (meters_.read_step() > written_step_) write_rows();
}

template <int Dim>
void InstrumentWatch<Dim>::on_end(const Frame<Dim>& last, std::string_view reason) {
  meters_.on_end(last, reason);
  if (meters_.read_step() > written_step_) write_rows();
  for (GrowingCsv* file : {&gates_csv_, &regions_csv_, &loads_csv_, &profiles_csv_}) file->flush();
}

template <int Dim>
void InstrumentWatch<Dim>::write_rows() {
  written_step_ = meters_.read_step();
  const Instruments<Dim>& instruments = meters_.instruments();
  const auto row = [&](const std::string& name) {
    return std::vector<std::string>{fmt::format("{}", written_step_),
                                    fmt::format("{:.6f}", static_cast<double>(written_step_) * dt_), name};
  };
  const auto add = [](std::vector<std::string>& cells, std::optional<double> value) {
    cells.push_back(value ? fmt::format("{:.6g}", *value) : "");
  };
  for (std::size_t i = 0; i < instruments.gates.size(); ++i) {
    const GateCounter<Dim>& gate = meters_.gates()[i];
    std::vector<std::string> cells = row(instruments.gates[i].name);
    for (const std::int64_t count : {gate.forward(), gate.backward(), std::int64_t{gate.jammed()}})
      cells.push_back(fmt::format("{}", count));
    gates_csv_.add(cells);
  }
  for (std::size_t i = 0; i < instruments.regions.size(); ++i) {
    const RegionReading& reading = meters_.regions()[i];
    std::vector<std::string> cells = row(instruments.regions[i].name);
    cells.push_back(fmt::format("{}", reading.bodies));
    add(cells, reading.packing);
    for (const double value : {reading.solid_volume, reading.mean_speed, reading.kinetic_energy}) add(cells, value);
    add(cells, degrees(reading.surface, &SurfacePlane::angle));
    regions_csv_.add(cells);
  }
  for (std::size_t i = 0; i < instruments.loads.size(); ++i) {
    const LoadSpan<Dim>& span = meters_.loads()[i].frame();
    std::vector<std::string> cells = row(instruments.loads[i].name);
    for (const double value : span.mean) cells.push_back(span.known ? fmt::format("{:.6g}", value) : "");
    loads_csv_.add(cells);
    const std::vector<double>& heights = instruments.loads[i].heights;
    for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
      std::vector<std::string> slice = row(instruments.loads[i].name);
      for (const double value : {heights[k], heights[k + 1]}) add(slice, value);
      for (const double value : meters_.loads()[i].profile()[k])
        slice.push_back(span.known ? fmt::format("{:.6g}", value) : "");
      profiles_csv_.add(slice);
    }
  }
}

template <int Dim>
void InstrumentWatch<Dim>::add_to(nlohmann::ordered_json& summary) const {
  const Instruments<Dim>& instruments = meters_.instruments();
  summary["gates"] = Json::array();
  for (std::size_t i = 0; i < instruments.gates.size(); ++i)
    summary["gates"].push_back(gate_json(instruments.gates[i].name, meters_.gates()[i]));
  summary["regions"] = Json::array();
  for (std::size_t i = 0; i < instruments.regions.size(); ++i)
    summary["regions"].push_back(region_json(instruments.regions[i].name, meters_.regions()[i]));
  summary["loads"] = Json::array();
  for (std::size_t i = 0; i < instruments.loads.size(); ++i)
    summary["loads"].push_back(load_json(instruments.loads[i], meters_.loads()[i]));
  summary["carried_weight"] = or_null(meters_.carried());
}

template <int Dim>
std::vector<std::string> InstrumentWatch<Dim>::lines() const {
  const Instruments<Dim>& instruments = meters_.instruments();
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < instruments.gates.size(); ++i)
    lines.push_back(gate_line(instruments.gates[i].name, meters_.gates()[i]));
  for (std::size_t i = 0; i < instruments.regions.size(); ++i)
    lines.push_back(region_line<Dim>(instruments.regions[i].name, meters_.regions()[i]));
  for (std::size_t i = 0; i < instruments.loads.size(); ++i)
    lines.push_back(load_line(instruments.loads[i].name, meters_.loads()[i]));
  if (meters_.carried())
    lines.push_back(
        fmt::format("ground and obstacles carry {:.4g} % of the weight of all bodies", 100.0 * *meters_.carried()));
  return lines;
}

template class InstrumentWatch<2>;
template class InstrumentWatch<3>;

}  // namespace talus
