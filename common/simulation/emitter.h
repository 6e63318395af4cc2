#pragma once
// Adds the bodies of a scene to a world.

#include <cstdint>
#include <deque>
#include <limits>
#include <random>
#include <vector>

#include "common/scene/scene.h"
#include "common/world/world.h"

namespace talus {

/// Adds the bodies that are there from the start, then due ones of the sources where their place is free. Each source
/// draws from a generator of its own, so sources do not disturb one another; the same seed gives the same bodies.
template <int Dim>
class Emitter {
 public:
  explicit Emitter(const Scene<Dim>& scene);

  /// Before the first step: adds the bodies that are there from the start.
  void add_initial(World<Dim>& world);
  /// Adds all bodies of sources that are due at `time` [s] and have room.
  void emit(World<Dim>& world, double time);

  /// A source that waits for an event begins at `time` [s].
  void start(int source, double time);
  /// Another rate of a source from `time` [s] on; its next body is due at once.
  void set_rate(int source, double rate, double time);
  const Source<Dim>& source(int number) const { return spouts_[number].source; }

  /// Bodies that were to appear until `time` [s], with those that are there from the start.
  int due_by(double time) const;
  /// Time at which the last body of a source appeared [s]; 0 before.
  double last_appearance() const { return last_appearance_; }

  /// Whether all have appeared but for those of sources that wait for an event.
  bool finished() const { return emitted_ + waiting_ == total_; }
  int emitted() const { return emitted_; }
  /// Of a source.
  int emitted(int number) const { return spouts_[number].emitted; }
  int total() const { return total_; }
  /// Steps at which a due body had to wait, over all sources.
  std::int64_t waits() const { return waits_; }

 private:
  struct Spout {
    Source<Dim> source;
    std::mt19937_64 random;
    int emitted = 0;
    double lift = 0.0;    // how far the spout has risen [m]
    bool drawn = false;   // `next` holds a body that waits
    BodyDef<Dim> next{};  // its position is relative to the spout
  };

  /// The first of the bodies that appeared at one time.
  struct Appearance {
    double time = 0.0;
    BodyIndex body = 0;
  };

  bool due(const Spout& spout, double time) const;
  int draw_size(Spout& spout) const;
  void draw(Spout& spout) const;
  Vec<Dim> place(const Spout& spout, double time) const;
  Vec<Dim> place_in_grid(const Spout& spout) const;
  bool has_room(const World<Dim>& world, const BodyDef<Dim>& body, double overlap_allowed);
  void ride(const World<Dim>& world, Spout& spout, double time);
  bool lies_on_something(const World<Dim>& world, BodyIndex body, const Box<Dim>& bounds);

  std::vector<BodyDef<Dim>> initial_;  // there from the start
  std::vector<Spout> spouts_;
  double ground_ = -std::numeric_limits<double>::infinity();  // [m]
  std::deque<Appearance> recent_;                             // that cannot be as fast yet as what is in flight
  std::vector<BodyIndex> near_;                               // scratch
  std::vector<BodyIndex> beneath_;                            // scratch
  int emitted_ = 0;
  double last_appearance_ = 0.0;  // [s]
  int obstacles_ = 0;             // of the description, present or removed
  int total_ = 0;
  int waiting_ = 0;  // bodies of sources that wait for an event
  std::int64_t waits_ = 0;
};

}  // namespace talus
