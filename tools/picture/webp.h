#pragma once
// Animated pictures as WebP files, which browsers and code hosts show.

#include <filesystem>
#include <memory>

#include "tools/picture/film.h"

namespace talus {

/// Encodes frames as they come, without loss; the same frames give the same bytes.
class WebpFilm {
 public:
  /// Frames of width x height pixels, shown in an endless loop.
  WebpFilm(int width, int height);
  ~WebpFilm();
  WebpFilm(const WebpFilm&) = delete;
  WebpFilm& operator=(const WebpFilm&) = delete;

  /// Adds a frame that is shown for `milliseconds` > 0. Throws std::runtime_error with libwebp's reason.
  void add(const Image& image, int milliseconds);

  /// Writes the file; no frame may be added afterwards. Throws std::runtime_error naming the file.
  void write(const std::filesystem::path& file);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace talus
