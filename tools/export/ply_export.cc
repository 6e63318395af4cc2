#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/export/exporter.h"
#include "tools/export/output_file.h"
#include "tools/export/solid.h"
#include "tools/picture/body_colours.h"

namespace talus {
namespace {

template <int Dim>
class PlyExport final : public Exporter<Dim> {
 public:
  explicit PlyExport(const ExportInput<Dim>& input) : file_(input.file), frames_left_(input.frames) {
    for (const Shape<Dim>& shape : input.scene.world.shapes) {
      polygons_.push_back(polygons_in_space(shape));
      own_colours_.push_back(shape.colour);
    }
  }

  void add(const RecordedFrame<Dim>& frame) override {
    if (--frames_left_ > 0) return;  // only the last one is shown
    for (BodyIndex body = 0; body < frame.states.size(); ++body)
      if (frame.shows(body)) add_body(frame, body);
  }

  void finish() override {
    OutputFile out(file_);
    out.write(
        fmt::format("ply\nformat binary_little_endian 1.0\ncomment lengths in metres, z up\nelement vertex {}\n"
                    "property float x\nproperty float y\nproperty float z\n"
                    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                    "element face {}\nproperty list int int vertex_indices\nproperty int body\nproperty uchar asleep\n"
                    "end_header\n",
                    vertex_count_, face_count_));
    out.write(vertices_);
    out.write(faces_);
    out.close();
  }

 private:
  void add_body(const RecordedFrame<Dim>& frame, BodyIndex body) {
    const Pose<3> pose = in_space(frame.states.pose[body]);
    const bool asleep = frame.states.asleep[body] != 0;
    const int shape = frame.states.shape[body];
    const Colour colour = body_paint(colours_, shape, own_colours_[shape], asleep).fill;
    for (const Loop<3>& polygon : polygons_[frame.states.shape[body]]) {
      append_bytes(faces_, static_cast<std::int32_t>(polygon.size()));
      for (const Vec3& corner : polygon) {
        const Vec3 at = pose * corner;
        for (int axis = 0; axis < 3; ++axis) append_bytes(vertices_, static_cast<float>(at[axis]));
        for (const double part : {colour.red, colour.green, colour.blue})
          vertices_ += static_cast<char>(std::clamp(std::lround(255.0 * part), 0L, 255L));
        append_bytes(faces_, static_cast<std::int32_t>(vertex_count_++));
      }
      append_bytes(faces_, static_cast<std::int32_t>(body));
      faces_ += asleep ? '\1' : '\0';
      ++face_count_;
    }
  }

  std::filesystem::path file_;
  int frames_left_;
  PictureParams colours_;
  std::vector<std::string> own_colours_;        // of each shape
  std::vector<std::vector<Loop<3>>> polygons_;  // of each shape
  std::string vertices_;
  std::string faces_;
  std::int64_t vertex_count_ = 0;
  std::int64_t face_count_ = 0;
};

}  // namespace

template <int Dim>
std::unique_ptr<Exporter<Dim>> make_ply_export(const ExportInput<Dim>& input) {
  return std::make_unique<PlyExport<Dim>>(input);
}
template std::unique_ptr<Exporter<2>> make_ply_export(const ExportInput<2>&);
template std::unique_ptr<Exporter<3>> make_ply_export(const ExportInput<3>&);

}  // namespace talus
