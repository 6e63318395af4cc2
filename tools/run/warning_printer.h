#pragma once

#include "common/simulation/observer.h"

namespace talus {

/// Writes each kind of warning to standard error, one line each, as soon as the run shows it.
template <int Dim>
class WarningPrinter final : public Observer<Dim> {
 public:
  void on_frame(const Frame<Dim>& frame) override { print(frame); }
  void on_end(const Frame<Dim>& last, std::string_view) override { print(last); }

 private:
  void print(const Frame<Dim>& frame);

  std::size_t printed_ = 0;
};

}  // namespace talus
