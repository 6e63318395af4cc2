#pragma once

#include <filesystem>
#include <fstream>

#include "common/simulation/observer.h"

namespace talus {

/// Writes frames.csv: one row a step. docs/files.md explains the columns.
template <int Dim>
class FramesCsv final : public Observer<Dim> {
 public:
  /// Throws std::runtime_error if the file cannot be written.
  explicit FramesCsv(const std::filesystem::path& file);
  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

 private:
  std::ofstream out_;
};

}  // namespace talus
