#include "tools/picture/terminal.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "common/shape/surface.h"
#include "tools/picture/z_buffer.h"

namespace talus {
namespace {

template <int Dim>
Dot dot_of(const BodyStates<Dim>& states, std::size_t body) {
  return states.asleep[body] != 0 ? Dot::asleep : Dot::awake;
}

void fill_pieces(Dots& dots, const Shape<2>& shape, const Pose<2>& pose, const Projection<2>& projection, Dot dot) {
  for (const Loop<2>& loop : outlines(shape, 16)) {
    std::vector<Vec3> corners;
    for (const Vec2& corner : loop) {
      const Vec2 seen = projection.on_page(pose * corner);
      corners.emplace_back(seen.x(), seen.y(), 0.0);
    }
    scan_convex(corners, dots.width, dots.height, [&](int x, int y, double) {
      Dot& here = dots.at(x, y);
      here = dot == Dot::obstacle && here != Dot::empty ? here : dot;
    });
  }
}

void fill(Dots& dots, const PictureInput<2>& input, const Framing<2>& framing, const Projection<2>& projection) {
  for (const BodyIndex body : framing.drawn) {
    const Shape<2>& shape = input.shapes[input.states.shape[body]];
    fill_pieces(dots, shape, input.states.pose[body], projection, dot_of(input.states, body));
  }
  for (const Obstacle<2>& obstacle : input.obstacles)
    fill_pieces(dots, obstacle.shape, obstacle.pose, projection, Dot::obstacle);
}

void fill(Dots& dots, const PictureInput<3>& input, const Framing<3>& framing, const Projection<3>& projection) {
  const std::vector<Face> faces = faces_of(input, framing);
  for (const bool bodies : {true, false}) {
    ZBuffer buffer(dots.width, dots.height);
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (faces[i].owner != ground_owner && (faces[i].owner >= 0) == bodies)
        buffer.add(faces[i], static_cast<std::int32_t>(i), projection);
    for (int y = 0; y < dots.height; ++y) {
      for (int x = 0; x < dots.width; ++x) {
        const std::int32_t face = buffer.face(x, y);
        if (face != ZBuffer::nothing && dots.at(x, y) == Dot::empty) {
          const std::int32_t owner = faces[face].owner;
          dots.at(x, y) = bodies ? dot_of(input.states, owner) : Dot::obstacle;
        }
      }
    }
  }
}

}  // namespace

template <>
Projection<2> side_view(const Framing<2>&) {
  return {};
}

template <>
Projection<3> side_view(const Framing<3>& framing) {
  return Projection<3>::looking_along(-Vec3::UnitY(), framing.box.center(), 0.0);
}

template <int Dim>
Dots dots_of(const PictureInput<Dim>& input, const Framing<Dim>& framing, const Projection<Dim>& projection, int width,
             int height) {
  Dots dots{width, height, {}};
  dots.dots.resize(static_cast<std::size_t>(width) * height, Dot::empty);
  fill(dots, input, framing, projection);
  for (const BodyIndex body : framing.drawn) {
    const Vec2 seen = projection.on_page(input.states.pose[body].position);
    const int x = std::clamp(static_cast<int>(seen.x()), 0, width - 1);
    const int y = std::clamp(static_cast<int>(seen.y()), 0, height - 1);
    if (dots.at(x, y) == Dot::empty) dots.at(x, y) = dot_of(input.states, body);
  }
  return dots;
}

template Dots dots_of(const PictureInput<2>&, const Framing<2>&, const Projection<2>&, int, int);
template Dots dots_of(const PictureInput<3>&, const Framing<3>&, const Projection<3>&, int, int);

namespace {

constexpr int label_columns = 6;  // beside the picture, on its right
constexpr int cell_width = 2;     // dots in a character
constexpr int cell_height = 4;

/// What a character shows: its commonest kind of dot, and which of its dots are set.
struct Cell {
  Dot kind = Dot::empty;
  unsigned braille = 0;  // bits of the Unicode character
};

Cell cell_at(const Dots& dots, int column, int row) {
  // The order of bits in U+2800..U+28FF.
  constexpr std::array<std::array<unsigned, cell_width>, cell_height> bits = {
      {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
  std::array<int, 4> counts = {};
  Cell cell;
  for (int y = 0; y < cell_height; ++y) {
    for (int x = 0; x < cell_width; ++x) {
      const Dot dot = dots.at(column * cell_width + x, row * cell_height + y);
      if (dot != Dot::empty) {
        counts[static_cast<std::size_t>(dot)] += 1;
        cell.braille |= bits[y][x];
      }
    }
  }
  for (const Dot kind : {Dot::obstacle, Dot::asleep, Dot::awake}) {
    const int count = counts[static_cast<std::size_t>(kind)];
    if (count > 0 && count >= counts[static_cast<std::size_t>(cell.kind)]) cell.kind = kind;
  }
  return cell;
}

std::string utf8(unsigned braille) {
  const unsigned code = 0x2800U + braille;
  return {static_cast<char>(0xE0U | (code >> 12U)), static_cast<char>(0x80U | ((code >> 6U) & 0x3FU)),
          static_cast<char>(0x80U | (code & 0x3FU))};
}

/// Grey that is seen on black and on white, orange, darker grey.
const char* colour_of(Dot kind) {
  switch (kind) {
    case Dot::awake:
      return "\x1b[38;5;214m";
    case Dot::asleep:
      return "\x1b[38;5;244m";
    case Dot::obstacle:
      return "\x1b[38;5;67m";
    case Dot::empty:
      break;
  }
  return "\x1b[0m";
}

const char* shade_of(Dot kind) {
  constexpr std::array<const char*, 4> shades = {" ", "▒", "█", "░"};
  return shades[static_cast<std::size_t>(kind)];
}

std::string line_of(const Dots& dots, int row, bool colours) {
  std::string line;
  Dot colour = Dot::empty;
  for (int column = 0; column < dots.width / cell_width; ++column) {
    const Cell cell = cell_at(dots, column, row);
    if (!colours) {
      line += shade_of(cell.kind);
      continue;
    }
    if (cell.kind != colour) {
      line += colour_of(cell.kind);
      colour = cell.kind;
    }
    line += cell.kind == Dot::empty ? " " : utf8(cell.braille);
  }
  return colour == Dot::empty ? line : line + colour_of(Dot::empty);
}

template <int Dim>
std::vector<std::string> densities(const PictureInput<Dim>& input, const Projection<Dim>& projection, int rows) {
  std::vector<std::string> labels(rows);
  if (input.piles.size() == 1) {
    const Pile<Dim>& pile = input.piles[0];
    for (const Layer& layer : pile.layers) {
      const Vec<Dim> middle = pile.centre + 0.5 * (layer.bottom + layer.top) * Vec<Dim>::Unit(Dim - 1);
      const int row = static_cast<int>(std::floor(projection.on_page(middle).y() / cell_height));
      if (layer.count > 0 && row >= 0 && row < rows && labels[row].empty())
        labels[row] = fmt::format("  {:.2f}", layer.density());
    }
  }
  return labels;
}

template <int Dim>
std::string legend(const PictureInput<Dim>& input, const Framing<Dim>& framing, bool colours) {
  std::array<std::size_t, 4> counts = {};
  for (const auto* bodies : {&framing.drawn, &framing.outside}) {
    for (const BodyIndex body : *bodies) {
      const bool asleep = input.states.asleep[body] != 0;
      counts[static_cast<std::size_t>(asleep ? Dot::asleep : Dot::awake)] += 1;
    }
  }
  std::string text;
  for (const Dot kind : {Dot::asleep, Dot::awake}) {
    const std::string mark = colours ? std::string(colour_of(kind)) + "⣿" + colour_of(Dot::empty) : shade_of(kind);
    text += fmt::format("{} {} {}   ", mark, counts[static_cast<std::size_t>(kind)],
                        kind == Dot::asleep ? "asleep" : "awake");
  }
  if (!framing.outside.empty()) text += fmt::format("{} outside", framing.outside.size());
  return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

void check(const TerminalParams& params) {
  if (params.columns < 48 || params.columns > 400)
    throw std::invalid_argument(fmt::format("terminal.columns = {}: must be 48 to 400", params.columns));
  if (params.rows < 6 || params.rows > 200)
    throw std::invalid_argument(fmt::format("terminal.rows = {}: must be 6 to 200", params.rows));
}

}  // namespace

template <int Dim>
std::string terminal_picture(const PictureInput<Dim>& input, const TerminalParams& params) {
  check(params);
  const Framing<Dim> framing = framing_of(input);
  Projection<Dim> projection = side_view(framing);
  const int columns = params.columns - label_columns;
  Box<2> area(Vec2::Zero(), Vec2(columns * cell_width, (params.rows - 2) * cell_height));
  const double needed = fit<Dim>(projection, framing.points, area).y();
  const int rows = std::clamp(static_cast<int>(std::ceil(needed / cell_height)), 1, params.rows - 2);
  // Whole rows, with the lowest point on the last one.
  area.max().y() = rows * cell_height;
  area.min().y() = area.max().y() - needed;
  fit<Dim>(projection, framing.points, area);

  const Dots dots = dots_of(input, framing, projection, columns * cell_width, rows * cell_height);
  const std::vector<std::string> labels = densities(input, projection, rows);
  std::string text;
  for (int row = 0; row < rows; ++row) {
    const std::string line = line_of(dots, row, params.colours) + labels[row];
    const std::size_t end = line.find_last_not_of(' ') + 1;
    // Room for a cone that rises above all bodies is of no use here.
    if (end > 0 || !text.empty()) text += line.substr(0, end) + "\n";
  }
  if (input.ground.present) {
    for (int column = 0; column < columns; ++column) text += "▔";
    text += "\n";
  }
  return text + legend(input, framing, params.colours);
}

template std::string terminal_picture(const PictureInput<2>&, const TerminalParams&);
template std::string terminal_picture(const PictureInput<3>&, const TerminalParams&);

}  // namespace talus
