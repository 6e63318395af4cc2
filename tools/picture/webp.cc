#include "tools/picture/webp.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tools/picture/canvas.h"

namespace talus {

struct WebpFilm::Encoder {
  WebPAnimEncoder* films = nullptr;
  WebPConfig config{};
  int frames = 0;
};

namespace {

[[noreturn]] void fail(const WebPAnimEncoder* encoder) {
  throw std::runtime_error(std::string("encoding a film: ") +
                           WebPAnimEncoderGetError(const_cast<WebPAnimEncoder*>(encoder)));
}

/// [ms] at which a frame begins.
int start_of(int frame, const FilmFormat& format) {
  return static_cast<int>(frame * std::lround(1e3 * format.frame_time));
}

bool configure(WebPConfig& config, int quality) {
  if (quality == 100) return WebPConfigInit(&config) != 0 && WebPConfigLosslessPreset(&config, 4) != 0;
  return WebPConfigPreset(&config, WEBP_PRESET_DRAWING, static_cast<float>(quality)) != 0;
}

}  // namespace

WebpFilm::WebpFilm(const FilmFormat& format) : format_(format), encoder_(std::make_unique<Encoder>()) {
  WebPAnimEncoderOptions options;
  if (WebPAnimEncoderOptionsInit(&options) == 0 || !configure(encoder_->config, format.quality))
    throw std::runtime_error("encoding a film: libwebp has another version than its headers");
  options.anim_params.loop_count = 0;
  encoder_->films = WebPAnimEncoderNew(format.width, format.height, &options);
  if (encoder_->films == nullptr) throw std::runtime_error("encoding a film: libwebp refuses this size");
}

WebpFilm::~WebpFilm() { WebPAnimEncoderDelete(encoder_->films); }

void WebpFilm::add(const Image& image) {
  WebPPicture picture;
  if (WebPPictureInit(&picture) == 0) throw std::runtime_error("encoding a film: libwebp has another version");
  picture.use_argb = 1;
  picture.width = image.width;
  picture.height = image.height;
  const bool filled =
      WebPPictureAlloc(&picture) != 0 &&
      WebPPictureImportBGRX(&picture, reinterpret_cast<const std::uint8_t*>(image.pixels.data()), 4 * image.width) != 0;
  const int start = start_of(encoder_->frames, format_);
  const bool added = filled && WebPAnimEncoderAdd(encoder_->films, &picture, start, &encoder_->config) != 0;
  WebPPictureFree(&picture);
  if (!added) fail(encoder_->films);
  ++encoder_->frames;
}

void WebpFilm::finish() {
  WebPData data;
  WebPDataInit(&data);
  const int end = start_of(encoder_->frames - 1, format_) + static_cast<int>(std::lround(1e3 * format_.pause));
  const bool whole = WebPAnimEncoderAdd(encoder_->films, nullptr, end, nullptr) != 0 &&
                     WebPAnimEncoderAssemble(encoder_->films, &data) != 0;
  if (!whole) fail(encoder_->films);
  const std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  write_file(format_.file, bytes);
}

}  // namespace talus
