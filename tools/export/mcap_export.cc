#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tools/export/exporter.h"
#include "tools/export/foxglove_messages.h"
#include "tools/export/mcap_file.h"
#include "tools/export/solid.h"
#include "tools/picture/body_colours.h"

namespace talus {
namespace {

// A program that seeks reads only the last message of each channel, so all is written again from time to time.
constexpr double key_interval = 1.0;     // [s] simulated
constexpr double layer_interval = 0.25;  // [s] simulated

template <int Dim>
class McapExport final : public Exporter<Dim> {
 public:
  explicit McapExport(const ExportInput<Dim>& input) : file_(input.file), obstacles_(input.scene.world.obstacles) {
    const std::string types = foxglove_descriptors();
    transforms_ = file_.add_channel("/tf", "foxglove.FrameTransforms", types);
    bodies_ = file_.add_channel("/bodies", "foxglove.SceneUpdate", types);
    obstacles_channel_ = file_.add_channel("/obstacles", "foxglove.SceneUpdate", types);
    layers_ = file_.add_channel("/layers", "foxglove.SceneUpdate", types);
    counts_ = file_.add_channel("/counts", "talus.Counts", types);
    sleep_ = file_.add_channel("/sleep", "talus.SleepEvents", types);
    warnings_ = file_.add_channel("/warnings", "foxglove.Log", types);
    for (const Shape<Dim>& shape : input.scene.world.shapes) {
      meshes_.push_back(triangles_of(polygons_in_space(shape)));
      own_colours_.push_back(shape.colour);
    }
  }

  void add(const RecordedFrame<Dim>& frame) override {
    if (first_) add_obstacles(frame);
    const bool key = first_ || frame.time >= next_key_;
    if (key) next_key_ = frame.time + key_interval;
    add_bodies(frame, key);
    if (frame.time >= next_layers_) add_layers(frame);
    add_counts(frame);
    if (!frame.events.empty()) add_events(frame);
    add_warnings(frame);
    first_ = false;
  }

  void finish() override { file_.close(); }

 private:
  /// What the file has of a body.
  struct Known {
    Pose<Dim> pose;
    int asleep = -1;  // -1: the body is not shown
  };

  static bool same(const Pose<Dim>& a, const Pose<Dim>& b) {
    return a.position == b.position && a.rotation.toRotationMatrix() == b.rotation.toRotationMatrix();
  }

  void write(int channel, double time, const ProtoMessage& message) {
    file_.add(channel, static_cast<std::uint64_t>(std::llround(1e9 * time)), message.bytes());
  }

  void add_obstacles(const RecordedFrame<Dim>& frame) {
    ProtoMessage update;
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
      const ScenePrimitive shape = {ScenePrimitive::triangles,
                                    triangles_message(triangles_of(polygons_in_space(obstacles_[i].shape)),
                                                      in_space(obstacles_[i].pose), colours_.obstacle)};
      update.add(2, scene_entity(frame.time, "world", fmt::format("obstacle {}", i), {&shape, 1}));
    }
    write(obstacles_channel_, frame.time, update);
  }

  void add_bodies(const RecordedFrame<Dim>& frame, bool key) {
    ProtoMessage transforms;
    ProtoMessage update;
    known_.resize(frame.states.size());
    for (BodyIndex body = 0; body < frame.states.size(); ++body) {
      Known& known = known_[body];
      const Pose<Dim>& pose = frame.states.pose[body];
      const std::string name = fmt::format("body {}", body);
      if (!frame.shows(body)) {
        if (known.asleep >= 0) update.add(1, deletion(frame.time, name));
        known.asleep = -1;
        continue;
      }
      if (key || known.asleep < 0 || !same(known.pose, pose))
        transforms.add(1, frame_transform(frame.time, name, in_space(pose)));
      const int asleep = frame.states.asleep[body];
      if (key || known.asleep != asleep) update.add(2, entity(frame, body, name));
      known = {pose, asleep};
    }
    if (!transforms.bytes().empty()) write(transforms_, frame.time, transforms);
    if (!update.bytes().empty()) write(bodies_, frame.time, update);
  }

  ProtoMessage entity(const RecordedFrame<Dim>& frame, BodyIndex body, const std::string& name) const {
    const int shape = frame.states.shape[body];
    const Colour colour = body_paint(colours_, shape, own_colours_[shape], frame.states.asleep[body] != 0).fill;
    const ScenePrimitive mesh = {ScenePrimitive::triangles,
                                 triangles_message(meshes_[shape], {Vec3::Zero(), Rotation<3>::Identity()}, colour)};
    return scene_entity(frame.time, name, name, {&mesh, 1});
  }

  static ProtoMessage deletion(double time, const std::string& name) {
    ProtoMessage message;
    message.add(1, timestamp_message(time));
    message.add(3, name);
    return message;
  }

  void add_layers(const RecordedFrame<Dim>& frame) {
    next_layers_ = frame.time + layer_interval;
    ProtoMessage update;
    for (std::size_t i = 0; i < frame.piles.size(); ++i) {
      const Pile<Dim>& pile = frame.piles[i];
      std::vector<ScenePrimitive> slices;
      for (const Layer& layer : pile.layers) {
        const Vec3 centre = in_space(Pose<Dim>{pile.centre, Rotation<Dim>::Identity()}).position +
                            Vec3(0.0, 0.0, (layer.bottom + layer.top) / 2);
        const double thin = 0.01 * layer.radius;
        const Vec3 size(2.0 * layer.radius, Dim == 2 ? thin : 2.0 * layer.radius, layer.top - layer.bottom);
        const double opacity = 0.05 + 0.25 * std::clamp(layer.density(), 0.0, 1.0);
        slices.push_back(block_message(Dim == 3, centre, size, colours_.layer, opacity));
      }
      update.add(2, scene_entity(frame.time, "world", fmt::format("pile {}", i), slices));
    }
    write(layers_, frame.time, update);
  }

  void add_counts(const RecordedFrame<Dim>& frame) {
    std::int64_t asleep = 0;
    std::int64_t present = 0;
    for (BodyIndex body = 0; body < frame.states.size(); ++body) {
      if (frame.states.removed[body] != 0) continue;
      ++present;
      asleep += frame.states.asleep[body];
    }
    const auto woken = std::ranges::count_if(frame.events, &SleepEvent::woke);
    const auto largest = std::ranges::max_element(frame.piles, {}, &Pile<Dim>::structure_size);
    std::vector<double> densities;
    if (largest != frame.piles.end())
      for (const Layer& layer : largest->layers) densities.push_back(layer.density());
    ProtoMessage message;
    message.add(1, timestamp_message(frame.time));
    message.add_integer(2, present - asleep);
    message.add_integer(3, asleep);
    message.add_integer(4, std::ssize(frame.events) - woken);
    message.add_integer(5, woken);
    message.add(6, frame.kinetic_energy);
    message.add(7, frame.drift_estimate);
    message.add_packed(8, densities);
    write(counts_, frame.time, message);
  }

  void add_events(const RecordedFrame<Dim>& frame) {
    ProtoMessage message;
    message.add(1, timestamp_message(frame.time));
    for (const SleepEvent& event : frame.events) {
      ProtoMessage one;
      one.add_integer(1, event.step);
      one.add_integer(2, event.body);
      one.add_integer(3, event.woke ? 1 : 0);
      one.add(4, to_string(event.cause));
      one.add(5, event.score);
      one.add_integer(6, static_cast<std::uint64_t>(std::int64_t{event.pile}));
      one.add_integer(7, static_cast<std::uint64_t>(std::int64_t{event.layer}));
      message.add(2, one);
    }
    write(sleep_, frame.time, message);
  }

  void add_warnings(const RecordedFrame<Dim>& frame) {
    for (const Warning& warning : frame.warnings)
      if (const std::string text = account(warning); std::exchange(written_[warning.kind], text) != text)
        write(warnings_, frame.time, warning_message(frame.time, to_string(warning.kind), text));
  }

  McapFile file_;
  std::vector<Obstacle<Dim>> obstacles_;
  std::vector<TriangleMesh> meshes_;      // of each shape
  std::vector<std::string> own_colours_;  // of each shape
  PictureParams colours_;
  int transforms_ = 0;  // channels
  int bodies_ = 0;
  int obstacles_channel_ = 0;
  int layers_ = 0;
  int counts_ = 0;
  int sleep_ = 0;
  int warnings_ = 0;
  std::vector<Known> known_;
  std::map<WarningKind, std::string> written_;  // texts of the warnings
  bool first_ = true;
  double next_key_ = 0.0;     // [s]
  double next_layers_ = 0.0;  // [s]
};

}  // namespace

template <int Dim>
std::unique_ptr<Exporter<Dim>> make_mcap_export(const ExportInput<Dim>& input) {
  return std::make_unique<McapExport<Dim>>(input);
}
template std::unique_ptr<Exporter<2>> make_mcap_export(const ExportInput<2>&);
template std::unique_ptr<Exporter<3>> make_mcap_export(const ExportInput<3>&);

}  // namespace talus
