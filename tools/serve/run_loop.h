#pragma once
// A simulation that pages steer.

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "common/scene/read_scene.h"
#include "tools/serve/hand_command.h"
#include "tools/serve/page_hub.h"
#include "tools/serve/shown_run.h"

namespace talus {

/// What is simulated at first.
struct RunChoice {
  std::filesystem::path file;            // of the scene
  std::vector<Override> overrides = {};  // values that replace the scene's
  std::string backend;                   // empty: the first engine that can simulate the scene
  bool force = false;                    // show it outside of the engine's window too
  double pace = 1.0;                     // simulated seconds per second, 0: as fast as possible
};

/// Simulates in a thread of its own and publishes states to the hub as fast as its pages take them. It begins to run
/// when the first page comes.
class RunLoop {
 public:
  static constexpr double fastest_pace = 1000.0;
  static constexpr double slowest_pace = 0.01;

  /// Throws SceneErrors, and what make_simulation() throws, as talus run does.
  RunLoop(const RunChoice& choice, PageHub& hub);
  ~RunLoop();
  RunLoop(const RunLoop&) = delete;
  RunLoop& operator=(const RunLoop&) = delete;

  /// A page came: it gets the scene's text.
  void greet(int page);
  /// A page has gone: what it pulls is let go.
  void leave(int page);
  /// A command of a page, as JSON: {"do": "run" (from the start where the run has ended) | "pause" | "step" |
  /// "restart"}, {"do": "pace", "value": number},
  /// {"do": "policy", "value": name}, {"do": "scene", "text": TOML}, {"do": "save"}, {"do": "contacts", "value":
  /// whether frames are to have them}, {"do": "choose", "body": number to be told of with each frame, below 0: none},
  /// or one of hand_command.h. What is wrong is replied to the page; then nothing changes.
  void command(int page, const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Task : std::uint8_t { stop, start, step, by_hand };
  /// A command, as a page sends it.
  struct ByHand {
    int page = 0;
    HandCommand command;
  };

  void obey(int page, const std::string& what, const nlohmann::ordered_json& command);
  void start_scene(int page, const std::string& text, const std::string& policy);
  void queue_by_hand(int page, const HandCommand& command);
  void do_by_hand();
  std::string save(int page, const ShownRun& run);
  void set_pace(int page, const nlohmann::ordered_json& value);
  /// `of_text`: of the scene's text that the page sent, else of a command.
  void reply_errors(int page, const nlohmann::ordered_json& errors, bool of_text = false);
  void change(const std::function<void()>& what);

  void work();
  Task next_task();
  bool can_step() const { return run_ && !run_->finished() && reason_.empty(); }
  void start();
  void step();
  void begin_run();
  void probe_drift();
  void publish();
  void note_speed();
  std::string status() const;

  PageHub& hub_;
  std::filesystem::path file_;
  std::string backend_;
  bool force_;

  // Of the loop's thread.
  std::unique_ptr<ShownRun> run_;
  bool published_ = true;  // whether the hub has the present state
  Clock::time_point due_ = Clock::now();
  Clock::time_point noted_ = Clock::now();
  std::int64_t steps_since_ = 0;   // the last note of the speed
  double seconds_in_steps_ = 0.0;  // since then
  std::int64_t steps_of_run_ = 0;
  double seconds_of_run_ = 0.0;  // in its steps
  int pulling_ = -1;             // page that pulled last

  mutable std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::string text_;    // of the scene
  std::string policy_;  // replaces the text's; empty: does not
  AnyScene scene_;
  bool restart_ = false;
  bool stop_ = false;
  bool greeted_ = false;
  bool running_ = false;
  int single_steps_ = 0;
  std::vector<ByHand> by_hand_;
  double pace_;
  bool finished_ = false;
  bool at_rest_ = false;  // finished since the world came to rest
  std::string reason_;    // why the run cannot go on; empty: it can
  double ms_per_step_ = 0.0;
  double mean_ms_per_step_ = 0.0;  // since the start of the run
  double real_time_factor_ = 0.0;
  std::thread thread_;
};

}  // namespace talus
