/* A sleeper in C, with an engine of a few lines: balls that fall on a floor and stay there. */
#include <stdio.h>
#include <talus/talus.h>

enum { balls = 20, steps = 240 };

static const double dt = 1.0 / 60.0;

int main(void) {
  talus_sleeper* sleeper = NULL;
  const struct talus_options options = talus_default_options(3);
  if (talus_create(&options, &sleeper) != TALUS_OK) return fprintf(stderr, "%s\n", talus_message());

  talus_handle handles[balls];
  struct talus_state states[balls] = {0};
  int frozen[balls] = {0};
  for (int i = 0; i < balls; ++i) {
    struct talus_body body = {.size = sizeof body, .friction = 0.5, .rotation = {0, 0, 0, 1}};
    talus_ball(sleeper, 1.0, 0.5, &body);
    body.position[0] = states[i].position[0] = 2.0 * i;
    body.position[2] = states[i].position[2] = 1.0 + 0.2 * i;
    states[i].rotation[3] = 1.0;
    if (talus_add(sleeper, &body, &handles[i]) != TALUS_OK) return fprintf(stderr, "%s\n", talus_message());
  }

  for (int step = 0; step < steps; ++step) {
    talus_handle awake[balls];
    struct talus_state given[balls];
    struct talus_contact contacts[balls];
    size_t count = 0;
    size_t touching = 0;
    for (int i = 0; i < balls; ++i) {
      if (frozen[i]) continue;
      struct talus_state* ball = &states[i];
      ball->velocity[2] -= 9.81 * dt;
      ball->position[2] += dt * ball->velocity[2];
      if (ball->position[2] < 0.5) {
        contacts[touching++] = (struct talus_contact){.a = handles[i],
                                                      .point = {ball->position[0], 0, 0},
                                                      .normal = {0, 0, 1},
                                                      .normal_impulse = -ball->velocity[2],
                                                      .approach_speed = -ball->velocity[2]};
        ball->position[2] = 0.5;
        ball->velocity[2] = 0.0;
      }
      awake[count] = handles[i];
      given[count++] = *ball;
    }
    const struct talus_step result = {.size = sizeof result,
                                      .dt = dt,
                                      .body_count = count,
                                      .bodies = awake,
                                      .states = given,
                                      .contact_count = touching,
                                      .contacts = contacts};
    struct talus_changes changes = {.size = sizeof changes};
    if (talus_after_step(sleeper, &result, &changes) != TALUS_OK) return fprintf(stderr, "%s\n", talus_message());
    for (size_t k = 0; k < changes.freeze_count; ++k)
      for (int i = 0; i < balls; ++i)
        if (handles[i] == changes.freeze[k].body) frozen[i] = 1;
  }
  int asleep = 0;
  for (int i = 0; i < balls; ++i) asleep += frozen[i];
  printf("%d balls, %d asleep\n", balls, asleep);
  talus_destroy(sleeper);
  return 0;
}
