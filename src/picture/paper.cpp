#include "picture/paper.hpp"

#include <algorithm>
#include <cmath>

namespace gearlash {
namespace {

Axis scale_of(const ChartAxis& axis) {
  return {.values = {axis.low.value(), axis.high.value()}, .logarithmic = axis.logarithmic};
}

void keep_outliers(const PaperLine& line, std::size_t first, std::size_t last, double tolerance,
                   std::vector<bool>& kept) {
  double farthest = tolerance;
  std::size_t outlier = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double away = distance_from_chord(line[i], line[first], line[last]);
    if (away <= farthest) continue;
    farthest = away;
    outlier = i;
  }
  if (outlier == first) return;
  kept[outlier] = true;
  keep_outliers(line, first, outlier, tolerance, kept);
  keep_outliers(line, outlier, last, tolerance, kept);
}

}  // namespace

double distance(const PaperPoint& one, const PaperPoint& other) {
  return std::hypot(one.right - other.right, one.up - other.up);
}

double distance_from_chord(const PaperPoint& point, const PaperPoint& from, const PaperPoint& to) {
  const double right = to.right - from.right;
  const double up = to.up - from.up;
  const double length_squared = right * right + up * up;
  if (length_squared == 0.0) return distance(point, from);
  const double share = std::clamp(
      ((point.right - from.right) * right + (point.up - from.up) * up) / length_squared, 0.0, 1.0);
  return distance(point, {from.right + share * right, from.up + share * up});
}

double length_of(const PaperLine& line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += distance(line[i], line[i + 1]);
  return length;
}

double area_within(const PaperLine& line) {
  double twice = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    twice += line[i].right * line[i + 1].up - line[i + 1].right * line[i].up;
  }
  return 0.5 * twice;
}

Paper::Paper(const ChartAxis& x, const ChartAxis& y) : x_(scale_of(x)), y_(scale_of(y)) {}

PaperPoint Paper::point_on_paper(const MapPoint& point) const {
  return {width * position_on(x_, point.x), height * position_on(y_, point.y)};
}

MapPoint Paper::point_on_map(const PaperPoint& point) const {
  return {value_at(x_, point.right / width), value_at(y_, point.up / height)};
}

PaperLine Paper::line_on_paper(const MapCurve& curve) const {
  PaperLine line;
  line.reserve(curve.size());
  for (const MapPoint& point : curve) line.push_back(point_on_paper(point));
  return line;
}

PaperLine thinned(const PaperLine& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  keep_outliers(line, 0, line.size() - 1, tolerance, kept);
  PaperLine thin;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) thin.push_back(line[i]);
  }
  return thin;
}

}  // namespace gearlash
