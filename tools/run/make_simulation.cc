#include "tools/run/make_simulation.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "common/scene/warnings.h"
#include "common/scene/window.h"
#include "common/simulation/make_policy.h"
#include "tools/output/output.h"
#include "tools/run/backends.h"

namespace talus {
namespace {

/// Memory that the process may have at most [bytes].
double memory() {
  const double installed = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return installed;
  return std::min(installed, static_cast<double>(limit.rlim_cur));
}

template <int Dim>
void check_memory(const Scene<Dim>& scene, const std::string& backend) {
  const double need = demand(scene, engine_traits<Dim>(backend)).bytes;
  if (need <= memory()) return;
  throw std::invalid_argument(
      fmt::format("source: must drop fewer bodies: on {} they take about {:.3g} GB, of which there are {:.3g}", backend,
                  need * 1e-9, memory() * 1e-9));
}

/// Upper bound of the magnitudes that gravity has after events and by plan [m/s^2]. A turn changes none, and between
/// two corners of a path or within a sine it is no larger than at the ends.
template <int Dim>
double largest_gravity(const Scene<Dim>& scene) {
  std::vector<Vec<Dim>> still = {scene.world.gravity_vector()};
  for (const Event<Dim>& event : scene.events)
    if (event.action == EventAction::gravity) still.push_back(event.gravity);
  const Motion<Dim> plan = scene.gravity_motion.value_or(Motion<Dim>());
  std::vector<Vec<Dim>> shifts = plan.shifts;
  if (shifts.empty()) shifts.push_back(Vec<Dim>::Zero());
  double largest = 0.0;
  for (const Vec<Dim>& gravity : still)
    for (const Vec<Dim>& shift : shifts)
      for (const double sine : {-1.0, 1.0})
        largest = std::max(largest, (gravity + shift + sine * plan.amplitude).norm());
  return largest;
}

/// What an engine demands of gravity holds for all that it becomes.
template <int Dim>
void check_gravity(const Scene<Dim>& scene, const std::string& backend) {
  WorldDescription<Dim> heaviest = scene.world;
  heaviest.gravity = largest_gravity(scene);
  if (heaviest.gravity <= scene.world.gravity) return;
  heaviest.obstacles.clear();
  try {
    make_world<Dim>(backend, heaviest);
  } catch (const std::invalid_argument& refusal) {
    throw std::invalid_argument(fmt::format("gravity changes by plan or event: {}", refusal.what()));
  }
}

}  // namespace

template <int Dim>
Simulation<Dim> make_simulation(const Scene<Dim>& scene, const std::string& backend) {
  check_memory(scene, backend);
  check_gravity(scene, backend);
  return Simulation<Dim>(scene, make_world<Dim>(backend, scene.world), make_policy(scene));
}

template <int Dim>
std::vector<SceneError> check_window(const Scene<Dim>& scene, const std::string& backend,
                                     const std::filesystem::path& file, bool force) {
  std::vector<SceneError> outside = outside_window(scene, engine_traits<Dim>(backend), file.string());
  if (!force) refuse_outside_window(outside);
  return outside;
}

template <int Dim>
std::vector<std::string> scene_warnings(const Scene<Dim>& scene, const std::string& backend) {
  std::vector<std::string> all = warnings(scene);
  for (const std::string& warning : engine_warnings(scene, engine_traits<Dim>(backend)))
    all.push_back(fmt::format("{}: {}", backend, warning));
  return all;
}

void print_scene_warnings(const std::vector<SceneError>& outside, const std::vector<std::string>& warnings) {
  for (const SceneError& each : outside) print_message("warning: {}{}", outside_prefix, to_string(each));
  for (const std::string& warning : warnings) print_message("warning: {}", warning);
}

template Simulation<2> make_simulation(const Scene<2>&, const std::string&);
template Simulation<3> make_simulation(const Scene<3>&, const std::string&);
template std::vector<std::string> scene_warnings(const Scene<2>&, const std::string&);
template std::vector<std::string> scene_warnings(const Scene<3>&, const std::string&);
template std::vector<SceneError> check_window(const Scene<2>&, const std::string&, const std::filesystem::path&, bool);
template std::vector<SceneError> check_window(const Scene<3>&, const std::string&, const std::filesystem::path&, bool);

}  // namespace talus
