#include "common/simulation/sleeper_watch.h"

namespace talus {

template <int Dim>
void SleeperWatch<Dim>::on_start(const World<Dim>& world) {
  if (world.form() != form_) {
    form_ = world.form();
    passing_.emplace(world.shapes(), world.obstacles());
  }
  passing_->start_step(world);
}

template <int Dim>
void SleeperWatch<Dim>::on_motion(const World<Dim>& world, double /*time*/) {
  ++step_;
  for (const auto& [body, way] : passing_->end_step(world)) warnings_.note(WarningKind::passed, body, step_, way);
  if (overlap_ && overlap_->due(step_))
    for (const auto& [body, depth] : overlap_->sample(world, step_))
      warnings_.note(WarningKind::overlap, body, step_, depth);
}

template <int Dim>
void SleeperWatch<Dim>::on_frame(const Frame<Dim>& frame) {
  for (const BodyIndex body : frame.world.awake()) {
    const double farthest = frame.world.states().pose[body].position.cwiseAbs().maxCoeff();
    if (farthest > farthest_place()) warnings_.note(WarningKind::outside_world, body, step_, farthest);
  }
  if (const double extent = frame.piles.typical_body().extent; extent != extent_) {
    extent_ = extent;
    overlap_.emplace(extent, frame.world.gravity_size(), frame.world.dt(), step_);
  }
  while (reported_ < warnings_.all().size()) {
    const Warning& warning = warnings_.all()[reported_++];
    if (report_) report_(warning);
  }
}

template class SleeperWatch<2>;
template class SleeperWatch<3>;

}  // namespace talus
