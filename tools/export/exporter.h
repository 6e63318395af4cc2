#pragma once
// Records in the formats of other programs.

#include <filesystem>
#include <memory>

#include "common/scene/scene.h"
#include "tools/record/record_walk.h"

namespace talus {

/// What an exporter is told before the first frame.
template <int Dim>
struct ExportInput {
  const Scene<Dim>& scene;
  std::filesystem::path file;
  /// Frames and sleep events that will be added, and bodies of the last one.
  int frames = 0;
  std::int64_t events = 0;
  BodyIndex bodies = 0;
};

/// Frames of a record on their way into a file, which is complete after finish(). Both throw std::runtime_error or
/// std::system_error where it cannot be written.
template <int Dim>
class Exporter {
 public:
  virtual ~Exporter() = default;
  virtual void add(const RecordedFrame<Dim>& frame) = 0;
  virtual void finish() = 0;
};

/// A row for each body and frame.
template <int Dim>
std::unique_ptr<Exporter<Dim>> make_csv_export(const ExportInput<Dim>& input);
/// Arrays of NumPy, uncompressed; frames pass through, so memory is that of one state.
template <int Dim>
std::unique_ptr<Exporter<Dim>> make_npz_export(const ExportInput<Dim>& input);
/// A series of point sets (FILE.pvd, and FILE_vtp beside it) with pose, shape, sleep and cause, and a mesh of each
/// shape.
template <int Dim>
std::unique_ptr<Exporter<Dim>> make_vtp_export(const ExportInput<Dim>& input);

}  // namespace talus
