#pragma once

#include <filesystem>
#include <fstream>

#include "common/simulation/observer.h"

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
  void require_written() const;

  std::filesystem::path file_;
  std::ofstream out_;
};

}  // namespace talus
