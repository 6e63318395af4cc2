#include "tools/run/backends.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#ifdef TALUS_BOX2D
#include "sim2d/make_world.h"
#endif
#ifdef TALUS_BULLET
#include "sim3d/make_world.h"
#endif

namespace talus {
namespace {

template <int Dim>
struct Backend {
  EngineTraits traits;
  std::unique_ptr<World<Dim>> (*make)(const WorldDescription<Dim>&);
};

template <int Dim>
std::vector<Backend<Dim>> table() {
  std::vector<Backend<Dim>> list;
  if constexpr (Dim == 2) {
#ifdef TALUS_BOX2D
    list.push_back({box2d_traits(), make_box2d_world});
#endif
#ifdef TALUS_BULLET
    list.push_back({bullet_planar_traits(), make_bullet_planar_world});
#endif
  } else {
#ifdef TALUS_BULLET
    list.push_back({bullet_traits(), make_bullet_world});
#endif
  }
  return list;
}

template <int Dim>
std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const Backend<Dim>& backend : table<Dim>()) list.emplace_back(backend.traits.name);
  return list;
}

template <int Dim>
Backend<Dim> find_backend(std::string_view name) {
  for (const Backend<Dim>& known : table<Dim>())
    if (known.traits.name == name) return known;
  throw std::invalid_argument(fmt::format(
      "--backend = {}: must be {} for a scene in {}D", name,
      names<Dim>().empty() ? "built in, as no engine is," : fmt::format("{}", fmt::join(names<Dim>(), " or ")), Dim));
}

}  // namespace

std::vector<std::string> backends(int dimension) { return dimension == 2 ? names<2>() : names<3>(); }

std::string backend_for(const std::string& name, int dimension) {
  const std::vector<std::string> engines = backends(dimension);
  return name.empty() && !engines.empty() ? engines.front() : name;
}

template <int Dim>
EngineTraits engine_traits(std::string_view backend) {
  return find_backend<Dim>(backend).traits;
}

template <int Dim>
std::unique_ptr<World<Dim>> make_world(std::string_view backend, const WorldDescription<Dim>& description) {
  return find_backend<Dim>(backend).make(description);
}

template <int Dim>
WorldMaker<Dim> world_maker(const std::string& backend) {
  return [backend](const WorldDescription<Dim>& description) { return make_world<Dim>(backend, description); };
}

template EngineTraits engine_traits<2>(std::string_view);
template EngineTraits engine_traits<3>(std::string_view);
template std::unique_ptr<World<2>> make_world(std::string_view, const WorldDescription<2>&);
template std::unique_ptr<World<3>> make_world(std::string_view, const WorldDescription<3>&);
template WorldMaker<2> world_maker(const std::string&);
template WorldMaker<3> world_maker(const std::string&);

}  // namespace talus
