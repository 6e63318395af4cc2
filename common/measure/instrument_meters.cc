#include "common/measure/instrument_meters.h"

#include <cmath>
#include <limits>

#include "common/scene/typical_body.h"

namespace talus {

template <int Dim>
InstrumentMeters<Dim>::InstrumentMeters(const Scene<Dim>& scene)
    : instruments_(scene.instruments),
      dt_(scene.world.dt),
      steps_per_frame_(scene.steps_per_frame()),
      ground_(scene.world.ground.present ? scene.world.ground.height : -std::numeric_limits<double>::infinity()),
      readings_(instruments_.regions.size()) {
  const double extent = typical_body(scene).extent;
  for (const GateParams<Dim>& gate : instruments_.gates) gates_.emplace_back(gate, extent);
  for (const RegionParams<Dim>& region : instruments_.regions) regions_.emplace_back(region, extent);
  for (const LoadParams<Dim>& load : instruments_.loads) loads_.emplace_back(scene, load);
  if (!loads_.empty()) everything_.emplace(scene);
}

template <int Dim>
void InstrumentMeters<Dim>::on_motion(const World<Dim>& world, double time) {
  for (GateCounter<Dim>& gate : gates_) gate.update(world, time, dt_);
  for (LoadMeter<Dim>& load : loads_) load.update(world);
  if (everything_) everything_->update(world);
  if (std::llround(time / dt_) % steps_per_frame_ == 0) note_contacts(world);
}

template <int Dim>
void InstrumentMeters<Dim>::on_frame(const Frame<Dim>& frame) {
  if (frame.step % steps_per_frame_ == 0) read(frame);
}

template <int Dim>
void InstrumentMeters<Dim>::on_end(const Frame<Dim>& last, std::string_view /*reason*/) {
  if (last.step <= read_step_) return;
  note_contacts(last.world);
  read(last);
}

template <int Dim>
void InstrumentMeters<Dim>::note_contacts(const World<Dim>& world) {
  for (RegionMeter<Dim>& region : regions_) region.note_contacts(world);
}

template <int Dim>
void InstrumentMeters<Dim>::read(const Frame<Dim>& frame) {
  read_step_ = frame.step;
  for (std::size_t i = 0; i < regions_.size(); ++i) readings_[i] = regions_[i].read(frame.world, ground_);
  for (LoadMeter<Dim>& load : loads_) load.end_frame();
  if (everything_) weigh(frame.world);
}

template <int Dim>
void InstrumentMeters<Dim>::weigh(const World<Dim>& world) {
  everything_->end_frame();
  double mass = 0.0;
  for (BodyIndex body = 0; body < world.states().size(); ++body)
    if (world.states().removed[body] == 0) mass += world.shape_of(body).mass;
  const double weight = mass * world.gravity_size();
  carried_.reset();
  if (everything_->frame().known && weight > 0.0)
    carried_ = world.down().dot(everything_->frame().mean.template head<Dim>()) / weight;
}

template class InstrumentMeters<2>;
template class InstrumentMeters<3>;

}  // namespace talus
