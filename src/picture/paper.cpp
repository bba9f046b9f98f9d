#include "picture/paper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/lists.hpp"
#include "gearlash/output.hpp"
#include "picture/plot_making.hpp"

namespace gearlash {
namespace {

constexpr double unseen = 0.15;
constexpr double letter_width = 9.2;
constexpr double half_letter = 6.5;  ///< of a text's height

double distance_from_chord(const PaperPoint& point, const PaperPoint& from, const PaperPoint& to) {
  const PaperPoint chord = to - from;
  if (std::norm(chord) == 0.0) return std::abs(point - from);
  const double share =
      std::clamp((std::conj(chord) * (point - from)).real() / std::norm(chord), 0.0, 1.0);
  return std::abs(point - from - share * chord);
}

double distance_from_line(const PaperPoint& point, const PaperLine& line) {
  double nearest =
      line.empty() ? std::numeric_limits<double>::infinity() : std::abs(point - line.front());
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    nearest = std::min(nearest, distance_from_chord(point, line[i], line[i + 1]));
  }
  return nearest;
}

void keep_outliers(const PaperLine& line, std::size_t first, std::size_t last,
                   std::vector<bool>& kept) {
  double farthest = unseen;
  std::size_t outlier = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double away = distance_from_chord(line[i], line[first], line[last]);
    if (away <= farthest) continue;
    farthest = away;
    outlier = i;
  }
  if (outlier == first) return;
  kept[outlier] = true;
  keep_outliers(line, first, outlier, kept);
  keep_outliers(line, outlier, last, kept);
}

/// The width in pixels, without the "_" of subscripts.
double width_of(const std::string& text, double size) {
  const auto marks = std::count(text.begin(), text.end(), '_');
  return size * letter_width *
         (static_cast<double>(width_in_columns(text)) - static_cast<double>(marks));
}

/// The line up to a way along it, and the rest.
std::pair<PaperLine, PaperLine> cut(const PaperLine& line, double way) {
  std::size_t next = 1;
  while (next + 1 < line.size() && way > std::abs(line[next] - line[next - 1])) {
    way -= std::abs(line[next] - line[next - 1]);
    ++next;
  }
  const double chord = std::abs(line[next] - line[next - 1]);
  const PaperPoint at =
      line[next - 1] + (chord > 0.0 ? way / chord : 0.0) * (line[next] - line[next - 1]);
  const auto middle = line.begin() + static_cast<std::ptrdiff_t>(next);
  std::pair<PaperLine, PaperLine> parts{{line.begin(), middle}, {at}};
  parts.first.push_back(at);
  parts.second.insert(parts.second.end(), middle, line.end());
  return parts;
}

double slope_of(const PaperPoint& direction) {
  const double slope = std::arg(direction) * 180.0 / std::numbers::pi;
  return slope > 90.0 ? slope - 180.0 : slope <= -90.0 ? slope + 180.0 : slope;
}

}  // namespace

PaperPoint Paper::on_paper(const MapPoint& point) const {
  return {panel_width * position_on(x_, point.x), height_ * position_on(y_, point.y)};
}

MapPoint Paper::on_map(const PaperPoint& point) const {
  return {value_at(x_, point.real() / panel_width), value_at(y_, point.imag() / height_)};
}

PaperLine Paper::on_paper(const MapCurve& curve) const {
  return of_each(curve, [&](const MapPoint& point) { return on_paper(point); });
}

MapCurve Paper::on_map(const PaperLine& line) const {
  return of_each(line, [&](const PaperPoint& point) { return on_map(point); });
}

double length_of(const PaperLine& line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += std::abs(line[i] - line[i + 1]);
  return length;
}

double area_within(const PaperLine& line) {
  double twice = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    twice += (std::conj(line[i]) * line[i + 1]).imag();
  }
  return 0.5 * twice;
}

PaperLine thinned(const PaperLine& line) {
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  keep_outliers(line, 0, line.size() - 1, kept);
  PaperLine thin;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) thin.push_back(line[i]);
  }
  return thin;
}

PaperLine TextPlacer::middle_of(const Spot& spot) {
  const double parts = std::ceil(2.0 * std::abs(spot.half) / half_letter) + 1.0;
  PaperLine points;
  for (double i = 0.0; i <= parts; i += 1.0) {
    points.push_back(spot.centre + (2.0 * i / parts - 1.0) * spot.half);
  }
  return points;
}

std::optional<std::size_t> TextPlacer::take_best(const std::vector<Spot>& spots, double enough,
                                                 bool must, const PaperLine* own) {
  std::optional<std::size_t> best;
  double best_score = -std::numeric_limits<double>::infinity();
  for (const std::size_t i : indices(spots.size())) {
    const double clear = clearance(spots[i], own);
    const double score = std::min(clear, enough) + spots[i].merit;
    if ((clear <= 0.0 && !must) || score <= best_score) continue;
    best_score = score;
    best = i;
  }
  if (best) add_all(taken_, middle_of(spots[*best]));
  return best;
}

std::optional<PaperPoint> TextPlacer::beside(const PaperPoint& point, const std::string& text,
                                             double size, bool must) {
  const double half_width = 0.5 * width_of(text, size);
  std::vector<Spot> spots;
  for (const double distance : {5.0, 12.0, 22.0, 36.0}) {
    for (int direction = 0; direction < 16; ++direction) {
      const PaperPoint way = std::polar(1.0, std::numbers::pi * direction / 8.0);
      spots.push_back({point + PaperPoint{way.real() * (half_width + distance),
                                          way.imag() * (half_letter + distance)},
                       half_width, -0.02 * distance});
    }
  }
  constexpr double enough = 4.0;  // pixels
  const auto best = take_best(spots, enough, must, nullptr);
  return best ? std::optional(spots[*best].centre) : std::nullopt;
}

std::optional<TextPlacer::InLine> TextPlacer::along(const PaperLine& line, const std::string& text,
                                                    double size) {
  constexpr int candidates = 60;
  constexpr double straight = 0.96;
  const double length = length_of(line);
  const double gap = width_of(text, size) + letter_width;
  std::vector<Spot> spots;
  std::vector<double> begins;
  for (int i = 0; i <= candidates && length > 2.0 * gap; ++i) {
    const double share = static_cast<double>(i) / candidates;
    const double begin = 0.25 * gap + (length - 1.5 * gap) * share;
    const PaperLine within = cut(cut(line, begin).second, gap).first;
    const PaperPoint way = within.back() - within.front();
    if (std::abs(way) < straight * gap) continue;
    spots.push_back({within.front() + 0.5 * way, 0.5 * way,
                     2.0 * half_letter * (1.0 - std::abs(2.0 * share - 1.0))});
    begins.push_back(begin);
  }
  const auto best = take_best(spots, 8.0 * half_letter, false, &line);
  if (!best) return std::nullopt;
  return InLine{spots[*best].centre,
                slope_of(spots[*best].half),
                {cut(line, begins[*best]).first, cut(line, begins[*best] + gap).second}};
}

double TextPlacer::clearance(const Spot& spot, const PaperLine* own) const {
  double clear = std::numeric_limits<double>::infinity();
  for (const PaperPoint& point : middle_of(spot)) {
    clear = std::min({clear, point.real(), panel_width - point.real(), point.imag() - half_letter,
                      height_ - point.imag() - half_letter});
    for (const PaperPoint& other : taken_) {
      clear = std::min(clear, std::abs(point - other) - 2.0 * half_letter);
    }
    for (const PaperLine& line : lines_) {
      if (own != nullptr && !line.empty() && line.front() == own->front()) continue;
      clear = std::min(clear, distance_from_line(point, line) - half_letter);
    }
  }
  return clear;
}

}  // namespace gearlash
