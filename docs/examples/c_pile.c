/* A sleeper in C, with an engine of a few lines: balls that fall on a floor and stay there.
   c_pile [RECORD]: `talus view RECORD` shows the balls, or meanwhile `talus monitor`. */
#include <stdio.h>
#include <talus/talus.h>

enum { balls = 20, steps = 240 };

static const double dt = 1.0 / 60.0;

static void print_warning(const struct talus_warning* warning, void* context) {
  fprintf((FILE*)context, "%s\n", warning->text);
}

/* A record, the live view and a watch for faults. Observers see the floor, too. */
static int observe(talus_sleeper* sleeper, const char* record) {
  const double corners[][3] = {{-1, -1, -1}, {39, -1, -1}, {39, 1, -1}, {-1, 1, -1},
                               {-1, -1, 0},  {39, -1, 0},  {39, 1, 0},  {-1, 1, 0}};
  const struct talus_piece floor = {.corners = corners[0], .count = 8};
  const struct talus_label label = {.size = sizeof label, .name = "balls", .dt = dt};
  int result = talus_show(sleeper, 0, &floor, 1);
  if (result == TALUS_OK) result = talus_record(sleeper, record, &label);
  if (result == TALUS_OK) result = talus_publish(sleeper, &label);
  if (result == TALUS_OK) result = talus_watch(sleeper, print_warning, stdout);
  return result;
}

int main(int count_of_arguments, char** arguments) {
  talus_sleeper* sleeper = NULL;
  const struct talus_options options = talus_default_options(3);
  if (talus_create(&options, &sleeper) != TALUS_OK) return fprintf(stderr, "%s\n", talus_message());
  if (count_of_arguments > 1 && observe(sleeper, arguments[1]) != TALUS_OK)
    return fprintf(stderr, "%s\n", talus_message());

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
  if (talus_end_observers(sleeper) != TALUS_OK) return fprintf(stderr, "%s\n", talus_message());
  printf("%d balls, %d asleep\n", balls, asleep);
  talus_destroy(sleeper);
  return 0;
}
