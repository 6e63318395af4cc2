#include "tools/bench/measure.h"

#include <fmt/format.h>

#include <cmath>

namespace talus {

std::vector<MeasureId> MeasureId::all() {
  std::vector<MeasureId> ids;
  for (std::size_t i = 0; i < measures.size(); ++i) ids.push_back(MeasureId(i));
  return ids;
}

std::vector<MeasureId> Values::measured() const {
  std::vector<MeasureId> ids = MeasureId::all();
  std::erase_if(ids, [&](MeasureId id) { return !std::isfinite((*this)[id]); });
  return ids;
}

std::string shown(double value, int digits) {
  if (std::isinf(value)) return "∞";
  if (std::isnan(value)) return "-";
  const double size = std::abs(value);
  if (size >= 1e3 && size < 1e6) return fmt::format("{:.0f}", value);
  return fmt::format("{:.{}g}", value, digits);
}

std::string shown(const Values& values, MeasureId id) { return shown(values[id], id.info().digits); }

std::string shown_with_range(const Values& values, MeasureId id) {
  const MeasureId low = id.with("_min");
  const MeasureId high = id.with("_max");
  if (std::isnan(values[id]) || values[low] == values[high]) return shown(values, id);
  return fmt::format("{} ({}-{})", shown(values, id), shown(values, low), shown(values, high));
}

std::string shown_with_deviation(const Values& values, MeasureId id) {
  if (std::isnan(values[id])) return "-";
  return fmt::format("{} ± {}", shown(values, id), shown(values, id.with("_sd")));
}

std::string shown_with_floor(const Values& values, MeasureId id) {
  return fmt::format("{} / {}", shown(values, id), shown(values, id.with("_floor")));
}

}  // namespace talus
