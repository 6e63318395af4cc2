#include "common/policy/sleep_event.h"

namespace talus {

std::string_view to_string(SleepCause cause) {
  switch (cause) {
    case SleepCause::score:
      return "score";
    case SleepCause::rest:
      return "rest";
    case SleepCause::avalanche:
      return "avalanche";
    case SleepCause::momentum:
      return "momentum";
    case SleepCause::lost_support:
      return "lost support";
    case SleepCause::engine:
      return "engine";
    case SleepCause::user:
      return "user";
    case SleepCause::check:
      return "check";
    case SleepCause::motion:
      return "motion";
  }
  return "unknown";
}

std::vector<std::string> cause_names() {
  std::vector<std::string> names;
  for (int cause = 0; cause <= last_cause; ++cause) names.emplace_back(to_string(static_cast<SleepCause>(cause)));
  return names;
}

}  // namespace talus
