#include "tools/serve/run_loop.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "common/world/stopwatch.h"
#include "common/world/world.h"
#include "tools/output/json_text.h"
#include "tools/output/output.h"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto note_interval = std::chrono::milliseconds(500);
constexpr auto shortest_idle = std::chrono::milliseconds(10);  // in which a state is worth showing
constexpr auto longest_lag = std::chrono::milliseconds(250);   // that a slow run makes up for

Json error_of(const std::string& text) { return Json::array({{{"line", 0}, {"column", 0}, {"text", text}}}); }

Json errors_of(const SceneErrors& errors) {
  Json list = Json::array();
  for (const SceneError& error : errors.errors())
    list.push_back({{"line", error.line}, {"column", error.column}, {"text", to_string(error)}});
  return list;
}

const std::string& policy_of(const AnyScene& scene) {
  return std::visit([](const auto& of_dimension) -> const std::string& { return of_dimension.policy.kind; }, scene);
}

}  // namespace

RunLoop::RunLoop(const RunChoice& choice, PageHub& hub)
    : hub_(hub),
      file_(choice.file),
      backend_(choice.backend),
      force_(choice.force),
      scene_(read_scene(choice.file, choice.overrides)),
      pace_(choice.pace) {
  text_ = toml_of(scene_);
  run_ = show_run(scene_, backend_, file_, force_);
  begin_run();
  hub_.set_status(status());
  thread_ = std::thread([this] { work(); });
}

RunLoop::~RunLoop() {
  change([this] { stop_ = true; });
  thread_.join();
}

void RunLoop::change(const std::function<void()>& what) {
  const std::lock_guard lock(mutex_);
  what();
  hub_.set_status(status());
  changed_.notify_all();
}

void RunLoop::greet(int page) {
  change([&] {
    if (!std::exchange(greeted_, true)) running_ = true;
    hub_.reply(page, json_text({{"kind", "scene"}, {"text", text_}}));
  });
}

void RunLoop::leave(int page) {
  queue_by_hand(page, [this, page, release = read_hand_command({{"do", "release"}})](ShownRun& run) {
    return pulling_ == page ? release(run) : std::string();
  });
}

void RunLoop::command(int page, const std::string& text) {
  const Json command = Json::parse(text, nullptr, false);
  if (!command.is_object() || !command.contains("do") || !command["do"].is_string()) {
    reply_errors(page, error_of("a command must be an object with a text \"do\""));
    return;
  }
  const std::string what = command["do"].get<std::string>();
  try {
    if (is_hand_command(what))
      queue_by_hand(page, [this, page, what, act = read_hand_command(command)](ShownRun& run) {
        std::string wrong = act(run);
        if (what == "pull" && wrong.empty()) pulling_ = page;
        return wrong;
      });
    else
      obey(page, what, command);
  } catch (const std::invalid_argument& error) {
    reply_errors(page, error_of(fmt::format("{}: {}", what, error.what())));
  }
}

void RunLoop::obey(int page, const std::string& what, const Json& command) {
  const Json value = command.value("value", Json());
  if (what == "run") {
    change([this] {
      if (finished_ || !reason_.empty()) restart_ = true;
      running_ = true;
    });
  } else if (what == "pause") {
    change([this] { running_ = false; });
  } else if (what == "step") {
    change([this] {
      running_ = false;
      single_steps_ = std::min(single_steps_ + 1, 1000);
    });
  } else if (what == "restart") {
    change([this] { restart_ = true; });
  } else if (what == "contacts" && value.is_boolean()) {
    hub_.want_contacts(page, value.get<bool>());
    queue_by_hand(page, [this](ShownRun& run) {
      run.show_contacts(hub_.contacts_wanted());
      return std::string();
    });
  } else if (what == "choose" && command.value("body", Json()).is_number_integer()) {
    hub_.choose_body(page, command["body"].get<std::int64_t>());
    queue_by_hand(page, [](ShownRun&) { return std::string(); });  // so that the page gets a frame with the account
  } else if (what == "save") {
    queue_by_hand(page, [this, page](ShownRun& run) { return save(page, run); });
  } else if (what == "pace") {
    set_pace(page, value);
  } else if (what == "policy" && value.is_string()) {
    std::string text;  // another page's thread may replace it
    change([&] { text = text_; });
    start_scene(page, text, value.get<std::string>());
  } else if (what == "scene" && command.value("text", Json()).is_string()) {
    start_scene(page, command["text"].get<std::string>(), "");
  } else {
    throw std::invalid_argument(fmt::format(
        "\"do\" must be run, pause, step, restart, pace, policy, scene, save, contacts, choose, {}, with its value",
        fmt::join(hand_command_names(), ", ")));
  }
}

void RunLoop::queue_by_hand(int page, const HandCommand& command) {
  constexpr std::size_t most = 1000;  // that wait
  change([&] {
    if (by_hand_.size() < most) by_hand_.push_back({page, command});
  });
}

void RunLoop::do_by_hand() {
  std::vector<ByHand> all;
  {
    const std::lock_guard lock(mutex_);
    all.swap(by_hand_);
  }
  for (const ByHand& each : all) {
    const std::string wrong = run_ ? each.command(*run_) : "no run goes on";
    reply_errors(each.page, wrong.empty() ? Json::array() : error_of(wrong));
  }
  published_ = false;
}

/// Sends a page the present state as a scene file.
std::string RunLoop::save(int page, const ShownRun& run) {
  try {
    hub_.reply(page, json_text({{"kind", "saved"}, {"name", file_.stem().string()}, {"text", run.saved()}}));
    return {};
  } catch (const std::invalid_argument& error) {
    return fmt::format("save: {}", error.what());
  }
}

void RunLoop::set_pace(int page, const Json& value) {
  const double pace = value.is_number() ? value.get<double>() : NAN;
  if (pace == 0.0 || (pace >= slowest_pace && pace <= fastest_pace))
    change([&] { pace_ = pace; });
  else
    reply_errors(
        page, error_of(fmt::format("pace: must be 0 (as fast as possible) or {} to {}", slowest_pace, fastest_pace)));
}

/// Reads the scene in the page's thread, so that the run goes on meanwhile.
void RunLoop::start_scene(int page, const std::string& text, const std::string& policy) {
  const bool of_text = policy.empty();
  try {
    std::vector<Override> overrides;
    if (!of_text) overrides.push_back({"policy.kind=" + policy, "policy " + policy});
    AnyScene scene = parse_scene(text, file_.string(), overrides);
    change([&] {
      scene_ = std::move(scene);
      text_ = text;
      policy_ = policy;
      restart_ = true;
      running_ = true;
    });
    reply_errors(page, Json::array(), of_text);
  } catch (const SceneErrors& errors) {
    reply_errors(page, errors_of(errors), of_text);
  } catch (const std::exception& error) {
    reply_errors(page, error_of(error.what()), of_text);
  }
}

void RunLoop::reply_errors(int page, const Json& errors, bool of_text) {
  hub_.reply(page, json_text({{"kind", "errors"}, {"of_text", of_text}, {"errors", errors}}));
}

void RunLoop::work() {
  for (;;) {
    switch (next_task()) {
      case Task::stop:
        return;
      case Task::start:
        start();
        break;
      case Task::step:
        step();
        break;
      case Task::by_hand:
        do_by_hand();
        break;
    }
  }
}

/// Waits until there is something to do.
RunLoop::Task RunLoop::next_task() {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stop_) return Task::stop;
    if (std::exchange(restart_, false)) return Task::start;
    if (!by_hand_.empty()) return Task::by_hand;
    if (can_step() && single_steps_ > 0) {
      --single_steps_;
      return Task::step;
    }
    single_steps_ = 0;
    const bool goes = running_ && can_step();
    if (goes && (pace_ == 0.0 || Clock::now() >= due_)) return Task::step;
    const bool idle = !goes || (hub_.pages() > 0 && (hub_.wanted() || due_ - Clock::now() > shortest_idle));
    if (!published_ && run_ && idle) publish();
    if (goes)
      changed_.wait_until(lock, due_);
    else
      changed_.wait(lock);
  }
}

void RunLoop::start() {
  AnyScene scene;
  {
    const std::lock_guard lock(mutex_);
    scene = scene_;
  }
  std::string reason;
  steps_of_run_ = 0;
  seconds_of_run_ = 0.0;
  run_.reset();
  try {
    run_ = show_run(scene, backend_, file_, force_);
    begin_run();
  } catch (const std::exception& error) {
    reason = error.what();
  }
  due_ = Clock::now();
  change([&] {
    finished_ = at_rest_ = false;
    reason_ = reason;
  });
}

void RunLoop::step() {
  Stopwatch watch;
  std::string reason;
  try {
    run_->show_contacts(hub_.contacts_wanted());
    run_->step();
  } catch (const NonFiniteState& error) {
    reason = error.what();
  }
  const double seconds = watch.lap();
  seconds_in_steps_ += seconds;
  seconds_of_run_ += seconds;
  ++steps_since_;
  ++steps_of_run_;
  published_ = !reason.empty();
  if (run_->finished() && reason.empty()) probe_drift();
  if (!published_ && (hub_.wanted() || run_->is_output() || run_->finished())) publish();
  if (run_->finished() || !reason.empty()) {
    change([&] {
      running_ = false;
      finished_ = run_->finished();
      at_rest_ = run_->at_rest();
      reason_ = reason;
    });
  }
  note_speed();
}

void RunLoop::probe_drift() {
  const auto stop = [this] {
    const std::lock_guard lock(mutex_);
    return stop_ || restart_ || !by_hand_.empty();
  };
  try {
    run_->probe_drift(stop);
  } catch (const std::exception& error) {  // of the copy: the run itself is whole
    print_message("warning: no drift probe: {}", error.what());
  }
}

void RunLoop::begin_run() {
  hub_.begin(run_->beginning());
  publish();
}

void RunLoop::publish() {
  for (const auto& [page, body] : hub_.chosen_bodies()) hub_.set_account(page, run_->account(body));
  hub_.publish(run_->frame());
  published_ = true;
}

/// When the next step is due, and how fast the steps were.
void RunLoop::note_speed() {
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  if (pace_ > 0.0) {
    due_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(run_->dt() / pace_));
    due_ = std::max(due_, now - longest_lag);
  } else {
    due_ = now;
  }
  if (now - noted_ < note_interval) return;
  const double passed = std::chrono::duration<double>(now - noted_).count();
  ms_per_step_ = 1e3 * seconds_in_steps_ / static_cast<double>(steps_since_);
  mean_ms_per_step_ = 1e3 * seconds_of_run_ / static_cast<double>(std::max<std::int64_t>(1, steps_of_run_));
  real_time_factor_ = static_cast<double>(steps_since_) * run_->dt() / passed;
  noted_ = now;
  steps_since_ = 0;
  seconds_in_steps_ = 0.0;
  hub_.set_status(status());
}

std::string RunLoop::status() const {
  return json_text({{"kind", "status"},
                    {"running", running_},
                    {"finished", finished_},
                    {"at_rest", at_rest_},
                    {"reason", reason_},
                    {"pace", pace_},
                    {"policy", policy_.empty() ? policy_of(scene_) : policy_},
                    {"policies", policy_kinds},
                    {"step", steps_of_run_},
                    {"ms_per_step", ms_per_step_},
                    {"mean_ms_per_step", mean_ms_per_step_},
                    {"real_time_factor", real_time_factor_}});
}

}  // namespace talus
