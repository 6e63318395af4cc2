#include "tools/record/run_history.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

#include "common/measure/pile_form.h"
#include "common/scene/typical_body.h"
#include "tools/record/recorded_run.h"

namespace talus {
namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;
constexpr double at_rest = 1.0;            // [m/s] a body that is slower is part of the pile, as in summary.json
constexpr std::int64_t most_slopes = 150;  // a fit costs some milliseconds
constexpr int fewest_of_a_fit = 20;        // bodies; a slope of fewer says nothing

template <int Dim>
class HistoryReader {
 public:
  explicit HistoryReader(const Scene<Dim>& scene)
      : scene_(scene),
        extent_(typical_body(scene).extent),
        frames_between_slopes_(std::max<std::int64_t>(1, scene.run.frames / most_slopes)) {}

  RunHistory read(const std::filesystem::path& folder) {
    LogReader log((folder / "run.lcm").string());
    history_.walk = walk_record<Dim>(scene_, log, [this](const RecordedFrame<Dim>& frame) { take(frame); });
    if (history_.time.empty()) throw no_frame(folder, history_.walk.damage.bytes);
    return history_;
  }

 private:
  void take(const RecordedFrame<Dim>& frame) {
    history_.time.push_back(frame.time);
    double asleep = 0.0;
    double present = 0.0;
    for (BodyIndex body = 0; body < frame.states.size(); ++body) {
      if (frame.states.removed[body] != 0) continue;
      ++present;
      asleep += frame.states.asleep[body];
    }
    history_.awake.push_back(present - asleep);
    history_.asleep.push_back(asleep);
    const auto woken = std::ranges::count_if(frame.events, &SleepEvent::woke);
    history_.woken.push_back(static_cast<double>(woken));
    history_.slept.push_back(static_cast<double>(std::ssize(frame.events) - woken));
    history_.drift_estimate.push_back(frame.drift_estimate >= 0.0 ? frame.drift_estimate
                                                                  : std::numeric_limits<double>::quiet_NaN());
    history_.warnings.assign(frame.warnings.begin(), frame.warnings.end());
    take_pile(frame);
    remember(frame);
  }

  void take_pile(const RecordedFrame<Dim>& frame) {
    PileMoment& moment = history_.pile.emplace_back();
    const auto largest = std::ranges::max_element(frame.piles, {}, &Pile<Dim>::structure_size);
    if (largest == frame.piles.end()) return;
    moment.alpha = degrees_per_radian * largest->alpha;
    for (const Layer& layer : largest->layers) moment.densities.push_back(layer.density());
    if (std::ssize(history_.time) % frames_between_slopes_ == 0)
      take_slope(frame, static_cast<int>(largest - frame.piles.begin()));
  }

  void take_slope(const RecordedFrame<Dim>& frame, int pile) {
    BodyStates<Dim> lying = frame.states;
    for (BodyIndex body = 0; body < lying.size(); ++body) {
      const bool moves = body >= std::ssize(before_) ||
                         (lying.pose[body].position - before_[body]).norm() > at_rest * (frame.time - time_before_);
      const bool of_pile = nearest_pile<Dim>(frame.piles, lying.pose[body].position) == pile;
      if (moves || !of_pile || frame.unknown[body] != 0) lying.removed[body] = 1;
    }
    const auto bodies = placed_bodies<Dim>(scene_.world.shapes, lying);
    if (std::ssize(bodies) < fewest_of_a_fit) return;
    const ProfileGrid<Dim> grid = grid_around<Dim>(bodies, scene_.world.ground.height, extent_);
    const auto slope = pile_form<Dim>(bodies, shape_statistics<Dim>(bodies, grid), grid,
                                      world_at<Dim>(scene_, {}, frame.time), extent_)
                           .slope;
    if (slope.value)
      history_.slopes.push_back(
          {frame.time, degrees_per_radian * slope.value->angle, degrees_per_radian * slope.value->standard_error});
  }

  void remember(const RecordedFrame<Dim>& frame) {
    before_.resize(frame.states.size());
    for (BodyIndex body = 0; body < frame.states.size(); ++body) before_[body] = frame.states.pose[body].position;
    time_before_ = frame.time;
  }

  const Scene<Dim>& scene_;
  double extent_;  // D [m]
  std::int64_t frames_between_slopes_;
  std::vector<Vec<Dim>> before_;  // positions at the frame before
  double time_before_ = 0.0;
  RunHistory history_;
};

}  // namespace

template <int Dim>
RunHistory history_of(const Scene<Dim>& scene, const std::filesystem::path& folder) {
  return HistoryReader<Dim>(scene).read(folder);
}

std::map<std::string, std::vector<double>> columns_of(const std::filesystem::path& csv) {
  std::ifstream in(csv);
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::string line;
  std::map<std::string, std::vector<double>> columns;
  if (!std::getline(in, line)) return columns;
  const std::vector<std::string> names = cells_of(line);
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != names.size()) continue;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      char* end = nullptr;
      const double value = std::strtod(cells[i].c_str(), &end);
      columns[names[i]].push_back(end == cells[i].c_str() ? std::numeric_limits<double>::quiet_NaN() : value);
    }
  }
  return columns;
}

template RunHistory history_of(const Scene<2>&, const std::filesystem::path&);
template RunHistory history_of(const Scene<3>&, const std::filesystem::path&);

}  // namespace talus
