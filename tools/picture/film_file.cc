#include "tools/picture/film_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <string>
#include <system_error>
#include <vector>

namespace talus {
namespace {

/// H.264 of 4:2:0 has even sides only.
constexpr const char* even_sides = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";

/// `file`: where to write.
std::vector<std::string> arguments_of(const FilmFormat& format, const std::filesystem::path& file) {
  // Without -xerror ffmpeg ends well on a full disk.
  std::vector<std::string> arguments = {"ffmpeg",   "-loglevel",
                                        "error",    "-nostdin",
                                        "-y",       "-xerror",
                                        "-f",       "rawvideo",
                                        "-pix_fmt", "bgra",
                                        "-s",       fmt::format("{}x{}", format.width, format.height),
                                        "-r",       fmt::format("{:.6f}", 1.0 / format.frame_time),
                                        "-i",       "-",
                                        "-fflags",  "+bitexact",
                                        "-flags:v", "+bitexact"};
  const auto add = [&](std::initializer_list<std::string> more) { arguments.insert(arguments.end(), more); };
  const std::string last_frame_held = fmt::format("tpad=stop_mode=clone:stop_duration={}", format.pause);
  if (format.file.extension() == ".mp4") {
    add({"-vf", fmt::format("{},{}", last_frame_held, even_sides)});
    add({"-c:v", "libx264", "-preset", "medium", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags", "+faststart"});
  } else if (format.file.extension() == ".webp") {
    add({"-vf", last_frame_held, "-c:v", "libwebp_anim", "-loop", "0"});
    if (format.quality == 100)
      add({"-pix_fmt", "bgra", "-lossless", "1", "-compression_level", "4"});
    else
      add({"-preset", "drawing", "-quality", fmt::format("{}", format.quality)});
  } else {
    add({"-vf", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=none"});
    add({"-loop", "0", "-final_delay", fmt::format("{}", std::lround(1e2 * format.pause))});
  }
  add({"file:" + file.string()});
  return arguments;
}

}  // namespace

bool is_film_file(const std::filesystem::path& file) {
  const std::filesystem::path ending = file.extension();
  return ending == ".webp" || ending == ".mp4" || ending == ".gif";
}

FilmFile::FilmFile(const FilmFormat& format) : file_(format.file) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::vector<std::string> arguments = arguments_of(format, file_.path());
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  const int error = posix_spawnp(&process_, "ffmpeg", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  pipe_ = ends[1];
  if (error == 0) return;
  process_ = -1;
  close(pipe_);
  throw std::runtime_error(fmt::format("{}: needs the program ffmpeg (Debian package ffmpeg), which does not start: {}",
                                       format.file.string(), std::generic_category().message(error)));
}

FilmFile::~FilmFile() { end(); }

void FilmFile::add(const FilmImage& image) {
  const char* bytes = reinterpret_cast<const char*>(image.pixels.data());
  for (std::size_t left = 4 * image.pixels.size(); left > 0;) {
    const ssize_t written = ::write(pipe_, bytes, left);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail();
    bytes += written;
    left -= static_cast<std::size_t>(written);
  }
}

void FilmFile::finish() {
  if (end() != 0) fail();
  file_.finish();
}

void FilmFile::fail() {
  end();
  throw std::runtime_error("encoding a film: ffmpeg ended with an error, printed above");
}

/// Closes the pipe and waits; ffmpeg's exit status.
int FilmFile::end() {
  if (process_ < 0) return 0;
  close(pipe_);
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

}  // namespace talus
