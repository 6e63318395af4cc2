#include "talus/talus.h"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/math/require.h"
#include "common/shape/catalogue.h"
#include "common/simulation/sleeper_watch.h"
#include "common/sleeper/pile_sleeper.h"
#include "common/sleeper/step_buffer.h"
#ifdef TALUS_LCM
#include "lcmtypes/world_feed.h"
#endif

/// A sleeper of either dimension.
struct talus_sleeper {
  virtual ~talus_sleeper() = default;
  talus_sleeper() = default;
  talus_sleeper(const talus_sleeper&) = delete;
  talus_sleeper& operator=(const talus_sleeper&) = delete;

  virtual void box(double mass, const double* size, talus_body& body) const = 0;
  virtual void ball(double mass, double radius, talus_body& body) const = 0;
  virtual void convex(double mass, const double* corners, std::size_t count, talus_body& body) const = 0;
  virtual talus_handle add(const talus_body& body) = 0;
  virtual const std::vector<talus_handle>& followed() = 0;
  virtual const talus_changes& after_step(const talus_step& step) = 0;
  virtual const talus_changes& remove(talus_handle body) = 0;
  virtual const talus_changes& wake(talus_handle body) = 0;
  virtual const talus_changes& wake_all() = 0;
  virtual const talus_changes& wake_near(const double* low, const double* high) = 0;
  virtual const talus_changes& moved(talus_handle body, const double* position, const double* rotation) = 0;
  virtual const talus_changes& set_gravity(const double* gravity) = 0;
  virtual const std::vector<talus_saved>& snapshot() = 0;
  virtual const talus_changes& restore(std::span<const talus_saved> saved, const talus_state* states) = 0;
  virtual bool asleep(talus_handle body) const = 0;
  virtual talus_handle body_of(int number) const = 0;
  virtual void record(const char* path, const talus_label* label) = 0;
  virtual void publish(const talus_label* label) = 0;
  virtual void watch(talus_report report, void* context) = 0;
  virtual void show(talus_handle body, std::span<const talus_piece> pieces) = 0;
  virtual void end_observers() = 0;
};

namespace talus::capi {
namespace {

/// As errno, it belongs to the thread: where nothing could be created there is no other place for it.
std::string& last_message() {
  thread_local std::string message;
  return message;
}

template <int Dim>
Vec<Dim> vector_of(const double* numbers) {
  return Eigen::Map<const Vec<Dim>>(numbers);
}
template <int Dim>
void write(const Vec<Dim>& vector, double* numbers) {
  Eigen::Map<Vec<Dim>> written(numbers);
  written = vector;
}
template <int Dim>
Pose<Dim> pose_of(const double* position, const double* rotation) {
  if constexpr (Dim == 2)
    return {vector_of<2>(position), Rotation<2>(rotation[0])};
  else
    return {vector_of<3>(position), Rotation<3>(rotation[3], rotation[0], rotation[1], rotation[2])};
}
template <int Dim>
Spin<Dim> spin_of(const double* spin) {
  if constexpr (Dim == 2)
    return Spin<2>(spin[2]);
  else
    return vector_of<3>(spin);
}

/// A struct of a later version may be longer; a shorter one lacks fields.
template <typename Struct>
void require_size(const Struct* given, const char* name) {
  require(given != nullptr, name, "null", "must be the address of a struct");
  require(given->size >= sizeof(Struct), fmt::format("{}.size", name), static_cast<double>(given->size),
          fmt::format("must be {}, sizeof of the struct", sizeof(Struct)));
}
void require_there(const void* address, const char* name) {
  require(address != nullptr, name, "null", "must be an address");
}

/// `centre` is the origin of the pieces made, in the axes of `given`.
template <int Dim>
std::vector<Piece<Dim>> pieces_of(const talus_piece& given, const Vec<Dim>& centre) {
  require(given.count == 0 || given.corners != nullptr, "piece.corners", "null", "must be an address");
  std::vector<Vec<Dim>> corners;
  for (std::size_t i = 0; i < given.count; ++i) corners.push_back(vector_of<Dim>(given.corners + Dim * i) - centre);
  if (corners.empty()) corners = {Vec<Dim>::Zero()};
  if (given.radius == 0.0) return hull_pieces<Dim>(corners);
  return {HullPiece<Dim>{.corners = corners, .radius = given.radius}};
}

#ifdef TALUS_LCM
WorldLabel label_of(const talus_label* given) {
  WorldLabel label;
  if (given == nullptr) return label;
  require_size(given, "label");
  if (given->name != nullptr) label.name = given->name;
  if (given->title != nullptr) label.title = given->title;
  if (given->engine != nullptr) label.engine = given->engine;
  if (given->dt != 0.0) label.dt = given->dt;
  if (given->frame_rate != 0.0) label.frame_rate = given->frame_rate;
  return label;
}
#else
template <int Dim>
std::unique_ptr<Observer<Dim>> no_feed() {
  throw std::runtime_error("this build of talus has neither record nor live view: it was configured without LCM");
}
#endif

template <int Dim>
class Sleeper final : public talus_sleeper {
 public:
  Sleeper(const talus_options& options, const SleeperOptions& given) : core_(vector_of<Dim>(options.gravity), given) {}

  void box(double mass, const double* size, talus_body& body) const override {
    write_traits(box_traits<Dim>(mass, vector_of<Dim>(size)), body);
  }
  void ball(double mass, double radius, talus_body& body) const override {
    write_traits(ball_traits<Dim>(mass, radius), body);
    body.piece.radius = radius;
  }
  void convex(double mass, const double* corners, std::size_t count, talus_body& body) const override {
    const talus_piece piece = {corners, count, 0.0};
    const Shape<Dim> shape = make_shape<Dim>("convex", pieces_of<Dim>(piece, Vec<Dim>::Zero()), {});
    BodyTraits<Dim> traits = traits_of(shape);
    traits.inertia *= mass / shape.mass;
    traits.mass = mass;
    write_traits(traits, body);
    body.piece = piece;
    write<Dim>(-shape.reference, body.centre);
  }
  talus_handle add(const talus_body& body) override {
    require(body.role >= TALUS_SLEEPS && body.role <= TALUS_KINEMATIC, "role", body.role, "must be a talus_role");
    BodyTraits<Dim> traits{.mass = body.mass, .friction = body.friction};
    traits.bounds = Box<Dim>(vector_of<Dim>(body.low), vector_of<Dim>(body.high));
    for (Eigen::Index i = 0; i < traits.inertia.size(); ++i) traits.inertia(i) = body.inertia[i];
    if (body.piece.count > 0 || body.piece.radius != 0.0)
      traits.pieces = pieces_of<Dim>(body.piece, vector_of<Dim>(body.centre));
    return number_of(core_.add(traits, pose_of<Dim>(body.position, body.rotation), static_cast<BodyRole>(body.role)));
  }
  const std::vector<talus_handle>& followed() override {
    followed_.clear();
    for (const Handle handle : core_.followed()) followed_.push_back(number_of(handle));
    return followed_;
  }
  const talus_changes& after_step(const talus_step& step) override {
    buffer_.clear();
    for (std::size_t i = 0; i < step.body_count; ++i) {
      const talus_state& state = step.states[i];
      buffer_.add(handle_of(step.bodies[i]), pose_of<Dim>(state.position, state.rotation),
                  vector_of<Dim>(state.velocity), spin_of<Dim>(state.spin));
    }
    for (std::size_t i = 0; i < step.contact_count; ++i) {
      const talus_contact& contact = step.contacts[i];
      buffer_.contacts.push_back({.a = handle_of(contact.a),
                                  .b = handle_of(contact.b),
                                  .point = vector_of<Dim>(contact.point),
                                  .normal = vector_of<Dim>(contact.normal),
                                  .normal_impulse = contact.normal_impulse,
                                  .friction_impulse = vector_of<Dim>(contact.friction_impulse),
                                  .approach_speed = contact.approach_speed,
                                  .depth = contact.depth});
    }
    return written(core_.after_step(buffer_.step(step.dt)));
  }
  const talus_changes& remove(talus_handle body) override { return written(core_.remove(handle_of(body))); }
  const talus_changes& wake(talus_handle body) override { return written(core_.wake(handle_of(body))); }
  const talus_changes& wake_all() override { return written(core_.wake_all()); }
  const talus_changes& wake_near(const double* low, const double* high) override {
    return written(core_.wake_near({vector_of<Dim>(low), vector_of<Dim>(high)}));
  }
  const talus_changes& moved(talus_handle body, const double* position, const double* rotation) override {
    return written(core_.moved(handle_of(body), pose_of<Dim>(position, rotation)));
  }
  const talus_changes& set_gravity(const double* gravity) override {
    return written(core_.set_gravity(vector_of<Dim>(gravity)));
  }
  const std::vector<talus_saved>& snapshot() override {
    saved_.clear();
    for (const SavedSleep& one : core_.snapshot())
      saved_.push_back({number_of(one.body), one.asleep ? 1 : 0, one.settled ? 1 : 0});
    return saved_;
  }
  const talus_changes& restore(std::span<const talus_saved> saved, const talus_state* states) override {
    std::vector<SavedSleep> given;
    std::vector<Pose<Dim>> poses;
    for (std::size_t i = 0; i < saved.size(); ++i) {
      given.push_back({handle_of(saved[i].body), saved[i].asleep != 0, saved[i].settled != 0});
      poses.push_back(pose_of<Dim>(states[i].position, states[i].rotation));
    }
    return written(core_.restore(given, poses));
  }
  bool asleep(talus_handle body) const override { return core_.asleep(handle_of(body)); }
  talus_handle body_of(int number) const override { return number_of(core_.handle_of(number)); }

#ifdef TALUS_LCM
  void record(const char* path, const talus_label* label) override {
    core_.observe(record_world<Dim>(path, label_of(label)));
  }
  void publish(const talus_label* label) override { core_.observe(publish_world<Dim>(label_of(label))); }
#else
  void record(const char*, const talus_label*) override { core_.observe(no_feed<Dim>()); }
  void publish(const talus_label*) override { core_.observe(no_feed<Dim>()); }
#endif
  void watch(talus_report report, void* context) override {
    core_.observe(std::make_unique<SleeperWatch<Dim>>([this, report, context](const Warning& warning) {
      const std::string text = advice(warning);
      const talus_warning told = {to_string(warning.kind).data(), number_of(core_.handle_of(warning.body)),
                                  warning.value, text.c_str()};
      report(&told, context);
    }));
  }
  void show(talus_handle body, std::span<const talus_piece> pieces) override {
    std::vector<Piece<Dim>> made;
    for (const talus_piece& piece : pieces)
      for (const Piece<Dim>& one : pieces_of<Dim>(piece, Vec<Dim>::Zero())) made.push_back(one);
    if (body == 0)
      core_.add_static(made, {});
    else
      core_.set_pieces(handle_of(body), made);
  }
  void end_observers() override { core_.end_observers(); }

 private:
  static void write_traits(const BodyTraits<Dim>& traits, talus_body& body) {
    body.piece = {};
    write<Dim>(Vec<Dim>::Zero(), body.centre);
    body.mass = traits.mass;
    for (Eigen::Index i = 0; i < traits.inertia.size(); ++i) body.inertia[i] = traits.inertia(i);
    write<Dim>(traits.bounds.min(), body.low);
    write<Dim>(traits.bounds.max(), body.high);
  }
  static void write_changes(const std::vector<SleepChange>& from, std::vector<talus_change>& to) {
    to.clear();
    for (const SleepChange& change : from) to.push_back({number_of(change.body), static_cast<int>(change.cause)});
  }
  const talus_changes& written(const SleepChanges<Dim>& changes) {
    write_changes(changes.thaw, thaw_);
    write_changes(changes.freeze, freeze_);
    velocities_.clear();
    for (const GivenVelocity<Dim>& change : changes.velocities) {
      talus_velocity& velocity = velocities_.emplace_back();
      velocity.body = number_of(change.body);
      write<Dim>(change.velocity, velocity.velocity);
      write<static_cast<int>(Spin<Dim>::SizeAtCompileTime)>(change.spin, velocity.spin + (Dim == 2 ? 2 : 0));
    }
    changes_ = {sizeof(talus_changes), thaw_.size(),   thaw_.data(),  velocities_.size(),
                velocities_.data(),    freeze_.size(), freeze_.data()};
    return changes_;
  }

  PileSleeper<Dim> core_;
  StepBuffer<Dim> buffer_;
  std::vector<talus_handle> followed_;
  std::vector<talus_saved> saved_;
  std::vector<talus_change> thaw_;
  std::vector<talus_velocity> velocities_;
  std::vector<talus_change> freeze_;
  talus_changes changes_{};
};

/// No exception leaves the library.
template <typename Act>
int guarded(const Act& act) {
  try {
    act();
    return TALUS_OK;
  } catch (const std::invalid_argument& error) {
    last_message() = error.what();
    return TALUS_BAD_VALUE;
  } catch (const std::exception& error) {
    last_message() = error.what();
    return TALUS_FAILED;
  } catch (...) {  // of a report in C++
    last_message() = "unknown exception";
    return TALUS_FAILED;
  }
}

template <typename Act>
int changing(talus_sleeper* sleeper, talus_changes* changes, const Act& act) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_size(changes, "changes");
    const std::size_t size = changes->size;
    *changes = act(*sleeper);
    changes->size = size;
  });
}

SleeperOptions options_of(const talus_options& options) {
  SleeperOptions given{.enabled = options.enabled != 0};
  require(options.up >= TALUS_UP_X && options.up <= TALUS_UP_AUTO, "up", options.up, "must be a talus_up");
  if (options.up != TALUS_UP_AUTO) given.up = static_cast<UpAxis>(options.up);
  if (options.extent != 0.0) given.extent = options.extent;
  given.adaptive.tolerance = options.tolerance;
  return given;
}

}  // namespace
}  // namespace talus::capi

using talus::capi::changing;
using talus::capi::guarded;
using talus::capi::require_size;
using talus::capi::require_there;

const char* talus_message() { return talus::capi::last_message().c_str(); }
const char* talus_cause_name(int cause) {
  const bool known = cause >= 0 && cause <= talus::last_cause;
  return talus::to_string(static_cast<talus::SleepCause>(known ? cause : talus::last_cause + 1)).data();
}

talus_options talus_default_options(int dimension) {
  const talus::SleeperOptions defaults;
  talus_options options{};
  options.size = sizeof(talus_options);
  options.dimension = dimension;
  options.gravity[dimension == 2 ? 1 : 2] = -9.81;
  options.enabled = 1;
  options.up = TALUS_UP_AUTO;
  options.tolerance = defaults.adaptive.tolerance;
  return options;
}

int talus_create(const talus_options* options, talus_sleeper** created) {
  return guarded([&] {
    require_size(options, "options");
    require_there(created, "created");
    talus::require(options->dimension == 2 || options->dimension == 3, "dimension", options->dimension,
                   "must be 2 or 3");
    const talus::SleeperOptions given = talus::capi::options_of(*options);
    if (options->dimension == 2)
      *created = new talus::capi::Sleeper<2>(*options, given);
    else
      *created = new talus::capi::Sleeper<3>(*options, given);
  });
}
void talus_destroy(talus_sleeper* sleeper) { delete sleeper; }

int talus_box(const talus_sleeper* sleeper, double mass, const double size[3], talus_body* body) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_size(body, "body");
    require_there(size, "size");
    sleeper->box(mass, size, *body);
  });
}
int talus_ball(const talus_sleeper* sleeper, double mass, double radius, talus_body* body) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_size(body, "body");
    sleeper->ball(mass, radius, *body);
  });
}
int talus_convex(const talus_sleeper* sleeper, double mass, const double* corners, std::size_t count,
                 talus_body* body) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_size(body, "body");
    require_there(corners, "corners");
    sleeper->convex(mass, corners, count, *body);
  });
}

int talus_add(talus_sleeper* sleeper, const talus_body* body, talus_handle* added) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_size(body, "body");
    require_there(added, "added");
    *added = sleeper->add(*body);
  });
}
int talus_followed(talus_sleeper* sleeper, const talus_handle** bodies, std::size_t* count) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_there(bodies, "bodies");
    require_there(count, "count");
    const std::vector<talus_handle>& followed = sleeper->followed();
    *bodies = followed.data();
    *count = followed.size();
  });
}
int talus_after_step(talus_sleeper* sleeper, const talus_step* step, talus_changes* changes) {
  return changing(sleeper, changes, [&](talus_sleeper& s) {
    require_size(step, "step");
    talus::require(step->body_count == 0 || (step->bodies != nullptr && step->states != nullptr), "step.bodies", "null",
                   "must be there, and states too, with bodies");
    talus::require(step->contact_count == 0 || step->contacts != nullptr, "step.contacts", "null",
                   "must be there with contacts");
    return s.after_step(*step);
  });
}
int talus_remove(talus_sleeper* sleeper, talus_handle body, talus_changes* changes) {
  return changing(sleeper, changes, [&](talus_sleeper& s) { return s.remove(body); });
}
int talus_wake(talus_sleeper* sleeper, talus_handle body, talus_changes* changes) {
  return changing(sleeper, changes, [&](talus_sleeper& s) { return s.wake(body); });
}
int talus_wake_all(talus_sleeper* sleeper, talus_changes* changes) {
  return changing(sleeper, changes, [&](talus_sleeper& s) { return s.wake_all(); });
}
int talus_wake_near(talus_sleeper* sleeper, const double low[3], const double high[3], talus_changes* changes) {
  return changing(sleeper, changes, [&](talus_sleeper& s) {
    require_there(low, "low");
    require_there(high, "high");
    return s.wake_near(low, high);
  });
}
int talus_moved(talus_sleeper* sleeper, talus_handle body, const double position[3], const double rotation[4],
                talus_changes* changes) {
  return changing(sleeper, changes, [&](talus_sleeper& s) {
    require_there(position, "position");
    require_there(rotation, "rotation");
    return s.moved(body, position, rotation);
  });
}
int talus_set_gravity(talus_sleeper* sleeper, const double gravity[3], talus_changes* changes) {
  return changing(sleeper, changes, [&](talus_sleeper& s) {
    require_there(gravity, "gravity");
    return s.set_gravity(gravity);
  });
}
int talus_snapshot(talus_sleeper* sleeper, const talus_saved** saved, std::size_t* count) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_there(saved, "saved");
    require_there(count, "count");
    const std::vector<talus_saved>& all = sleeper->snapshot();
    *saved = all.data();
    *count = all.size();
  });
}
int talus_restore(talus_sleeper* sleeper, const talus_saved* saved, const talus_state* states, std::size_t count,
                  talus_changes* changes) {
  return changing(sleeper, changes, [&](talus_sleeper& s) -> const talus_changes& {
    talus::require(count == 0 || (saved != nullptr && states != nullptr), "saved", "null",
                   "must be there, and states too, with bodies");
    return s.restore({saved, count}, states);
  });
}
int talus_asleep(const talus_sleeper* sleeper, talus_handle body, int* asleep) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_there(asleep, "asleep");
    *asleep = sleeper->asleep(body) ? 1 : 0;
  });
}

int talus_handle_of(const talus_sleeper* sleeper, int number, talus_handle* body) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_there(body, "body");
    *body = sleeper->body_of(number);
  });
}

int talus_record(talus_sleeper* sleeper, const char* path, const talus_label* label) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_there(path, "path");
    sleeper->record(path, label);
  });
}
int talus_publish(talus_sleeper* sleeper, const talus_label* label) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    sleeper->publish(label);
  });
}
int talus_watch(talus_sleeper* sleeper, talus_report report, void* context) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    talus::require(report != nullptr, "report", "null", "must be a function");
    sleeper->watch(report, context);
  });
}
int talus_show(talus_sleeper* sleeper, talus_handle body, const talus_piece* pieces, std::size_t count) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    require_there(pieces, "pieces");
    sleeper->show(body, {pieces, count});
  });
}
int talus_end_observers(talus_sleeper* sleeper) {
  return guarded([&] {
    require_there(sleeper, "sleeper");
    sleeper->end_observers();
  });
}
