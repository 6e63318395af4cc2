#include <fmt/format.h>

#include "common/math/pose_values.h"
#include "common/text/base64.h"
#include "common/text/file.h"
#include "tools/export/exporter.h"
#include "tools/export/output_file.h"
#include "tools/export/solid.h"

namespace talus {
namespace {

/// An array of VTK's XML: its length in bytes, then the bytes.
std::string data_array(std::string_view type, std::string_view name, int components, std::string_view bytes) {
  std::string block;
  append_bytes(block, static_cast<std::uint64_t>(bytes.size()));
  block += bytes;
  return fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="binary">{}</DataArray>)"
                     "\n",
                     type, name, components, base64(block));
}

std::string vtk_file(std::string_view piece) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n{}</PolyData>\n</VTKFile>\n",
      piece);
}

void append_point(std::string& bytes, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis) append_bytes(bytes, static_cast<float>(point[axis]));
}

/// The cells of a piece: which points each has.
std::string cells(std::string_view name, const std::string& connectivity, const std::string& offsets) {
  return fmt::format("<{}>\n{}{}</{}>\n", name, data_array("Int64", "connectivity", 1, connectivity),
                     data_array("Int64", "offsets", 1, offsets), name);
}

std::string mesh_file(const std::vector<Loop<3>>& polygons) {
  std::string points;
  std::string connectivity;
  std::string offsets;
  std::int64_t count = 0;
  for (const Loop<3>& polygon : polygons) {
    for (const Vec3& corner : polygon) {
      append_point(points, corner);
      append_bytes(connectivity, count++);
    }
    append_bytes(offsets, count);
  }
  return vtk_file(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n<Points>\n{}</Points>\n{}</Piece>\n",
                              count, polygons.size(), data_array("Float32", "Points", 3, points),
                              cells("Polys", connectivity, offsets)));
}

/// The data of the points of one frame.
struct PointArrays {
  std::string points, orientation, body, shape, asleep, cause, connectivity, offsets;
  std::int64_t count = 0;

  std::string file() const {
    return vtk_file(
        fmt::format("<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\">\n<PointData>\n{1}{2}{3}{4}{5}</PointData>\n"
                    "<Points>\n{6}</Points>\n{7}</Piece>\n",
                    count, data_array("Float32", "orientation", 4, orientation), data_array("Int32", "body", 1, body),
                    data_array("Int32", "shape", 1, shape), data_array("UInt8", "asleep", 1, asleep),
                    data_array("Int8", "cause", 1, cause), data_array("Float32", "Points", 3, points),
                    cells("Verts", connectivity, offsets)));
  }
};

void write_whole(const std::filesystem::path& path, const std::string& text) {
  OutputFile out(path);
  out.write(text);
  out.close();
}

std::string frame_name(int frame) { return fmt::format("frame_{:06}.vtp", frame); }
std::string shape_name(std::size_t shape) { return fmt::format("shape_{}.vtp", shape); }

/// A new folder for files on their way into `folder`, which goes with this object.
class UnfinishedFolder {
 public:
  explicit UnfinishedFolder(const std::filesystem::path& folder) : path_(unfinished_name(folder)) {
    std::filesystem::create_directory(path_);
  }
  ~UnfinishedFolder() {
    std::error_code left_there;
    std::filesystem::remove_all(path_, left_there);
  }
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Where the sets of points of a series lie: a.pvd has them in a_vtp.
std::filesystem::path folder_of(std::filesystem::path file) {
  file.replace_extension();
  return file += "_vtp";
}

class VtpExport final : public Exporter {
 public:
  explicit VtpExport(const ExportInput& input)
      : file_(input.file), folder_(folder_of(input.file)), unfinished_(folder_), shapes_(input.shapes.size()) {
    for (std::size_t i = 0; i < shapes_; ++i)
      write_whole(unfinished_.path() / shape_name(i), mesh_file(input.shapes[i].polygons));
  }

  void add(const Moment& moment, std::span<const SleepEvent> /*events*/) override {
    PointArrays arrays;
    for (BodyIndex body = 0; body < moment.bodies.size(); ++body)
      if (moment.bodies.shows(body)) add_body(arrays, moment.bodies, body);
    const std::string name = frame_name(frames_++);
    write_whole(unfinished_.path() / name, arrays.file());
    series_ += fmt::format("<DataSet timestep=\"{:.6f}\" file=\"{}/{}\"/>\n", moment.time,
                           xml_text(folder_.filename().string()), name);
  }

  void finish(std::span<const SleepEvent> /*later_events*/) override {
    UnfinishedFile series(file_);
    write_whole(series.path(), fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n"
                                           "<Collection>\n{}</Collection>\n</VTKFile>\n",
                                           series_));
    std::filesystem::create_directory(folder_);
    for (const auto& entry : std::filesystem::directory_iterator(unfinished_.path()))
      std::filesystem::rename(entry.path(), folder_ / entry.path().filename());
    // What a longer series had more, or one with more shapes.
    for (int frame = frames_; std::filesystem::remove(folder_ / frame_name(frame)); ++frame) {
    }
    for (std::size_t shape = shapes_; std::filesystem::remove(folder_ / shape_name(shape)); ++shape) {
    }
    series.finish();
  }

 private:
  static std::string xml_text(const std::string& text) {
    std::string escaped;
    for (const char letter : text)
      if (letter == '&')
        escaped += "&amp;";
      else if (letter == '"')
        escaped += "&quot;";
      else if (letter == '<')
        escaped += "&lt;";
      else
        escaped += letter;
    return escaped;
  }

  static void add_body(PointArrays& arrays, const MomentBodies& bodies, BodyIndex body) {
    const Pose<3> pose = bodies.pose.in_space(body);
    append_point(arrays.points, pose.position);
    for (const double part : quaternion_values(pose.rotation))
      append_bytes(arrays.orientation, static_cast<float>(part));
    append_bytes(arrays.body, static_cast<std::int32_t>(body));
    append_bytes(arrays.shape, static_cast<std::int32_t>(bodies.shape[body]));
    append_bytes(arrays.asleep, bodies.asleep[body]);
    append_bytes(arrays.cause, bodies.cause[body]);
    append_bytes(arrays.connectivity, arrays.count++);
    append_bytes(arrays.offsets, arrays.count);
  }

  std::filesystem::path file_;
  std::filesystem::path folder_;
  UnfinishedFolder unfinished_;
  std::size_t shapes_;
  std::string series_;
  int frames_ = 0;
};

}  // namespace

std::unique_ptr<Exporter> make_vtp_export(const ExportInput& input) { return std::make_unique<VtpExport>(input); }

}  // namespace talus
