#include "tools/serve/hand_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

std::int64_t number_of(const Json& command, const char* key) {
  const Json value = command.value(key, Json());
  if (!value.is_number_integer()) throw std::invalid_argument(fmt::format("{}: must be a whole number", key));
  return value.get<std::int64_t>();
}

std::vector<double> vector_of(const Json& command, const char* key) {
  const Json value = command.value(key, Json());
  const auto is_number = [](const Json& part) { return part.is_number(); };
  if (!value.is_array() || !std::ranges::all_of(value, is_number))
    throw std::invalid_argument(fmt::format("{}: must be a list of numbers", key));
  return value.get<std::vector<double>>();
}

HandCommand kick(const Json& command) {
  return [body = number_of(command, "body"), velocity = vector_of(command, "velocity")](ShownRun& run) {
    return run.kick(body, velocity);
  };
}

HandCommand remove(const Json& command) {
  return [body = number_of(command, "body")](ShownRun& run) { return run.remove(body); };
}

HandCommand pull(const Json& command) {
  return [body = number_of(command, "body"), point = vector_of(command, "point"),
          to = vector_of(command, "to")](ShownRun& run) { return run.pull(body, point, to); };
}

HandCommand release(const Json& /*command*/) {
  return [](ShownRun& run) {
    run.release();
    return std::string();
  };
}

HandCommand add(const Json& command) {
  const Json shape = command.value("shape", Json());
  if (!shape.is_string()) throw std::invalid_argument("shape: must be the name of a shape");
  return [shape = shape.get<std::string>(), position = vector_of(command, "position")](ShownRun& run) {
    return run.add(shape, position);
  };
}

HandCommand cut(const Json& command) {
  return [obstacle = number_of(command, "obstacle")](ShownRun& run) { return run.cut(obstacle); };
}

struct Kind {
  const char* name;
  HandCommand (*read)(const Json&);
};

constexpr auto hand_commands = std::to_array<Kind>(
    {{"kick", kick}, {"remove", remove}, {"pull", pull}, {"release", release}, {"add", add}, {"cut", cut}});

}  // namespace

std::vector<std::string> hand_command_names() {
  std::vector<std::string> names;
  for (const Kind& kind : hand_commands) names.emplace_back(kind.name);
  return names;
}

bool is_hand_command(const std::string& name) {
  return std::ranges::any_of(hand_commands, [&](const Kind& kind) { return kind.name == name; });
}

HandCommand read_hand_command(const Json& command) {
  const auto kind = std::ranges::find(hand_commands, command.at("do").get<std::string>(), &Kind::name);
  return kind->read(command);
}

}  // namespace talus
