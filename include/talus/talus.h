/// @file
/// Sleep body by body for any physics engine, in C: what common/sleeper/pile_sleeper.h is in C++, with its rules.
///
/// Lengths in m, masses in kg, times in s, in the program's own axes. In 2D the third number of a vector means nothing;
/// of `spin` only the third counts, the angular velocity, and `rotation[0]` is the angle in radians.
/// The structs with a member `size` begin with it, and the program sets it: {.size = sizeof(struct talus_options)}.
/// Every function that returns an int returns TALUS_OK or another talus_result, and then talus_message() has the
/// reason; a refused call changes nothing. A sleeper is used by one thread at a time.
#ifndef TALUS_TALUS_H
#define TALUS_TALUS_H

#include <stddef.h>
#include <stdint.h>

/// Marks what the shared library exports.
#if defined(__GNUC__)
#define TALUS_API __attribute__((visibility("default")))
#else
#define TALUS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// Decides which bodies of an engine sleep; from talus_create() to talus_destroy().
typedef struct talus_sleeper talus_sleeper;

/// Names a body until it is removed; 0 names none, and in a contact stands for all that never moves.
typedef uint64_t talus_handle;

/// What a function returns.
enum talus_result {
  TALUS_OK = 0,         ///< done
  TALUS_BAD_VALUE = 1,  ///< an argument is outside of its range
  TALUS_FAILED = 2      ///< memory is short, a file cannot be written, or talus has a bug
};

/// What a body may do.
enum talus_role {
  TALUS_SLEEPS = 0,       ///< sleep
  TALUS_STAYS_AWAKE = 1,  ///< only wake others, as a body with joints
  TALUS_KINEMATIC = 2     ///< move as the program says, whatever acts on it
};

/// Axis that points up.
enum talus_up {
  TALUS_UP_X,        ///< x
  TALUS_UP_Y,        ///< y
  TALUS_UP_Z,        ///< z, in 3D only
  TALUS_UP_MINUS_X,  ///< -x
  TALUS_UP_MINUS_Y,  ///< -y
  TALUS_UP_MINUS_Z,  ///< -z, in 3D only
  TALUS_UP_AUTO      ///< the axis nearest to the opposite of gravity
};

/// Options of talus_create(); talus_default_options() has the defaults.
struct talus_options {
  size_t size;        ///< sizeof(struct talus_options)
  int dimension;      ///< 2 or 3
  double gravity[3];  ///< [m/s^2]
  int enabled;        ///< 0: nothing sleeps
  int up;             ///< enum talus_up
  double extent;      ///< diagonal of a typical body's box [m]; 0: found from the bodies
  double tolerance;   ///< of stability checks, in extents; 0: none
};

/// A convex piece of what observers see: the hull of its corners; a ball without corners, a capsule around two of them.
struct talus_piece {
  const double* corners;  ///< points of 3 numbers, in 2D of 2 [m]
  size_t count;           ///< of the points
  double radius;          ///< of a ball or a capsule [m]
};

/// A body and where it is. talus_box(), talus_ball() and talus_convex() set mass, inertia, low, high, piece and centre.
struct talus_body {
  size_t size;         ///< sizeof(struct talus_body)
  int role;            ///< enum talus_role
  double mass;         ///< [kg]; of a kinematic body it means nothing
  double inertia[9];   ///< about the centre of mass, in the body's axes, row by row [kg m^2]; in 2D the first number
  double low[3];       ///< lower corner of its box in the body's axes, around the centre of mass, at most 0 [m]
  double high[3];      ///< upper corner, at least 0
  double friction;     ///< against a body like it
  double position[3];  ///< of the centre of mass [m]
  double rotation[4];  ///< unit quaternion x, y, z, w

  struct talus_piece piece;  ///< what observers see, read by talus_add(); all zero: the box
  double centre[3];          ///< of mass, in the axes of the piece's corners [m]
};

/// Where a body is and how it moves, after a step.
struct talus_state {
  double position[3];  ///< of the centre of mass [m]
  double rotation[4];  ///< unit quaternion x, y, z, w
  double velocity[3];  ///< of the centre of mass [m/s]
  double spin[3];      ///< [rad/s]
};

/// A contact point after a step. Points between two sleeping bodies mean nothing and may be left out.
struct talus_contact {
  talus_handle a;              ///< a body
  talus_handle b;              ///< what it touches, or 0
  double point[3];             ///< [m]
  double normal[3];            ///< unit, from b to a; if it points the other way, no body sleeps
  double normal_impulse;       ///< over the step, >= 0 [N s]
  double friction_impulse[3];  ///< over the step, on a [N s]
  double approach_speed;       ///< before the step, >= 0 [m/s]
  double depth;                ///< positive where they overlap [m]
};

/// The result of one step of the engine.
struct talus_step {
  size_t size;                           ///< sizeof(struct talus_step)
  double dt;                             ///< [s]
  size_t body_count;                     ///< length of `bodies` and of `states`
  const talus_handle* bodies;            ///< each of talus_followed() once, in any order
  const struct talus_state* states;      ///< of the bodies, in their order
  size_t contact_count;                  ///< length of `contacts`
  const struct talus_contact* contacts;  ///< in any order
};

/// A body that falls asleep or wakes.
struct talus_change {
  talus_handle body;  ///< which
  int cause;          ///< talus_cause_name() has its name
};
/// A velocity to be given to a body.
struct talus_velocity {
  talus_handle body;   ///< which
  double velocity[3];  ///< [m/s]
  double spin[3];      ///< [rad/s]
};
/// What a saved program must keep of a body that is not kinematic.
struct talus_saved {
  talus_handle body;  ///< the body
  int asleep;         ///< 1: it slept
  int settled;        ///< 1: asleep, and no stability check is to come
};

/// What the program must do in its engine at once, in this order. The arrays live until the next call.
struct talus_changes {
  size_t size;                              ///< sizeof(struct talus_changes)
  size_t thaw_count;                        ///< length of `thaw`
  const struct talus_change* thaw;          ///< bodies that wake
  size_t velocity_count;                    ///< length of `velocities`
  const struct talus_velocity* velocities;  ///< of awake bodies
  size_t freeze_count;                      ///< length of `freeze`
  const struct talus_change* freeze;        ///< bodies that fall asleep where they are
};

/// What the program's world is called where observers show it. All zero but `size`: the defaults.
struct talus_label {
  size_t size;         ///< sizeof(struct talus_label)
  const char* name;    ///< short: lists of runs show it
  const char* title;   ///< one line; null: the name
  const char* engine;  ///< that simulates it
  double dt;           ///< of its usual step [s], in which a record counts its time; 0: 1/60
  double frame_rate;   ///< frames of a record in a second of simulated time; 0: 30
};

/// A fault that no correct engine shows.
struct talus_warning {
  const char* kind;   ///< "passed", "overlap" or "outside_world"
  talus_handle body;  ///< the first that shows it
  double value;       ///< way in the step [m], depth in extents, coordinate [m]
  const char* text;   ///< one line, with numbers of bodies: talus_handle_of()
};
/// Called with the `context` given to talus_watch(). The warning lives until it returns.
typedef void (*talus_report)(const struct talus_warning* warning, void* context);

/// The reason of the last refused call in this thread. It lives until the next one.
TALUS_API const char* talus_message(void);
/// Name of the cause of a talus_change; "unknown" for a number that is none.
TALUS_API const char* talus_cause_name(int cause);

/// Options with gravity 9.81 m/s^2 along -z, in 2D along -y. talus_create() checks the dimension.
TALUS_API struct talus_options talus_default_options(int dimension);
/// Makes a sleeper without bodies. TALUS_BAD_VALUE: an option is outside of its range.
TALUS_API int talus_create(const struct talus_options* options, talus_sleeper** created);
/// Ends a sleeper; of a null pointer it does nothing.
TALUS_API void talus_destroy(talus_sleeper* sleeper);

/// A uniform box of edges `size` [m]; in 2D a rectangle.
TALUS_API int talus_box(const talus_sleeper* sleeper, double mass, const double size[3], struct talus_body* body);
/// A uniform ball; in 2D a disc.
TALUS_API int talus_ball(const talus_sleeper* sleeper, double mass, double radius, struct talus_body* body);
/// The uniform convex hull of `corners` [m], `count` points of 3 numbers, in 2D of 2. The body's axes begin at its
/// centre of mass, body->centre. The corners must be there until talus_add() has read them.
TALUS_API int talus_convex(const talus_sleeper* sleeper, double mass, const double* corners, size_t count,
                           struct talus_body* body);

/// Adds a body, awake, and writes its handle to `added`.
TALUS_API int talus_add(talus_sleeper* sleeper, const struct talus_body* body, talus_handle* added);
/// Takes a body out. Sleeping bodies near it wake, since it may have supported them.
TALUS_API int talus_remove(talus_sleeper* sleeper, talus_handle body, struct talus_changes* changes);
/// The bodies whose states talus_after_step() needs: those awake and the kinematic ones. The array lives until the next
/// call.
TALUS_API int talus_followed(talus_sleeper* sleeper, const talus_handle** bodies, size_t* count);
/// One decision. Call it after each step of the engine, substeps too.
TALUS_API int talus_after_step(talus_sleeper* sleeper, const struct talus_step* step, struct talus_changes* changes);
/// Before something acts on a body: a force, a new velocity. Without effect on an awake one.
TALUS_API int talus_wake(talus_sleeper* sleeper, talus_handle body, struct talus_changes* changes);
/// Wakes all that sleep.
TALUS_API int talus_wake_all(talus_sleeper* sleeper, struct talus_changes* changes);
/// Wakes what sleeps near a box with these corners [m]: where something that is no body of the sleeper came or went.
TALUS_API int talus_wake_near(talus_sleeper* sleeper, const double low[3], const double high[3],
                              struct talus_changes* changes);
/// After the program has put a body elsewhere: it wakes, with the bodies near its old and its new place.
TALUS_API int talus_moved(talus_sleeper* sleeper, talus_handle body, const double position[3], const double rotation[4],
                          struct talus_changes* changes);
/// From the next step on [m/s^2]. If it differs from before by more than a hundredth, all bodies wake.
TALUS_API int talus_set_gravity(talus_sleeper* sleeper, const double gravity[3], struct talus_changes* changes);
/// Gives what a saved program must keep of each body. The array lives until the next call.
TALUS_API int talus_snapshot(talus_sleeper* sleeper, const struct talus_saved** saved, size_t* count);
/// Puts to sleep again what slept, and wakes all others. The bodies must be in their saved places: entry i of `states`
/// has that of saved[i]; its velocity means nothing. A program that has added its bodies again replaces their handles.
TALUS_API int talus_restore(talus_sleeper* sleeper, const struct talus_saved* saved, const struct talus_state* states,
                            size_t count, struct talus_changes* changes);
/// Records each step from now on in a file, which is replaced, for `talus view`, `film`, `export` and `compare`.
/// Its bodies have numbers: talus_handle_of(). `label` may be null.
TALUS_API int talus_record(talus_sleeper* sleeper, const char* path, const struct talus_label* label);
/// Shows each step from now on to `talus monitor` and `talus view --live`. `label` may be null.
TALUS_API int talus_publish(talus_sleeper* sleeper, const struct talus_label* label);
/// Calls `report` within the step in which a kind of fault is seen for the first time: bodies that pass through each
/// other, overlap deeply or leave the range of positions. Within it the sleeper refuses all that would change
/// something.
TALUS_API int talus_watch(talus_sleeper* sleeper, talus_report report, void* context);
/// What observers see of a body, in its axes; of body 0: one more thing that never moves, in the world's axes.
/// Decisions take the body's box alone.
TALUS_API int talus_show(talus_sleeper* sleeper, talus_handle body, const struct talus_piece* pieces, size_t count);
/// Ends record, live view and watch; else talus_destroy() does, without a word on what fails.
TALUS_API int talus_end_observers(talus_sleeper* sleeper);

/// Writes 1 to `asleep` if a body sleeps, else 0.
TALUS_API int talus_asleep(const talus_sleeper* sleeper, talus_handle body, int* asleep);

/// Writes the handle of the body that has this number in records and warnings to `body`. TALUS_BAD_VALUE: no body that
/// is there has it; kinematic ones have none. Numbers of removed bodies are used again.
TALUS_API int talus_handle_of(const talus_sleeper* sleeper, int number, talus_handle* body);

#ifdef __cplusplus
}
#endif

#endif
