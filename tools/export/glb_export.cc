#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "tools/export/exporter.h"
#include "tools/export/output_file.h"
#include "tools/export/solid.h"
#include "tools/picture/body_colours.h"
#include "tools/report/json_text.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the glTF 2.0 specification.
constexpr int gl_float = 5126;
constexpr int gl_unsigned_int = 5125;
enum View { vertex_view, index_view, animation_view, view_count };

/// Poses of a body at the times at which its motion begins, goes on and ends; between them it moves evenly.
struct Track {
  int shape = 0;
  double from = 0.0;            // [s] when it appears
  std::optional<double> until;  // [s] when it is gone
  std::vector<double> times;
  std::vector<Pose<3>> poses;
  double seen = 0.0;  // [s] when it was last known to be at its last pose

  void add(double time, Pose<3> pose) {
    if (!poses.empty() && poses.back().rotation.dot(pose.rotation) < 0.0) pose.rotation.coeffs() *= -1.0;
    times.push_back(time);
    poses.push_back(pose);
  }
};

bool same_pose(const Pose<3>& a, const Pose<3>& b) {
  return a.position == b.position &&
         (a.rotation.coeffs() == b.rotation.coeffs() || a.rotation.coeffs() == -b.rotation.coeffs());
}

/// The file's buffer in its three parts, and what refers to it.
class GlbWriter {
 public:
  GlbWriter() { accessors_ = Json::array(); }

  int add_vectors(View view, std::string_view type, const std::vector<float>& values, bool with_range) {
    const int components = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4;
    Json accessor = accessor_of(view, gl_float, type, values.size() / components);
    if (with_range) {
      for (int k = 0; k < components; ++k) {
        float low = values[k];
        float high = values[k];
        for (std::size_t i = k; i < values.size(); i += components) {
          low = std::min(low, values[i]);
          high = std::max(high, values[i]);
        }
        accessor["min"].push_back(low);
        accessor["max"].push_back(high);
      }
    }
    for (const float value : values) append_bytes(parts_[view], value);
    return add(std::move(accessor));
  }

  int add_indices(const std::vector<int>& indices) {
    Json accessor = accessor_of(index_view, gl_unsigned_int, "SCALAR", indices.size());
    for (const int index : indices) append_bytes(parts_[index_view], static_cast<std::uint32_t>(index));
    return add(std::move(accessor));
  }

  /// Completes `document` and writes it with the buffer.
  void write(const std::filesystem::path& file, Json document) {
    constexpr std::array<int, view_count> targets = {34962, 34963, 0};
    std::string buffer;
    std::array<int, view_count> number{};
    document["bufferViews"] = Json::array();
    for (int view = 0; view < view_count; ++view) {
      number[view] = static_cast<int>(document["bufferViews"].size());
      if (parts_[view].empty()) continue;
      Json json = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", parts_[view].size()}};
      if (view == vertex_view) json["byteStride"] = 12;
      if (targets[view] != 0) json["target"] = targets[view];
      document["bufferViews"].push_back(json);
      buffer += parts_[view];
    }
    for (Json& accessor : accessors_) accessor["bufferView"] = number[accessor["bufferView"].get<int>()];
    document["accessors"] = accessors_;
    document["buffers"] = {{{"byteLength", buffer.size()}}};
    write_chunks(file, json_text(document, -1), buffer);
  }

 private:
  Json accessor_of(View view, int component, std::string_view type, std::size_t count) {
    return {{"bufferView", view},
            {"byteOffset", parts_[view].size()},
            {"componentType", component},
            {"count", count},
            {"type", type}};
  }

  int add(Json accessor) {
    accessors_.push_back(std::move(accessor));
    return static_cast<int>(accessors_.size()) - 1;
  }

  static void write_chunks(const std::filesystem::path& file, std::string json, const std::string& buffer) {
    while (json.size() % 4 != 0) json += ' ';
    std::string head = "glTF";
    for (const std::size_t number : {std::size_t{2}, 12 + 8 + json.size() + 8 + buffer.size(), json.size()})
      append_bytes(head, static_cast<std::uint32_t>(number));
    std::string between;
    append_bytes(between, static_cast<std::uint32_t>(buffer.size()));
    OutputFile out(file);
    out.write(head + "JSON");
    out.write(json);
    out.write(between + std::string("BIN\0", 4));
    out.write(buffer);
    out.close();
  }

  std::array<std::string, view_count> parts_;
  Json accessors_;
};

std::vector<float> flat(const std::vector<Vec3>& points) {
  std::vector<float> values;
  for (const Vec3& point : points)
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(point[axis]));
  return values;
}

Json material(const std::string& name, const Colour& colour) {
  const auto linear = [](double part) { return std::pow(part, 2.2); };  // close to sRGB's curve
  return {{"name", name},
          {"doubleSided", true},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {linear(colour.red), linear(colour.green), linear(colour.blue), 1.0}},
            {"metallicFactor", 0.0},
            {"roughnessFactor", 0.7}}}};
}

Json json_of(const Vec3& point) { return {point.x(), point.y(), point.z()}; }
Json json_of(const Rotation<3>& turn) { return {turn.x(), turn.y(), turn.z(), turn.w()}; }

template <int Dim>
class GlbExport final : public Exporter<Dim> {
 public:
  explicit GlbExport(const ExportInput<Dim>& input) : scene_(input.scene), file_(input.file) {
    tracks_.resize(input.bodies);
  }

  void add(const RecordedFrame<Dim>& frame) override {
    if (!begin_) begin_ = frame.time;
    const double time = frame.time - *begin_;
    for (BodyIndex body = 0; body < frame.states.size(); ++body) {
      Track& track = tracks_[body];
      if (frame.shows(body))
        follow(track, time, frame.states.shape[body], in_space(frame.states.pose[body]));
      else if (frame.states.removed[body] != 0 && !track.times.empty() && !track.until)
        track.until = time;
    }
  }

  void finish() override {
    for (const Shape<Dim>& shape : scene_.world.shapes) add_mesh(shape, shape_material(meshes_.size()));
    add_obstacles();
    for (BodyIndex body = 0; body < static_cast<BodyIndex>(tracks_.size()); ++body)
      if (!tracks_[body].times.empty()) add_body(body, tracks_[body]);
    writer_.write(file_, document());
  }

 private:
  static void follow(Track& track, double time, int shape, const Pose<3>& pose) {
    if (track.times.empty()) {
      track.shape = shape;
      track.from = time;
      track.add(time, pose);
    } else if (!same_pose(track.poses.back(), pose)) {
      if (track.seen > track.times.back()) track.add(track.seen, Pose<3>(track.poses.back()));
      track.add(time, pose);
    }
    track.seen = time;
  }

  int shape_material(std::size_t shape) {
    const std::string& own = scene_.world.shapes[shape].colour;
    const std::string name =
        own.empty() ? fmt::format("body {}", shape % colours_.awake.size()) : fmt::format("body {}", own);
    const auto [found, is_new] = material_numbers_.emplace(name, static_cast<int>(materials_.size()));
    if (is_new) materials_.push_back(material(name, body_paint(colours_, static_cast<int>(shape), own, false).fill));
    return found->second;
  }

  void add_mesh(const Shape<Dim>& shape, int material_number) {
    const TriangleMesh mesh = triangles_of(polygons_in_space(shape));
    const int positions = writer_.add_vectors(vertex_view, "VEC3", flat(mesh.corners), true);
    const int normals = writer_.add_vectors(vertex_view, "VEC3", flat(mesh.normals), false);
    meshes_.push_back({{"name", shape.name},
                       {"primitives",
                        {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                          {"indices", writer_.add_indices(mesh.indices)},
                          {"material", material_number}}}}});
  }

  void add_obstacles() {
    if (scene_.world.obstacles.empty()) return;
    materials_.push_back(material("obstacle", colours_.obstacle));
    const int number = static_cast<int>(materials_.size()) - 1;
    for (const Obstacle<Dim>& obstacle : scene_.world.obstacles) {
      add_mesh(obstacle.shape, number);
      add_node("obstacle " + obstacle.shape.name, static_cast<int>(meshes_.size()) - 1, in_space(obstacle.pose));
    }
  }

  int add_node(const std::string& name, int mesh, const Pose<3>& pose) {
    nodes_.push_back({{"name", name},
                      {"mesh", mesh},
                      {"translation", json_of(pose.position)},
                      {"rotation", json_of(pose.rotation.normalized())}});
    return static_cast<int>(nodes_.size()) - 1;
  }

  /// A node at its last pose, which viewers without animation show.
  void add_body(BodyIndex body, const Track& track) {
    const int node = add_node(fmt::format("body {}", body), track.shape, track.poses.back());
    if (track.times.size() > 1) {
      const std::vector<float> times(track.times.begin(), track.times.end());
      std::vector<Vec3> positions;
      std::vector<float> rotations;
      for (const Pose<3>& pose : track.poses) {
        positions.push_back(pose.position);
        const Rotation<3> turn = pose.rotation.normalized();
        for (const double part : {turn.x(), turn.y(), turn.z(), turn.w()})
          rotations.push_back(static_cast<float>(part));
      }
      const int input = writer_.add_vectors(animation_view, "SCALAR", times, true);
      animate(node, "translation", input, writer_.add_vectors(animation_view, "VEC3", flat(positions), false),
              "LINEAR");
      animate(node, "rotation", input, writer_.add_vectors(animation_view, "VEC4", rotations, false), "LINEAR");
    }
    if (track.from > 0.0 || track.until) animate_presence(node, track);
  }

  /// A body that is not in the world has no size.
  void animate_presence(int node, const Track& track) {
    std::vector<float> times;
    std::vector<float> sizes;
    const auto key = [&](double time, float size) {
      times.push_back(static_cast<float>(time));
      sizes.insert(sizes.end(), 3, size);
    };
    if (track.from > 0.0) key(0.0, 0.0F);
    key(track.from, 1.0F);
    if (track.until) key(*track.until, 0.0F);
    const int input = writer_.add_vectors(animation_view, "SCALAR", times, true);
    animate(node, "scale", input, writer_.add_vectors(animation_view, "VEC3", sizes, false), "STEP");
  }

  void animate(int node, const char* path, int input, int output, const char* interpolation) {
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  }

  Json document() {
    Json children = Json::array();
    for (std::size_t node = 0; node < nodes_.size(); ++node) children.push_back(node);
    const double half_turn = std::numbers::sqrt2 / 2.0;  // z up becomes y up
    nodes_.push_back({{"name", "talus"}, {"rotation", {-half_turn, 0.0, 0.0, half_turn}}, {"children", children}});
    Json json = {{"asset", {{"version", "2.0"}, {"generator", "talus"}}},
                 {"scene", 0},
                 {"scenes", {{{"name", scene_.title}, {"nodes", {nodes_.size() - 1}}}}},
                 {"nodes", nodes_},
                 {"meshes", meshes_},
                 {"materials", materials_}};
    if (!channels_.empty()) json["animations"] = {{{"name", "run"}, {"channels", channels_}, {"samplers", samplers_}}};
    return json;
  }

  const Scene<Dim>& scene_;
  std::filesystem::path file_;
  std::optional<double> begin_;  // [s] of the first frame
  std::vector<Track> tracks_;    // of each body
  PictureParams colours_;
  std::map<std::string, int> material_numbers_;  // of bodies, by name
  GlbWriter writer_;
  Json nodes_ = Json::array();
  Json meshes_ = Json::array();
  Json materials_ = Json::array();
  Json channels_ = Json::array();
  Json samplers_ = Json::array();
};

}  // namespace

template <int Dim>
std::unique_ptr<Exporter<Dim>> make_glb_export(const ExportInput<Dim>& input) {
  return std::make_unique<GlbExport<Dim>>(input);
}
template std::unique_ptr<Exporter<2>> make_glb_export(const ExportInput<2>&);
template std::unique_ptr<Exporter<3>> make_glb_export(const ExportInput<3>&);

}  // namespace talus
