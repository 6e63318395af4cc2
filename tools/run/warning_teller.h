#pragma once

#include "common/simulation/observer.h"

namespace talus {

/// Writes each kind of warning to standard error, one line each, as soon as the run shows it.
template <int Dim>
class WarningTeller final : public Observer<Dim> {
 public:
  void on_frame(const Frame<Dim>& frame) override { tell(frame); }
  void on_end(const Frame<Dim>& last, std::string_view) override { tell(last); }

 private:
  void tell(const Frame<Dim>& frame);

  std::size_t told_ = 0;
};

}  // namespace talus
