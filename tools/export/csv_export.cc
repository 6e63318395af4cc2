#include <fmt/format.h>

#include <iterator>

#include "tools/export/exporter.h"
#include "tools/export/output_file.h"

namespace talus {
namespace {

class CsvExport final : public Exporter {
 public:
  explicit CsvExport(const ExportInput& input) : out_(input.file) {
    out_.write(input.dimension == 2 ? "step,time_s,body,shape,asleep,cause,x_m,z_m,angle_rad\n"
                                    : "step,time_s,body,shape,asleep,cause,x_m,y_m,z_m,qw,qx,qy,qz\n");
  }

  void add(const Moment& moment, std::span<const SleepEvent> /*events*/) override {
    std::string rows;
    for (BodyIndex body = 0; body < moment.bodies.size(); ++body)
      if (moment.bodies.shows(body)) append_row(rows, moment, body);
    out_.write(rows);
  }

  void finish(std::span<const SleepEvent> /*later_events*/) override { out_.close(); }

 private:
  /// Poses with the digits of single precision, in which they are recorded.
  static void append_row(std::string& rows, const Moment& moment, BodyIndex body) {
    const MomentBodies& bodies = moment.bodies;
    const auto end = std::back_inserter(rows);
    const auto cause = bodies.cause[body];
    fmt::format_to(end, "{},{:.6f},{},{},{},{}", moment.step, moment.time, body, bodies.shape[body],
                   bodies.asleep[body], cause < 0 ? "" : to_string(static_cast<SleepCause>(cause)));
    for (const float value : bodies.pose[body]) fmt::format_to(end, ",{}", value);
    rows += '\n';
  }

  OutputFile out_;
};

class ContactsCsvExport final : public Exporter {
 public:
  explicit ContactsCsvExport(const ExportInput& input) : plane_(input.dimension == 2), out_(input.file) {
    out_.write(plane_ ? "step,time_s,a,b,kept,x_m,z_m,normal_x_N,normal_z_N,friction_x_N,friction_z_N\n"
                      : "step,time_s,a,b,kept,x_m,y_m,z_m,normal_x_N,normal_y_N,normal_z_N,friction_x_N,friction_y_N,"
                        "friction_z_N\n");
  }

  void add(const Moment& moment, std::span<const SleepEvent> /*events*/) override {
    std::string rows;
    for (const ContactForce<3>& contact : moment.contacts) {
      fmt::format_to(std::back_inserter(rows), "{},{:.6f},{},{},{:d}", moment.step, moment.time, contact.a, contact.b,
                     contact.kept);
      for (const Vec3* vector : {&contact.point, &contact.normal_force, &contact.friction_force})
        append_vector(rows, *vector);
      rows += '\n';
    }
    out_.write(rows);
  }

  void finish(std::span<const SleepEvent> /*later_events*/) override { out_.close(); }

 private:
  void append_vector(std::string& rows, const Vec3& vector) const {
    for (int axis = 0; axis < 3; ++axis)
      if (!plane_ || axis != 1) fmt::format_to(std::back_inserter(rows), ",{}", static_cast<float>(vector[axis]));
  }

  bool plane_;
  OutputFile out_;
};

}  // namespace

std::unique_ptr<Exporter> make_csv_export(const ExportInput& input) { return std::make_unique<CsvExport>(input); }

std::unique_ptr<Exporter> make_contacts_csv_export(const ExportInput& input) {
  return std::make_unique<ContactsCsvExport>(input);
}

}  // namespace talus
