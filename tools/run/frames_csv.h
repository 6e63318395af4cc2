#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "common/scene/scene.h"
#include "common/simulation/observer.h"

namespace talus {

/// Writes frames.csv: one row a step.
template <int Dim>
class FramesCsv final : public Observer<Dim> {
 public:
  FramesCsv(const std::filesystem::path& file, const Scene<Dim>& scene);
  void on_frame(const Frame<Dim>& frame) override;
  void on_end(const Frame<Dim>& last, std::string_view reason) override;

 private:
  std::ofstream out_;
  std::vector<Shape<Dim>> shapes_;
};

}  // namespace talus
