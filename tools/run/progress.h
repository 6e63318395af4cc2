#pragma once

#include "common/policy/observer.h"
#include "common/world/stopwatch.h"

namespace talus {

/// Prints the progress of a run on standard error: one line that is written over on a terminal, a plain line now and
/// then elsewhere.
template <int Dim>
class Progress final : public Observer<Dim> {
 public:
  explicit Progress(std::int64_t steps);
  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

 private:
  void write(const Frame<Dim>& frame);

  std::int64_t steps_;
  bool terminal_;
  double interval_;  // [s] between lines
  double since_line_ = 0.0;
  double elapsed_ = 0.0;
  std::int64_t line_step_ = 0;
  Stopwatch watch_;
};

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
