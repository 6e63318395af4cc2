#include <fmt/format.h>

#include <iterator>

#include "tools/export/exporter.h"
#include "tools/export/output_file.h"

namespace talus {
namespace {

template <int Dim>
class CsvExport final : public Exporter<Dim> {
 public:
  explicit CsvExport(const ExportInput<Dim>& input) : out_(input.file) {
    out_.write(Dim == 2 ? "step,time_s,body,shape,asleep,cause,x_m,z_m,angle_rad\n"
                        : "step,time_s,body,shape,asleep,cause,x_m,y_m,z_m,qw,qx,qy,qz\n");
  }

  void add(const RecordedFrame<Dim>& frame) override {
    std::string rows;
    for (BodyIndex body = 0; body < frame.states.size(); ++body)
      if (frame.shows(body)) append_row(rows, frame, body);
    out_.write(rows);
  }

  void finish() override { out_.close(); }

 private:
  /// Poses with the digits of single precision, in which they are recorded.
  static void append_row(std::string& rows, const RecordedFrame<Dim>& frame, BodyIndex body) {
    const auto end = std::back_inserter(rows);
    const auto cause = frame.cause[body];
    fmt::format_to(end, "{},{:.6f},{},{},{},{}", frame.step, frame.time, body, frame.states.shape[body],
                   frame.states.asleep[body], cause < 0 ? "" : to_string(static_cast<SleepCause>(cause)));
    const auto append = [&](double value) { fmt::format_to(end, ",{}", static_cast<float>(value)); };
    const Pose<Dim>& pose = frame.states.pose[body];
    for (int axis = 0; axis < Dim; ++axis) append(pose.position[axis]);
    if constexpr (Dim == 2)
      append(pose.rotation.angle());
    else
      for (const double part : {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()})
        append(part);
    rows += '\n';
  }

  OutputFile out_;
};

}  // namespace

template <int Dim>
std::unique_ptr<Exporter<Dim>> make_csv_export(const ExportInput<Dim>& input) {
  return std::make_unique<CsvExport<Dim>>(input);
}
template std::unique_ptr<Exporter<2>> make_csv_export(const ExportInput<2>&);
template std::unique_ptr<Exporter<3>> make_csv_export(const ExportInput<3>&);

}  // namespace talus
