#include "picture/hatching.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

constexpr double spacing = 13.0;  ///< between lines, vertically, in pixels
constexpr double step = 2.0;      ///< along lines, horizontally

/// A line up = right + offset, and the places where a stretch of it may begin or end.
struct Diagonal {
  double offset;
  std::vector<double> rights;

  PaperPoint at(double right) const { return {right, right + offset}; }
};

/// All diagonals across the paper, each with its ends and its crossings of the boundary.
std::vector<Diagonal> diagonals(const std::vector<MapCurve>& boundary, const Paper& paper,
                                HatchLines which) {
  const double shift = which == HatchLines::second ? 0.5 * spacing : 0.0;
  const auto lowest = static_cast<long>(std::ceil(-panel_width / spacing));
  const auto highest = static_cast<long>(std::floor(paper.height() / spacing));
  std::map<long, Diagonal> lines;
  for (long i = lowest; i <= highest; ++i) {
    const double offset = spacing * static_cast<double>(i) + shift;
    lines[i] = {offset, {std::max(0.0, -offset), std::min(panel_width, paper.height() - offset)}};
  }
  for (const MapCurve& curve : boundary) {
    const PaperLine line = paper.on_paper(curve);
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const double from = line[k].imag() - line[k].real() - shift;
      const double to = line[k + 1].imag() - line[k + 1].real() - shift;
      const auto first = static_cast<long>(std::ceil(std::min(from, to) / spacing));
      for (long i = first; spacing * static_cast<double>(i) < std::max(from, to); ++i) {
        if (!lines.contains(i)) continue;
        const double share = (lines[i].offset - shift - from) / (to - from);
        lines[i].rights.push_back(line[k].real() + share * (line[k + 1].real() - line[k].real()));
      }
    }
  }
  std::vector<Diagonal> sorted;
  for (auto& [number, line] : lines) {
    std::sort(line.rights.begin(), line.rights.end());
    sorted.push_back(std::move(line));
  }
  return sorted;
}

/// Whether the corners of the cell around a point confirm rest: all are known, some are at rest,
/// and those have no limit cycle.
bool is_at_rest_for_good(const GridTable& table, const MapPoint& point) {
  const Axis& x = table.grid.axes[1];
  const std::size_t row = interval_of(table.grid.axes[0], point.y) * x.values.size();
  const std::size_t first = row + interval_of(x, point.x);
  bool any = false;
  for (const std::size_t corner :
       {first, first + 1, first + x.values.size(), first + x.values.size() + 1}) {
    const double growth = table.table[Quantity::growth_at_rest][corner];
    if (std::isnan(growth)) return false;
    if (growth > 1.0) continue;
    if (table.table.verdict(corner) != Verdict::cannot_hunt) return false;
    any = true;
  }
  return any;
}

/// Hatches the stretch from `begin` to `end`, which does not cross the boundary.
void hatch(const Hatched& hatched, const Paper& paper, const Diagonal& line, double begin,
           double end, std::vector<MapCurve>& lines) {
  const auto map_at = [&](double right) { return paper.on_map(line.at(right)); };
  if (!(end - begin > 0.1) || !hatched.stretch(map_at(0.5 * (begin + end)))) return;
  const double steps = hatched.left_out ? std::ceil((end - begin) / step) : 0.0;
  const auto place = [&](double i) { return begin + (end - begin) * i / steps; };
  double start = begin;
  for (double i = 0.0; i < steps; i += 1.0) {
    if (!hatched.left_out(map_at(0.5 * (place(i) + place(i + 1.0))))) continue;
    if (start < place(i)) lines.push_back({map_at(start), map_at(place(i))});
    start = place(i + 1.0);
  }
  if (start < end) lines.push_back({map_at(start), map_at(end)});
}

}  // namespace

std::vector<MapCurve> hatching(const std::vector<MapCurve>& boundary, const Paper& paper,
                               const Hatched& hatched, HatchLines which) {
  std::vector<MapCurve> lines;
  for (const Diagonal& line : diagonals(boundary, paper, which)) {
    for (std::size_t i = 0; i + 1 < line.rights.size(); ++i) {
      hatch(hatched, paper, line, line.rights[i], line.rights[i + 1], lines);
    }
  }
  return lines;
}

std::vector<MapCurve> hatching(const GridTable& table, const Paper& paper) {
  const Family family(table.grid);
  return hatching(
      table.hunting_boundary.value(), paper,
      {.stretch =
           [&](const MapPoint& middle) {
             return side_of_hunting(servo_at(family, middle)) == Side::outside;
           },
       .left_out = [&](const MapPoint& middle) { return !is_at_rest_for_good(table, middle); }});
}

}  // namespace gearlash
