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

  void finish() override { out_.close(); }

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

}  // namespace

std::unique_ptr<Exporter> make_csv_export(const ExportInput& input) { return std::make_unique<CsvExport>(input); }

}  // namespace talus
