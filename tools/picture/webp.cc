#include "tools/picture/webp.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <stdexcept>
#include <string>

#include "tools/picture/canvas.h"

namespace talus {

struct WebpFilm::Encoder {
  WebPAnimEncoder* films = nullptr;
  WebPConfig config{};
  int time = 0;  // [ms] at which the next frame begins
};

namespace {

[[noreturn]] void fail(const WebPAnimEncoder* encoder) {
  throw std::runtime_error(std::string("encoding a film: ") +
                           WebPAnimEncoderGetError(const_cast<WebPAnimEncoder*>(encoder)));
}

}  // namespace

WebpFilm::WebpFilm(int width, int height) : encoder_(std::make_unique<Encoder>()) {
  WebPAnimEncoderOptions options;
  if (WebPAnimEncoderOptionsInit(&options) == 0 || WebPConfigInit(&encoder_->config) == 0 ||
      WebPConfigLosslessPreset(&encoder_->config, 4) == 0) {
    throw std::runtime_error("encoding a film: libwebp has another version than its headers");
  }
  options.anim_params.loop_count = 0;
  encoder_->films = WebPAnimEncoderNew(width, height, &options);
  if (encoder_->films == nullptr) throw std::runtime_error("encoding a film: libwebp refuses this size");
}

WebpFilm::~WebpFilm() { WebPAnimEncoderDelete(encoder_->films); }

void WebpFilm::add(const Image& image, int milliseconds) {
  WebPPicture picture;
  if (WebPPictureInit(&picture) == 0) throw std::runtime_error("encoding a film: libwebp has another version");
  picture.use_argb = 1;
  picture.width = image.width;
  picture.height = image.height;
  const bool filled =
      WebPPictureAlloc(&picture) != 0 &&
      WebPPictureImportBGRX(&picture, reinterpret_cast<const std::uint8_t*>(image.pixels.data()), 4 * image.width) != 0;
  const bool added = filled && WebPAnimEncoderAdd(encoder_->films, &picture, encoder_->time, &encoder_->config) != 0;
  WebPPictureFree(&picture);
  if (!added) fail(encoder_->films);
  encoder_->time += milliseconds;
}

void WebpFilm::write(const std::filesystem::path& file) {
  WebPData data;
  WebPDataInit(&data);
  const bool whole = WebPAnimEncoderAdd(encoder_->films, nullptr, encoder_->time, nullptr) != 0 &&
                     WebPAnimEncoderAssemble(encoder_->films, &data) != 0;
  if (!whole) fail(encoder_->films);
  const std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
  WebPDataClear(&data);
  write_file(file, bytes);
}

}  // namespace talus
