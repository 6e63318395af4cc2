#pragma once
// Films by the program ffmpeg, which is started without a shell and reads the frames from a pipe.

#include <sys/types.h>

#include "tools/picture/film_file.h"

namespace talus {

/// MP4 (H.264, in colours that each player shows) or GIF (a palette a frame, in an endless loop), by the file's ending.
class FfmpegFilm final : public FilmFile {
 public:
  explicit FfmpegFilm(const FilmFormat& format);
  ~FfmpegFilm() override;
  FfmpegFilm(const FfmpegFilm&) = delete;
  FfmpegFilm& operator=(const FfmpegFilm&) = delete;

  void add(const Image& image) override;
  void finish() override;

 private:
  [[noreturn]] void fail();
  int end();

  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace talus
