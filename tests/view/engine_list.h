#pragma once
// Tests of `talus view SCENE` that run on each engine of the build, in each dimension that it simulates.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tools/run/backends.h"

namespace talus {

/// Dimension, and name of the engine.
using EngineChoice = std::pair<int, std::string>;

inline std::vector<EngineChoice> all_engines() {
  std::vector<EngineChoice> engines;
  for (const int dimension : {2, 3})
    for (const std::string& name : backends(dimension)) engines.emplace_back(dimension, name);
  return engines;
}

inline std::string name_of_engine(const ::testing::TestParamInfo<EngineChoice>& engine) {
  std::string name = engine.param.second + "_in_" + std::to_string(engine.param.first) + "D";
  std::ranges::replace_if(
      name, [](char c) { return c == '-'; }, '_');
  return name;
}

}  // namespace talus
