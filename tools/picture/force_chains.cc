#include "tools/picture/force_chains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace talus {
namespace {

constexpr double usual_width = 0.04;  // of a line at the scale's force, in extents of the smallest shape
constexpr double least_width = 2.0;   // of that [px]
constexpr double widest = 2.0;        // in such widths

template <int Dim>
struct Chain {
  Vec<Dim> from;  // [m]
  Vec<Dim> to;
  double force = 0.0;  // [N]
};

template <int Dim>
std::vector<Chain<Dim>> chains_of(const PictureInput<Dim>& input) {
  const auto middle = [&](BodyIndex body) -> const Vec<Dim>& { return input.states.pose[body].position; };
  std::vector<Chain<Dim>> chains;
  std::map<std::pair<BodyIndex, BodyIndex>, std::size_t> of_pair;
  for (const ContactForce<Dim>& contact : input.contacts) {
    const double force = contact.normal_force.norm();
    if (contact.b < 0) {
      chains.push_back({middle(contact.a), contact.point, force});
      continue;
    }
    const auto [place, first] = of_pair.try_emplace(std::minmax(contact.a, contact.b), chains.size());
    if (first) chains.push_back({middle(contact.a), input.sides.near(middle(contact.b), middle(contact.a))});
    chains[place->second].force += force;
  }
  return chains;
}

double with_two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return unit * std::round(value / unit);
}

template <int Dim>
double scale_of(const PictureInput<Dim>& input, const std::vector<Chain<Dim>>& chains) {
  if (chains.empty()) return 0.0;
  if (input.force_scale > 0.0) return input.force_scale;
  std::vector<double> forces;
  for (const Chain<Dim>& chain : chains) forces.push_back(chain.force);
  const auto large = forces.begin() + static_cast<std::ptrdiff_t>(4 * forces.size() / 5);
  std::ranges::nth_element(forces, large);
  return with_two_digits(*large);
}

template <int Dim>
double line_width(const PictureInput<Dim>& input, const Projection<Dim>& projection) {
  double extent = std::numeric_limits<double>::infinity();
  for (const Shape<Dim>& shape : input.shapes) extent = std::min(extent, shape.extent);
  return std::max(least_width, usual_width * extent * projection.pixels_per_metre());
}

}  // namespace

template <int Dim>
double force_scale(const PictureInput<Dim>& input) {
  return scale_of(input, chains_of(input));
}

template <int Dim>
void paint_chains(cairo_t* canvas, const PictureInput<Dim>& input, const Projection<Dim>& projection,
                  const PictureParams& params) {
  const std::vector<Chain<Dim>> chains = chains_of(input);
  const double scale = scale_of(input, chains);
  const double width = line_width(input, projection);
  cairo_set_line_cap(canvas, CAIRO_LINE_CAP_ROUND);
  for (const Chain<Dim>& chain : chains) {
    const double share = chain.force / scale;
    trace_line(canvas, std::array{projection.on_page(chain.from), projection.on_page(chain.to)});
    set_colour(canvas, mix(params.weak_force, params.strong_force, std::min(1.0, share)));
    cairo_set_line_width(canvas, width * std::min(widest, share));
    cairo_stroke(canvas);
  }
}

template double force_scale(const PictureInput<2>&);
template double force_scale(const PictureInput<3>&);
template void paint_chains(cairo_t*, const PictureInput<2>&, const Projection<2>&, const PictureParams&);
template void paint_chains(cairo_t*, const PictureInput<3>&, const Projection<3>&, const PictureParams&);

}  // namespace talus
