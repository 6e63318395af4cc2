#include "lcmtypes/world_feed.h"

#include <talus/version.h>

#include <cmath>
#include <functional>
#include <utility>

#include "common/math/in_space.h"
#include "common/math/require.h"
#include "common/text/printable.h"

namespace talus {
namespace {

WorldLabel checked(const WorldLabel& label) {
  require(std::isfinite(label.dt) && label.dt > 0.0, "dt", label.dt, "must be finite and above 0");
  require(std::isfinite(label.frame_rate) && label.frame_rate > 0.0, "frame_rate", label.frame_rate,
          "must be finite and above 0");
  for (const auto& [field, text] : {std::pair("name", &label.name), {"title", &label.title}, {"engine", &label.engine}})
    require(text->find('\0') == std::string::npos, field, printable(*text), "must have no character 0");
  return label;
}

template <int Dim>
RunInfo info_of(const WorldLabel& label, const Frame<Dim>& frame) {
  RunInfo info = {.scene = label.name,
                  .title = label.title.empty() ? label.name : label.title,
                  .backend = label.engine,
                  .policy = "adaptive",
                  .version = TALUS_VERSION,
                  .dimension = Dim,
                  .dt = label.dt,
                  .gravity = in_space(frame.world.gravity())};
  info.ground.present = false;
  info.solver.kind = engine_solver;
  return info;
}

/// Is made by the first frame, which has what the label has not.
template <int Dim>
class WorldFeed final : public Observer<Dim> {
 public:
  using Make = std::function<std::unique_ptr<Observer<Dim>>(const Frame<Dim>&)>;
  explicit WorldFeed(Make make) : make_(std::move(make)) {}

  void on_frame(const Frame<Dim>& frame) override {
    if (!made_) made_ = make_(frame);
    made_->on_frame(frame);
  }
  void on_end(const Frame<Dim>& last, std::string_view reason) override {
    if (made_) made_->on_end(last, reason);
  }

 private:
  Make make_;
  std::unique_ptr<Observer<Dim>> made_;
};

}  // namespace

template <int Dim>
std::unique_ptr<Observer<Dim>> record_world(const std::string& path, const WorldLabel& label,
                                            const RecorderParams& params) {
  return std::make_unique<WorldFeed<Dim>>([path, label = checked(label), params](const Frame<Dim>& frame) {
    return std::make_unique<RunRecorder<Dim>>(path, info_of(label, frame), label.frame_rate, params);
  });
}

template <int Dim>
std::unique_ptr<Observer<Dim>> publish_world(const WorldLabel& label, const PublisherParams& params) {
  return std::make_unique<WorldFeed<Dim>>([label = checked(label), params](const Frame<Dim>& frame) {
    return std::make_unique<Publisher<Dim>>(info_of(label, frame), params);
  });
}

template std::unique_ptr<Observer<2>> record_world<2>(const std::string&, const WorldLabel&, const RecorderParams&);
template std::unique_ptr<Observer<3>> record_world<3>(const std::string&, const WorldLabel&, const RecorderParams&);
template std::unique_ptr<Observer<2>> publish_world<2>(const WorldLabel&, const PublisherParams&);
template std::unique_ptr<Observer<3>> publish_world<3>(const WorldLabel&, const PublisherParams&);

}  // namespace talus
