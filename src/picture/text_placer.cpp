#include "picture/text_placer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "output/columns.hpp"

namespace gearlash {
namespace {

using Complex = std::complex<double>;

/// The width in letters, without the "_" of subscripts.
std::size_t width_of(const std::string& text) {
  const auto marks = std::count(text.begin(), text.end(), '_');
  return width_in_columns(text) - static_cast<std::size_t>(marks);
}

}  // namespace

bool TextPlacer::overlap(const Box& a, const Box& b) {
  return std::abs(a.center.real() - b.center.real()) < a.half_width + b.half_width &&
         std::abs(a.center.imag() - b.center.imag()) < a.half_height + b.half_height;
}

std::optional<Complex> TextPlacer::place(const Complex& point, const std::string& text, bool must) {
  const double bold = must ? 1.17 : 1.0;
  const double width = bold * letter_ * static_cast<double>(width_of(text));
  std::optional<Box> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double distance : {0.016, 0.034, 0.06}) {
    for (int direction = 0; direction < 16; ++direction) {
      const Box box = beside(point, std::numbers::pi * direction / 8.0, distance, width);
      const double cost = cost_of(box) + 20.0 * distance;
      if (cost >= least) continue;
      least = cost;
      best = box;
    }
  }
  constexpr double of_a_text = 50.0;
  if (!best || (least >= of_a_text && !must)) return std::nullopt;
  taken_.push_back(*best);
  return best->center;
}

TextPlacer::Box TextPlacer::beside(const Complex& point, double direction, double distance,
                                   double width) const {
  const double half_width = 0.5 * width;
  const double half_height = 1.1 * letter_;
  const Complex way = std::polar(1.0, direction);
  return {
      point + Complex{way.real() * (half_width + distance), way.imag() * (half_height + distance)},
      half_width, half_height};
}

double TextPlacer::cost_of(const Box& box) const {
  double cost = 0.0;
  for (const Complex& obstacle : obstacles_) {
    if (overlap(box, {obstacle, 0.3 * letter_, 0.3 * letter_})) cost += 1.0;
  }
  for (const Box& other : taken_) {
    if (overlap(box, other)) cost += 60.0;
  }
  const Complex center = box.center;
  const bool is_inside = center.real() > box.half_width &&
                         center.real() < aspect_ - box.half_width &&
                         center.imag() > box.half_height && center.imag() < 1.0 - box.half_height;
  return is_inside ? cost : cost + 60.0;
}

}  // namespace gearlash
