#pragma once
// Records in the formats of other programs.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/moment/moment.h"
#include "tools/export/solid.h"

namespace talus {

/// A shape of bodies.
struct ExportShape {
  std::string name;
  std::vector<Loop<3>> polygons;  // its surface in its own axes
};

/// What an exporter is told before the first moment.
struct ExportInput {
  int dimension = 3;
  std::vector<ExportShape> shapes;
  std::filesystem::path file;
  /// Moments, sleep events and contacts that will be added, and bodies of the last one.
  int frames = 0;
  std::int64_t events = 0;
  std::int64_t contacts = 0;
  BodyIndex bodies = 0;
};

/// Moments of a record on their way into a file, which is complete after finish(). Both throw std::runtime_error or
/// std::system_error where it cannot be written.
class Exporter {
 public:
  virtual ~Exporter() = default;
  /// `events` are those since the moment before.
  virtual void add(const Moment& moment, std::span<const SleepEvent> events) = 0;
  /// `later_events`: after the last moment.
  virtual void finish(std::span<const SleepEvent> later_events) = 0;
};

/// A row for each body and moment.
std::unique_ptr<Exporter> make_csv_export(const ExportInput& input);
/// A row for each contact point and moment.
std::unique_ptr<Exporter> make_contacts_csv_export(const ExportInput& input);
/// Arrays of NumPy, uncompressed; moments pass through, so memory is that of one.
std::unique_ptr<Exporter> make_npz_export(const ExportInput& input);
/// A series of point sets (FILE.pvd, and FILE_vtp beside it) with pose, shape, sleep and cause, and a mesh of each
/// shape.
std::unique_ptr<Exporter> make_vtp_export(const ExportInput& input);

}  // namespace talus
