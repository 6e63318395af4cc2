#pragma once
// Data of a run that the browser page gets before its first frame.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "common/math/vector.h"
#include "common/scene/scene.h"
#include "tools/view/frame_stream.h"

namespace talus {

/// Texts and numbers that the scene does not have.
struct RunTexts {
  std::string name;     // of the run folder or scene file
  std::string backend;  // engine
  std::string policy;
  std::string version;  // of talus that made the run
  std::uint64_t seed = 1;
  std::string reason = {};  // why the run ended; empty: it has not, or was killed
  std::string damage = {};  // what of the record cannot be shown; empty: nothing is missing
};

/// Scene, shapes, obstacles, colours and camera of the pictures. `box`: what is to be seen at first [m].
template <int Dim>
nlohmann::ordered_json run_head(const Scene<Dim>& scene, const RunTexts& texts, const Quantum& quantum,
                                const Box<Dim>& box);

/// What a scene without bodies shows: its obstacles, sources and first bodies, and the origin.
template <int Dim>
Box<Dim> box_of(const Scene<Dim>& scene);

}  // namespace talus
