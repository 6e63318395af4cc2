// What a search with libFuzzer does differently from a replay.
#include <functional>

#include "tests/fuzz/fuzz_target.h"

bool talus::fuzz::costly_part_is_due(std::string_view input) { return std::hash<std::string_view>()(input) % 8 == 0; }
