#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <thread>

#include "common/math/require.h"
#include "common/text/printable.h"
#include "tools/commands/commands.h"
#include "tools/commands/validators.h"
#include "tools/output/output.h"
#include "tools/picture/film_file.h"
#include "tools/picture/force_chains.h"
#include "tools/picture/framing.h"
#include "tools/record/record_file.h"
#include "tools/record/recorded_run.h"

namespace talus {
namespace {

struct FilmOptions {
  std::string run;
  std::string out;
  /// Simulated time that the film shows [s]; `to` < 0: to the end of the run.
  double from = 0.0;
  double to = -1.0;
  /// Simulated seconds per second of film.
  double speed = 4.0;
  /// Frames per second of film, at most 50 (browsers show no more).
  double rate = 15.0;
  /// [px]
  int width = 800;
  /// Of WebP; 100: without loss.
  int quality = 100;
};

void check(const FilmOptions& options) {
  require(options.to < 0.0 || options.to >= options.from, "--to", options.to, "must be --from or later");
  require(is_film_file(options.out), "--out", options.out, "must end in .webp, .mp4 or .gif");
  require(options.quality == FilmOptions().quality || options.out.ends_with(".webp"), "--quality", options.quality,
          "must stand with a WebP film");
}

/// The bodies of a recorded frame; velocities are zero.
template <int Dim>
BodyStates<Dim> states_at(const Trajectory<Dim>& run, int frame) {
  BodyStates<Dim> states;
  for (BodyIndex body = 0; body < run.bodies(frame); ++body) {
    const bool present = run.present(frame, body);
    states.shape.push_back(run.shape(body));
    states.pose.push_back(present ? Pose<Dim>{run.position(frame, body), run.rotation(frame, body)} : Pose<Dim>{});
    states.velocity.push_back(Vec<Dim>::Zero());
    states.spin.push_back(Spin<Dim>::Zero());
    states.asleep.push_back(present && run.asleep(frame, body) ? 1 : 0);
    states.removed.push_back(present ? 0 : 1);
  }
  return states;
}

/// Which recorded frames a film shows.
struct Cut {
  int first = 0;
  int last = 0;
  /// Recorded frames from one shown frame to the next.
  double step = 1.0;
  /// For which a frame is shown [s].
  double frame_time = 0.0;

  int frames() const { return static_cast<int>((last - first) / step) + 1; }
  int frame(int shown) const { return static_cast<int>(first + shown * step); }
};

/// The first frame is that of one frame time.
template <int Dim>
Cut cut_of(const FilmOptions& options, const Trajectory<Dim>& frames) {
  require(frames.frames() > 0, "run", options.run, "must have recorded a frame");
  const double frame_time = frames.frame_time();
  const double end = frames.frames() - 1;
  Cut cut;
  const auto frame_at = [&](double time) { return std::max(0.0, std::floor(time / frame_time + 1e-6) - 1.0); };
  cut.last = static_cast<int>(options.to < 0.0 ? end : std::min(end, frame_at(options.to)));
  require(frame_at(options.from) <= cut.last, "--from", options.from, "must lie within the run");
  cut.first = static_cast<int>(frame_at(options.from));
  cut.step = std::max(1.0, options.speed / options.rate / frame_time);
  cut.frame_time = cut.step * frame_time / options.speed;
  return cut;
}

PictureParams params_of(const FilmOptions& options) {
  PictureParams params;
  params.width = options.width;
  params.height = options.width;
  params.font_size = std::max(11.0, options.width / 50.0);
  params.margin = options.width / 30.0;
  return params;
}

/// The scene's last event, in the two seconds after it.
template <int Dim>
std::string event_note(const RecordedRun<Dim>& run, double time) {
  constexpr double shown = 2.0;  // [s]
  std::string note;
  for (const DoneEvent& event : run.done)
    if (event.time <= time && time < event.time + shown) note = ": " + event_text(run.scene, event.number);
  return note;
}

template <int Dim>
PictureInput<Dim> input_at(const RecordedRun<Dim>& run, const BodyStates<Dim>& states, int frame,
                           double force_scale = 0.0) {
  const double time = static_cast<double>(run.frames.step(frame)) * run.frames.step_time();
  return {
      run.scene.world.shapes,
      states,
      {},
      world_at<Dim>(run.scene, run.done, time).obstacles,
      run.scene.world.ground,
      printable(run.scene.title),
      printable(fmt::format("{}, policy {}, seed {}, {:.1f} s{}", solved_by(run.backend, run.scene.world.solver.kind),
                            run.policy, run.scene.seed, time, event_note(run, time))),
      run.contacts[frame],
      force_scale,
      run.scene.world.periodic()};
}

/// The bodies of many frames of a film as if all were there at once, so that the framing holds those that fall or have
/// gone by the end. Without those that lie far from all others at the end.
template <int Dim>
BodyStates<Dim> exposed(const RecordedRun<Dim>& run, const Cut& cut) {
  constexpr int most_frames = 64;
  const BodyStates<Dim> end = states_at(run.frames, cut.last);
  const std::vector<BodyIndex> far = framing_of(input_at(run, end, cut.last)).outside;
  BodyStates<Dim> all = end;
  const int every = std::max(1, cut.frames() / most_frames);
  for (int shown = 0; shown < cut.frames(); shown += every) {
    const BodyStates<Dim> states = states_at(run.frames, cut.frame(shown));
    for (BodyIndex body = 0; body < states.size(); ++body) {
      if (states.removed[body] != 0 || std::ranges::binary_search(far, body)) continue;
      all.shape.push_back(states.shape[body]);
      all.pose.push_back(states.pose[body]);
      all.asleep.push_back(states.asleep[body]);
      all.removed.push_back(0);
    }
  }
  return all;
}

/// Calls make(i) for i from 0 to below `count`, on all cores, and take() here with the results in order.
template <class Make, class Take>
void in_order(int count, const Make& make, const Take& take) {
  const int ahead = static_cast<int>(std::max(1U, std::thread::hardware_concurrency())) + 2;
  std::deque<std::future<decltype(make(0))>> under_way;
  for (int started = 0, taken = 0; taken < count; ++taken) {
    for (; started < std::min(count, taken + ahead); ++started)
      under_way.push_back(std::async(std::launch::async, make, started));
    take(under_way.front().get());
    under_way.pop_front();
  }
}

template <int Dim>
void film(const FilmOptions& options, const RecordedRun<Dim>& run) {
  if (const std::string damage = text_of(run.damage); !damage.empty())
    print_message("the record is damaged: {}", damage);
  const Cut cut = cut_of(options, run.frames);
  const BodyStates<Dim> end = states_at(run.frames, cut.last);
  const double scale = force_scale(input_at(run, end, cut.last));
  const BodyStates<Dim> framed = exposed(run, cut);
  const FilmFrames<Dim> page(input_at(run, framed, cut.last, scale), params_of(options));
  const auto draw = [&](int shown) {
    int frame = cut.frame(shown);
    while (frame > 0 && run.frames.lost(frame)) --frame;  // the record is damaged
    const BodyStates<Dim> states = states_at(run.frames, frame);
    return page.draw(input_at(run, states, frame, scale));
  };
  const bool progress = isatty(STDERR_FILENO) != 0;
  std::optional<FilmFile> file;
  int taken = 0;
  in_order(cut.frames(), draw, [&](const FilmImage& image) {
    if (!file)
      file.emplace(FilmFormat{.file = options.out,
                              .width = image.width,
                              .height = image.height,
                              .frame_time = cut.frame_time,
                              .quality = options.quality});
    file->add(image);
    if (progress) write_note(fmt::format("\r{} of {} frames", ++taken, cut.frames()));
  });
  file->finish();
  if (progress) write_note("\r\x1b[K");
  print_result("{}: {} frames, {:.0f} kB\n", printable(options.out), cut.frames(),
               static_cast<double>(std::filesystem::file_size(options.out)) / 1e3);
}

}  // namespace

void add_film_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("film", "Make a moving picture of a recorded run");
  auto options = std::make_shared<FilmOptions>();
  command->add_option("run", options->run, "Run folder, as `talus run` leaves it, or its record")
      ->required()
      ->check(not_empty());
  command
      ->add_option("-o,--out", options->out,
                   "Film to write, overwritten if there: .webp, .mp4 or .gif, by the program ffmpeg")
      ->required()
      ->check(file_to_write());
  command->add_option("--from", options->from, "Simulated time at which the film begins [s]")
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
  command->add_option("--to", options->to, "Simulated time at which it ends [s]; default: the run's end")
      ->check(number_between(0.0, 1e9));
  command->add_option("--speed", options->speed, "Simulated seconds per second of film")
      ->check(number_between(0.01, 1e4))
      ->capture_default_str();
  command->add_option("--rate", options->rate, "Frames per second of film")
      ->check(number_between(1.0, 50.0))
      ->capture_default_str();
  command->add_option("--width", options->width, "Width [pixels]")
      ->check(whole_number(200, 8000))
      ->capture_default_str();
  command->add_option("--quality", options->quality, "Of a WebP film; 100: without loss")
      ->check(whole_number(0, 100))
      ->capture_default_str();
  command->footer("Example:\n  talus run drop_in_a_pile_2d --out runs/pour\n  talus film runs/pour --out pour.webp");
  command->callback([options, &exit_code] {
    check(*options);
    refuse_own_file(options->run, options->out);
    std::visit([&](const auto& run) { film(*options, run); }, read_run(options->run));
    exit_code = exit_codes::success;
  });
}

}  // namespace talus
