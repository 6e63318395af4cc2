#pragma once
// Films as files: WebP by libwebp, MP4 and GIF by the program ffmpeg.

#include <filesystem>
#include <memory>

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

/// A film being written. The same frames give the same bytes with the same version of the encoder.
class FilmFile {
 public:
  virtual ~FilmFile() = default;
  /// Adds a frame of the format's size. Throws std::runtime_error with the encoder's reason.
  virtual void add(const Image& image) = 0;
  /// Completes the file; no frame may be added afterwards. Throws std::runtime_error as add() does.
  virtual void finish() = 0;
};

/// Whether the ending of a file is that of a film.
bool is_film_file(const std::filesystem::path& file);

/// Opens the film for writing, over a file that is there. Throws std::runtime_error where ffmpeg is needed and does not
/// start.
std::unique_ptr<FilmFile> make_film_file(const FilmFormat& format);

}  // namespace talus
