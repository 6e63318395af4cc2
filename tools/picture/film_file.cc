#include "tools/picture/film_file.h"

#include "tools/picture/ffmpeg.h"
#include "tools/picture/webp.h"

namespace talus {

bool is_film_file(const std::filesystem::path& file) {
  const std::filesystem::path ending = file.extension();
  return ending == ".webp" || ending == ".mp4" || ending == ".gif";
}

std::unique_ptr<FilmFile> make_film_file(const FilmFormat& format) {
  if (format.file.extension() == ".webp") return std::make_unique<WebpFilm>(format);
  return std::make_unique<FfmpegFilm>(format);
}

}  // namespace talus
