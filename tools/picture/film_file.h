#pragma once
// Films as files, by the program ffmpeg, which is started without a shell and reads the frames from a pipe.

#include <sys/types.h>

#include <filesystem>

#include "common/text/file.h"
#include "tools/picture/film.h"

namespace talus {

struct FilmFormat {
  std::filesystem::path file;  // ends in .webp, .mp4 or .gif
  int width = 0;               // [px]
  int height = 0;
  double frame_time = 0.0;  // [s] > 0 for which a frame is shown
  double pause = 1.5;       // [s] for which the last frame is shown
  int quality = 100;        // of WebP, 0 to 100; 100 is without loss
};

/// Whether the ending of a file is that of a film.
bool is_film_file(const std::filesystem::path& file);

/// A film being written: WebP and GIF (a palette a frame) in an endless loop, or MP4 (H.264, in colours that each
/// player shows). The same frames give the same bytes with the same version of ffmpeg.
class FilmFile {
 public:
  /// Opens the film for writing; finished, it replaces a file that is there. Throws std::runtime_error where ffmpeg
  /// does not start.
  explicit FilmFile(const FilmFormat& format);
  ~FilmFile();
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  /// Adds a frame of the format's size. Throws std::runtime_error where ffmpeg fails, which prints the reason.
  void add(const FilmImage& image);
  /// Completes the file; no frame may be added afterwards. Throws as add() does.
  void finish();

 private:
  [[noreturn]] void fail();
  int end();

  UnfinishedFile file_;
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace talus
