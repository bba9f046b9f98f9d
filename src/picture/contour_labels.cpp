#include "picture/contour_labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "output/columns.hpp"

namespace gearlash {
namespace {

/// Points of a line by the distance along it.
class Way {
 public:
  explicit Way(const PaperLine& line) : line_(line) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      lengths_.push_back(i == 0 ? 0.0 : lengths_.back() + distance(line[i - 1], line[i]));
    }
  }
  double length() const { return lengths_.back(); }

  PaperPoint at(double way) const {
    const std::size_t next = next_after(way);
    const double piece = lengths_[next] - lengths_[next - 1];
    const double share = piece > 0.0 ? (way - lengths_[next - 1]) / piece : 0.0;
    const PaperPoint& from = line_[next - 1];
    const PaperPoint& to = line_[next];
    return {from.right + share * (to.right - from.right), from.up + share * (to.up - from.up)};
  }

  PaperLine part(double from, double to) const {
    PaperLine part = {at(from)};
    for (std::size_t i = 0; i < line_.size(); ++i) {
      if (lengths_[i] > from && lengths_[i] < to) part.push_back(line_[i]);
    }
    part.push_back(at(to));
    return part;
  }

 private:
  std::size_t next_after(double way) const {
    const auto next = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, way);
    return static_cast<std::size_t>(next - lengths_.begin());
  }

  const PaperLine& line_;
  std::vector<double> lengths_;
};

double slope_of(const PaperPoint& from, const PaperPoint& to) {
  double slope =
      std::atan2(to.up - from.up, to.right - from.right) * 180.0 / std::numbers::pi_v<double>;
  if (slope > 90.0) slope -= 180.0;
  if (slope <= -90.0) slope += 180.0;
  return slope;
}

double distance_from(const PaperPoint& point, const PaperLine& line) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    nearest = std::min(nearest, distance_from_chord(point, line[i], line[i + 1]));
  }
  return nearest;
}

}  // namespace

/// The distance to the nearest edge, number or other line; negative if the number would touch it.
double LabelPlacer::clearance(const PaperPoint& centre, const PaperLine& contour,
                              double half_width) const {
  double clear =
      std::min({centre.right, Paper::width - centre.right, centre.up, Paper::height - centre.up}) -
      half_width;
  for (const PaperPoint& other : taken_) {
    clear = std::min(clear, distance(centre, other) - 2.0 * half_width);
  }
  for (const PaperLine& line : lines_) {
    if (line.front().right == contour.front().right && line.front().up == contour.front().up) {
      continue;
    }
    clear = std::min(clear, distance_from(centre, line) - 0.8 * letter_.height);
  }
  return clear;
}

LabelPlacer::Labelled LabelPlacer::place(const PaperLine& contour, const std::string& text) {
  const Way way(contour);
  const double half_width =
      0.5 * letter_.width * (static_cast<double>(width_in_columns(text)) + 1.0);
  std::optional<double> best;
  double best_score = 0.0;
  const double first = 1.5 * half_width;
  constexpr double candidates = 60.0;
  for (double i = 0.0; i <= candidates && way.length() > 4.0 * half_width; i += 1.0) {
    const double middle = first + (way.length() - 2.0 * first) * i / candidates;
    const double chord = distance(way.at(middle - half_width), way.at(middle + half_width));
    const double straightness = chord / (2.0 * half_width);
    const double clear = std::min({clearance(way.at(middle), contour, half_width),
                                   clearance(way.at(middle - half_width), contour, 0.0),
                                   clearance(way.at(middle + half_width), contour, 0.0)});
    if (straightness < 0.96 || clear <= 0.0) continue;
    const double from_middle = std::abs(2.0 * i / candidates - 1.0);
    const double score =
        std::min(clear, 4.0 * letter_.height) + letter_.height * (1.0 - from_middle);
    if (best && score <= best_score) continue;
    best = middle;
    best_score = score;
  }
  if (!best) return {std::nullopt, {contour}};
  const PaperPoint before = way.at(*best - half_width);
  const PaperPoint after = way.at(*best + half_width);
  const PaperPoint centre{0.5 * (before.right + after.right), 0.5 * (before.up + after.up)};
  taken_.push_back(centre);
  return {ContourLabel{text, centre, slope_of(before, after)},
          {way.part(0.0, *best - half_width), way.part(*best + half_width, way.length())}};
}

}  // namespace gearlash
