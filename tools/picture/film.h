#pragma once
// States of a run as the frames of a film: all on one page, in one framing.

#include <cstdint>
#include <memory>
#include <vector>

#include "tools/picture/picture.h"

namespace talus {

/// Pixels row by row, 0xffRRGGBB each.
struct FilmImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> pixels;
};

/// Draws states of one run in one framing.
template <int Dim>
class FilmFrames {
 public:
  /// `framed`: sets framing and page height, as with the bodies of all states at once. All that it refers to must
  /// outlive the object. Throws std::invalid_argument on bad parameters.
  FilmFrames(const PictureInput<Dim>& framed, const PictureParams& params);
  ~FilmFrames();
  FilmFrames(const FilmFrames&) = delete;
  FilmFrames& operator=(const FilmFrames&) = delete;

  /// The state with its own counts and caption. Bodies outside the framing are cut off at its edge, and counted in a
  /// note.
  FilmImage draw(const PictureInput<Dim>& input) const;

 private:
  struct Setting;
  std::unique_ptr<Setting> setting_;
};

}  // namespace talus
