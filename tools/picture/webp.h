#pragma once
// Animated pictures as WebP files, which browsers and code hosts show.

#include <memory>

#include "tools/picture/film_file.h"

namespace talus {

/// Encodes frames as they come, shown in an endless loop.
class WebpFilm final : public FilmFile {
 public:
  explicit WebpFilm(const FilmFormat& format);
  ~WebpFilm() override;
  WebpFilm(const WebpFilm&) = delete;
  WebpFilm& operator=(const WebpFilm&) = delete;

  void add(const Image& image) override;
  void finish() override;

 private:
  struct Encoder;
  FilmFormat format_;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace talus
