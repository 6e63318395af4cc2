#pragma once
// frames.csv of a run.

#include <filesystem>

#include "common/policy/observer.h"
#include "tools/output/csv.h"

namespace talus {

/// Writes frames.csv: one row a step. docs/files.md explains the columns. Each call throws std::system_error with the
/// file's name where it cannot be written.
template <int Dim>
class FramesCsv final : public Observer<Dim> {
 public:
  explicit FramesCsv(const std::filesystem::path& file);
  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

 private:
  GrowingCsv file_;
};

}  // namespace talus
