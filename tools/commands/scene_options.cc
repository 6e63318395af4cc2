#include "tools/commands/scene_options.h"

#include "tools/commands/validators.h"

namespace talus {

void add_scene_options(CLI::App& command, SceneChoice& choice) {
  command.add_option("scene", choice.scene, "Scene file, or the name of a scene that `talus list` shows")
      ->required()
      ->check(not_empty());
  add_setting_options(command, choice);
}

void add_setting_options(CLI::App& command, SceneChoice& choice) {
  command.add_option("-b,--backend", choice.backend, "Engine: box2d or bullet-planar in 2D, bullet in 3D")
      ->check(not_empty());
  command
      .add_option("-p,--policy", choice.policy,
                  "Which bodies may sleep: full (none), engine (the engine's own rule), paper, adaptive")
      ->check(not_empty());
  command
      .add_option("-a,--accuracy", choice.accuracy,
                  "fast, standard, fine, or the relative error that is accepted, as 0.05: sets the step, sub-steps and "
                  "tolerance that the scene leaves open")
      ->check(not_empty());
  command.add_option("-s,--set", choice.settings, "Replace a value of the scene, as policy.tau=0.4; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  command.add_option("--seed", choice.seed, "Seed of all that is random in the scene, 0 or more")
      ->check(whole_number());
  command.add_flag("-f,--force", choice.force,
                   "Also outside of the window in which results hold: a warning instead of an error");
}

}  // namespace talus
