#include <arpa/inet.h>
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "common/scene/setting_differences.h"
#include "tools/commands/commands.h"
#include "tools/commands/scene_options.h"
#include "tools/commands/validators.h"
#include "tools/output/interrupt.h"
#include "tools/output/output.h"
#include "tools/record/record_file.h"
#include "tools/record/recorded_run.h"
#include "tools/run/find_scene.h"
#include "tools/run/run_files.h"
#include "tools/run/run_options.h"
#include "tools/serve/live_view.h"
#include "tools/serve/open_browser.h"
#include "tools/serve/run_loop.h"
#include "tools/serve/server.h"
#include "tools/view/page.h"

namespace talus {
namespace {

struct ViewOptions {
  SceneChoice choice;   // its scene may be a record too
  std::string other;    // a second record; empty: none
  std::string against;  // a second policy; empty: none
  double pace = 1.0;
  int port = 0;
  std::string listen = std::string(loopback);
  double seconds = 0.0;  // 0: until Ctrl-C
  bool live = false;
  std::string lcm_url;
  int history = static_cast<int>(PageHub::usual_history_bytes >> 20U);  // [MiB]
  bool open = true;                                                     // the browser of a desktop

  std::size_t history_bytes() const { return static_cast<std::size_t>(history) << 20U; }
};

/// Options of a scene that is to be simulated.
constexpr std::array of_a_scene = {"--backend", "--policy", "--against", "--accuracy",
                                   "--set",     "--seed",   "--force",   "--pace"};

RunChoice run_of(const ViewOptions& options) {
  return {.file = find_scene(options.choice.scene),
          .overrides = overrides_of(options.choice),
          .backend = options.choice.backend,
          .force = options.choice.force,
          .pace = options.pace};
}

/// Serves until Ctrl-C, or for the time of --seconds; `work` lasts a moment and is done again and again.
void serve(const ViewOptions& options, const ViewServer& server, const std::function<void()>& work) {
  const Interrupt interrupt;
  print_result("{}\n", server.url());
  flush_results();
  std::optional<BrowserPage> browser;
  if (options.open && on_desktop()) browser.emplace(server.url());
  if (options.listen == loopback) {
    print_message("Open this address in a browser of this machine; Ctrl-C ends.");
  } else {
    print_message(
        "warning: --listen {}: other machines reach this page. Its address is all that is needed to watch and steer "
        "the "
        "run, and can be read on the network, since nothing is encrypted. Ctrl-C ends.",
        options.listen);
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
  while (!interrupt.requested() && (options.seconds == 0.0 || std::chrono::steady_clock::now() < end)) work();
}

void serve(const ViewOptions& options, const ViewServer& server) {
  serve(options, server, [] { std::this_thread::sleep_for(std::chrono::milliseconds(50)); });
}

/// The page with two others in it, at /a/ and /b/.
ServedPage pair_page(const PairTexts& texts) { return {.path = "/", .page = page_of_pair(texts)}; }

void view_scene(const ViewOptions& options) {
  PageHub hub(options.history_bytes());
  RunLoop loop(run_of(options), hub);
  const ViewServer server(options.port, {{.path = "/", .page = page_of_run(), .hub = &hub, .loop = &loop}},
                          options.listen);
  serve(options, server);
}

/// The scene under its policy beside the same under another one.
void view_policies(const ViewOptions& options) {
  PageHub hub_a(options.history_bytes());
  PageHub hub_b(options.history_bytes());
  ViewOptions other = options;
  other.choice.policy = options.against;
  RunLoop a(run_of(options), hub_a);
  RunLoop b(run_of(other), hub_b);
  const std::string page = page_of_run();
  const ViewServer server(options.port,
                          {pair_page({.of_runs = true}),
                           {.path = "/a/", .page = page, .hub = &hub_a, .loop = &a},
                           {.path = "/b/", .page = page, .hub = &hub_b, .loop = &b}},
                          options.listen);
  serve(options, server);
}

void view_live(const ViewOptions& options) {
  PageHub hub(options.history_bytes());
  LiveView live(options.lcm_url, hub);  // before the threads of the server: it forks
  const ViewServer server(options.port, {{.path = "/", .page = page_of_run(), .hub = &hub}}, options.listen);
  serve(options, server, [&] { live.listen(std::chrono::milliseconds(50)); });
}

/// Mean wall time of a step of a recorded run [ms]; 0: not known.
double ms_per_step_of(const std::string& folder) {
  std::ifstream in(std::filesystem::path(folder) / run_files::summary);
  const auto summary = nlohmann::json::parse(in, nullptr, false);
  const bool known = summary.is_object() && summary.contains("ms_per_step") && summary["ms_per_step"].is_number();
  return known ? summary["ms_per_step"].get<double>() : 0.0;
}

void view_record(const ViewOptions& options) {
  const auto served = [](const char* path, const std::string& run) {
    return ServedPage{.path = path, .page = page_of_record(name_of_run(run)), .record = record_bytes(run)};
  };
  if (options.other.empty()) {
    const ViewServer server(options.port, {served("/", options.choice.scene)}, options.listen);
    serve(options, server);
    return;
  }
  const AnyScene a = scene_of_run(options.choice.scene);
  const AnyScene b = scene_of_run(options.other);
  if (a.index() != b.index())
    throw std::invalid_argument(
        fmt::format("{} and {} are runs in 2D and in 3D: two runs side by side must be of one dimension",
                    options.choice.scene, options.other));
  const PairTexts texts = {
      .of_runs = false,
      .ms_per_step = {ms_per_step_of(options.choice.scene), ms_per_step_of(options.other)},
      .differences = setting_differences(scene_texts_of_run(options.choice.scene), scene_texts_of_run(options.other))};
  const ViewServer server(options.port,
                          {pair_page(texts), served("/a/", options.choice.scene), served("/b/", options.other)},
                          options.listen);
  serve(options, server);
}

bool is_record(const std::string& what) { return std::filesystem::is_directory(what) || is_event_log(what); }

/// What stands in the place of a scene.
enum class Shown : std::uint8_t { scene, record, live };

/// An option that would change nothing of what is shown is a mistake.
void refuse_idle_options(const CLI::App& command, const ViewOptions& options, Shown shown) {
  const auto refuse = [&](const char* name, std::string_view rule) {
    const CLI::Option* option = command.get_option_no_throw(name);
    if (option != nullptr && option->count() > 0)
      throw std::invalid_argument(fmt::format(
          "{}: must be of {}; {}", name, rule,
          shown == Shown::live
              ? "--live shows the run of another process"
              : fmt::format("{} is {}", options.choice.scene, shown == Shown::scene ? "a scene" : "a recorded run")));
  };
  if (shown != Shown::scene)
    for (const char* name : of_a_scene) refuse(name, "a scene");
  if (shown != Shown::live) refuse("--lcm-url", "--live");
  if (shown == Shown::record) refuse("--history", "a scene or of --live");
}

void view(const CLI::App& command, const ViewOptions& options) {
  if (options.choice.scene.empty() != options.live)
    throw std::invalid_argument("must have either a scene or run folder to show, or --live");
  const bool record = !options.live && is_record(options.choice.scene);
  if (!options.other.empty() && !(record && is_record(options.other)))
    throw std::invalid_argument("what stands side by side must be two run folders or records");
  refuse_idle_options(command, options, options.live ? Shown::live : record ? Shown::record : Shown::scene);
  if (options.live) return view_live(options);
  if (record) return view_record(options);
  options.against.empty() ? view_scene(options) : view_policies(options);
}

/// An address of one interface: the page's requests must name the same as their host.
CLI::Validator one_interface() {
  return CLI::Validator(
      [](const std::string& text) {
        in_addr address{};
        const bool holds = inet_pton(AF_INET, text.c_str(), &address) == 1 && address.s_addr != INADDR_ANY;
        return holds ? std::string() : fmt::format("{}: must be the IPv4 address of one interface", text);
      },
      "IPV4");
}

/// 0, or a number from the slowest pace to the fastest.
CLI::Validator pace() {
  const CLI::Validator inside = number_between(RunLoop::slowest_pace, RunLoop::fastest_pace);
  return {[inside](std::string& text) {
            double value = NAN;
            if (CLI::detail::lexical_cast(text, value) && value == 0.0) return std::string();
            return inside(text);
          },
          fmt::format("0, or NUMBER from {:g} to {:g}", RunLoop::slowest_pace, RunLoop::fastest_pace)};
}

void add_options(CLI::App& command, ViewOptions& options) {
  command
      .add_option("what", options.choice.scene,
                  "Run folder or its record, scene file, or the name of a scene that `talus list` shows")
      ->check(not_empty());
  command.add_option("other", options.other, "Second run folder, shown beside the first in step")->check(not_empty());
  command.add_flag("--live", options.live, "Show a run of another process, as it goes on");
  command
      .add_option("--lcm-url", options.lcm_url,
                  "Of --live: where to listen; else LCM_DEFAULT_URL, else this machine's runs")
      ->check(not_empty());
  add_setting_options(command, options.choice);
  command.add_option("--against", options.against, "Another policy, shown beside the first")->check(not_empty());
  command.add_option("--pace", options.pace, "Simulated seconds per second; 0: as fast as possible")
      ->check(pace())
      ->capture_default_str();
  for (const char* name : of_a_scene) command.get_option(name)->group("Of a scene");
  command
      .add_option("--listen", options.listen,
                  "IPv4 address of an interface of this machine, on which other machines reach the page: its "
                  "address is all that is needed to watch and steer the run, and nothing is encrypted")
      ->check(one_interface())
      ->capture_default_str();
  command.add_option("--port", options.port, "Port of the interface; 0: one that is free")
      ->check(whole_number(0, 65535))
      ->capture_default_str();
  command
      .add_option("--history", options.history,
                  "Of a scene or --live: MiB of memory for the frames that pages can scrub back to; where a run has "
                  "more, some are left out")
      ->check(whole_number(1, 65536))
      ->capture_default_str();
  command.add_flag("!--no-open", options.open, "Only print the address: open no browser");
  command.add_option("--seconds", options.seconds, "Stop after so many seconds; else Ctrl-C stops")
      ->check(number_between(0.0, 1e9));
}

}  // namespace

void add_view_command(CLI::App& app, int& exit_code) {
  CLI::App* command =
      app.add_subcommand("view", "Show a scene, a run of another process or a recorded run in the browser");
  auto options = std::make_shared<ViewOptions>();
  add_options(*command, *options);
  command->footer(
      "Examples:\n  talus view drop_in_a_pile_2d\n  talus view drop_in_a_pile_3d --policy full --pace 4\n"
      "  talus view drop_in_a_pile_2d --against full\n\n"
      "On a desktop the browser opens by itself. The page is for browsers of this machine and this user: its address "
      "holds a secret.");
  command->callback([command, options, &exit_code] {
    view(*command, *options);
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
