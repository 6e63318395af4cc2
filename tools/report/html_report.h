#pragma once
// A report as one HTML page that needs no network and no other file.

#include <string>
#include <variant>
#include <vector>

#include "tools/report/table.h"

namespace talus {

/// Plain text; its characters are shown as they are.
struct Paragraph {
  std::string text;
};

/// A drawing as the text of an SVG file.
struct Figure {
  std::string svg;
  std::string caption;
};

/// A text with its lines, folded away under its caption.
struct Listing {
  std::string text;
  std::string caption;
};

/// Another page, whole, in a frame of its own: its style and its scripts keep to it.
struct EmbeddedPage {
  std::string html;
  std::string caption;
};

using Block = std::variant<Paragraph, Table, Figure, Listing, EmbeddedPage>;

struct Section {
  std::string heading;
  std::vector<Block> blocks;
};

struct Report {
  std::string title;
  std::string subtitle;  // one line, may be empty
  std::vector<Section> sections;
};

/// The page. Throws std::invalid_argument on a table whose rows differ in length or a figure that is no SVG.
std::string html_of(const Report& report);

}  // namespace talus
