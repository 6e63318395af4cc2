/* Sleep body by body for any physics engine, in C: what common/sleeper/pile_sleeper.h is in C++, with its rules.
 *
 * Lengths in m, masses in kg, times in s, in the program's own axes. In 2D the third number of a vector and of a spin
 * means nothing, but the third of `spin` is the angular velocity, and `rotation[0]` is the angle in radians.
 * A struct begins with its size, which the program sets: {.size = sizeof(struct talus_options)}. Every function returns
 * TALUS_OK or another code, and then talus_message() has the reason; a refused call changes nothing. A sleeper is used
 * by one thread at a time. */
#ifndef TALUS_TALUS_H
#define TALUS_TALUS_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define TALUS_API __attribute__((visibility("default")))
#else
#define TALUS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef struct talus_sleeper talus_sleeper;

/* Names a body until it is removed; 0 names none, and in a contact stands for all that never moves. */
typedef uint64_t talus_handle;

enum talus_result {
  TALUS_OK = 0,
  TALUS_BAD_VALUE = 1, /* an argument is outside of its range */
  TALUS_FAILED = 2     /* memory is short, or talus has a bug */
};

enum talus_role { TALUS_SLEEPS = 0, TALUS_STAYS_AWAKE = 1, TALUS_KINEMATIC = 2 };
enum talus_up {
  TALUS_UP_X,
  TALUS_UP_Y,
  TALUS_UP_Z,
  TALUS_UP_MINUS_X,
  TALUS_UP_MINUS_Y,
  TALUS_UP_MINUS_Z,
  TALUS_UP_AUTO
};

/* talus_default_options() has the defaults. */
struct talus_options {
  size_t size;
  int dimension;     /* 2 or 3 */
  double gravity[3]; /* [m/s^2] */
  int enabled;       /* 0: nothing sleeps */
  int up;            /* enum talus_up; TALUS_UP_AUTO: the axis nearest to the opposite of gravity */
  double extent;     /* diagonal of a typical body's box [m]; 0: found from the bodies */
  double tolerance;  /* of stability checks, in extents; 0: none */
};

/* A body and where it is. talus_box(), talus_ball() and talus_convex() fill in all from `mass` to `high`. */
struct talus_body {
  size_t size;
  int role;           /* enum talus_role */
  double mass;        /* [kg]; of a kinematic body it means nothing */
  double inertia[9];  /* about the centre of mass, in the body's axes, row by row [kg m^2]; in 2D the first number */
  double low[3];      /* lower corner of its box in the body's axes, around the centre of mass [m] */
  double high[3];     /* upper corner */
  double friction;    /* against a body like it */
  double position[3]; /* of the centre of mass [m] */
  double rotation[4]; /* unit quaternion x, y, z, w */
};

struct talus_state {
  double position[3]; /* of the centre of mass [m] */
  double rotation[4]; /* unit quaternion x, y, z, w */
  double velocity[3]; /* of the centre of mass [m/s] */
  double spin[3];     /* [rad/s] */
};

struct talus_contact {
  talus_handle a;
  talus_handle b;
  double point[3];            /* [m] */
  double normal[3];           /* unit, from b to a */
  double normal_impulse;      /* over the step [N s] */
  double friction_impulse[3]; /* over the step, on a [N s] */
  double approach_speed;      /* before the step, >= 0 [m/s] */
  double depth;               /* positive where they overlap [m] */
};

/* The result of one step of the engine, with each of talus_followed() once. */
struct talus_step {
  size_t size;
  double dt; /* [s] */
  size_t body_count;
  const talus_handle* bodies;
  const struct talus_state* states; /* of the bodies, in their order */
  size_t contact_count;
  const struct talus_contact* contacts;
};

struct talus_change {
  talus_handle body;
  int cause; /* talus_cause_name() has its name */
};
struct talus_velocity {
  talus_handle body;
  double velocity[3]; /* [m/s] */
  double spin[3];     /* [rad/s] */
};
/* What a saved program must keep of a body that is not kinematic. */
struct talus_saved {
  talus_handle body;
  int asleep;
  int settled; /* asleep, and no stability check is to come */
};
/* What the program must do in its engine at once, in this order. The arrays live until the next call. */
struct talus_changes {
  size_t size;
  size_t thaw_count;
  const struct talus_change* thaw;
  size_t velocity_count;
  const struct talus_velocity* velocities;
  size_t freeze_count;
  const struct talus_change* freeze;
};

/* Of the last call in this thread that was refused. */
TALUS_API const char* talus_message(void);
TALUS_API const char* talus_cause_name(int cause);

TALUS_API struct talus_options talus_default_options(int dimension);
TALUS_API int talus_create(const struct talus_options* options, talus_sleeper** created);
TALUS_API void talus_destroy(talus_sleeper* sleeper);

/* Uniform bodies; in 2D a rectangle, a disc, a convex polygon. `corners`: `count` points of 3 numbers, in 2D of 2, from
 * which the centre of mass is taken off: it is written to `centre`. */
TALUS_API int talus_box(const talus_sleeper* sleeper, double mass, const double size[3], struct talus_body* body);
TALUS_API int talus_ball(const talus_sleeper* sleeper, double mass, double radius, struct talus_body* body);
TALUS_API int talus_convex(const talus_sleeper* sleeper, double mass, const double* corners, size_t count,
                           struct talus_body* body, double centre[3]);

TALUS_API int talus_add(talus_sleeper* sleeper, const struct talus_body* body, talus_handle* added);
TALUS_API int talus_remove(talus_sleeper* sleeper, talus_handle body, struct talus_changes* changes);
/* The bodies whose states talus_after_step() needs. The array lives until the next call. */
TALUS_API int talus_followed(talus_sleeper* sleeper, const talus_handle** bodies, size_t* count);
TALUS_API int talus_after_step(talus_sleeper* sleeper, const struct talus_step* step, struct talus_changes* changes);
TALUS_API int talus_wake(talus_sleeper* sleeper, talus_handle body, struct talus_changes* changes);
TALUS_API int talus_wake_all(talus_sleeper* sleeper, struct talus_changes* changes);
TALUS_API int talus_wake_near(talus_sleeper* sleeper, const double low[3], const double high[3],
                              struct talus_changes* changes);
TALUS_API int talus_moved(talus_sleeper* sleeper, talus_handle body, const double position[3], const double rotation[4],
                          struct talus_changes* changes);
TALUS_API int talus_set_gravity(talus_sleeper* sleeper, const double gravity[3], struct talus_changes* changes);
/* The array lives until the next call. */
TALUS_API int talus_snapshot(talus_sleeper* sleeper, const struct talus_saved** saved, size_t* count);
/* Puts to sleep again what slept, and wakes all others. The bodies must be in their saved places: entry i of `states`
 * has that of saved[i]; its velocity means nothing. A program that has added its bodies again replaces their handles.
 */
TALUS_API int talus_restore(talus_sleeper* sleeper, const struct talus_saved* saved, const struct talus_state* states,
                            size_t count, struct talus_changes* changes);
TALUS_API int talus_asleep(const talus_sleeper* sleeper, talus_handle body, int* asleep);

#ifdef __cplusplus
}
#endif

#endif
