#include "question/map/map_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <unordered_map>
#include <utility>

#include "base/on_threads.hpp"
#include "base/shared_progress.hpp"
#include "question/change/target.hpp"

namespace gearlash {
namespace {

constexpr std::array region_order = {
    PlaceKind::met,   PlaceKind::missed,    PlaceKind::rests,    PlaceKind::hunts_if_disturbed,
    PlaceKind::hunts, PlaceKind::runs_away, PlaceKind::not_known};

/// The kind of a place, by a fresh answer.
using KindAt = std::function<PlaceKind(const MapPoint&, Progress&)>;

/// The kinds of the points and where they change between two of them.
class Kinds {
 public:
  Kinds(const Grid& grid, std::span<const PlaceKind> points)
      : x_(grid.axes[1]), y_(grid.axes[0]), corners_(points) {
    for (std::size_t row = 0; row < y_.values.size(); ++row) {
      for (std::size_t column = 0; column < x_.values.size(); ++column) {
        const std::size_t here = point(column, row);
        if (column + 1 < x_.values.size() && corners_[here] != corners_[here + 1]) {
          edges_.push_back({column, row, true});
        }
        if (row + 1 < y_.values.size() && corners_[here] != corners_[here + x_.values.size()]) {
          edges_.push_back({column, row, false});
        }
      }
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) number_[id(edges_[i])] = i;
  }

  /// Locates the changes by fresh answers.
  void locate(const KindAt& kind_at, Progress& progress) {
    SharedProgress shared(progress, std::max<std::size_t>(1, edges_.size()));
    on_threads(0, edges_.size(), [&](std::size_t i) {
      edges_[i].change = change_on(edges_[i], kind_at, shared);
      shared.finish(1);
    });
  }

  /// The kind at a place of the map on a line of the grid, or at a cell's middle.
  PlaceKind at(const MapPoint& place) const {
    const auto [left, right] = around(x_, place.x);
    const auto [below, above] = around(y_, place.y);
    if (left == right && below == above) return corners_[point(left, below)];
    if (below == above) return on_edge({left, below, true}, position_on(x_, place.x));
    if (left == right) return on_edge({left, below, false}, position_on(y_, place.y));
    return corners_[point(left, below)];
  }

 private:
  struct Edge {
    std::size_t column = 0;
    std::size_t row = 0;
    bool is_along_x = true;
    double change = 0.0;  ///< position on the axis
  };

  std::size_t point(std::size_t column, std::size_t row) const {
    return row * x_.values.size() + column;
  }
  std::size_t id(const Edge& edge) const {
    return 2 * point(edge.column, edge.row) + (edge.is_along_x ? 0 : 1);
  }
  std::size_t end_of(const Edge& edge) const {
    return point(edge.column, edge.row) + (edge.is_along_x ? 1 : x_.values.size());
  }

  /// Numbers of the values on either side, the same of a value itself.
  static std::pair<std::size_t, std::size_t> around(const Axis& axis, double value) {
    const auto above = static_cast<std::size_t>(
        std::lower_bound(axis.values.begin(), axis.values.end(), value) - axis.values.begin());
    return {axis.values[above] == value ? above : above - 1, above};
  }

  PlaceKind on_edge(const Edge& edge, double position) const {
    const PlaceKind first = corners_[point(edge.column, edge.row)];
    const auto known = number_.find(id(edge));
    if (known == number_.end()) return first;
    return position < edges_[known->second].change ? first : corners_[end_of(edge)];
  }

  double change_on(const Edge& edge, const KindAt& kind_at, SharedProgress& progress) const {
    constexpr double near = 1.0 / 400.0;
    const Axis& axis = edge.is_along_x ? x_ : y_;
    const std::size_t first = edge.is_along_x ? edge.column : edge.row;
    const PlaceKind kind = corners_[point(edge.column, edge.row)];
    double low = position_on(axis, axis.values[first]);
    double high = position_on(axis, axis.values[first + 1]);
    while (high - low > near && !progress.is_stopped()) {
      const double middle = 0.5 * (low + high);
      const double value = value_at(axis, middle);
      const MapPoint place{edge.is_along_x ? value : x_.values[edge.column],
                           edge.is_along_x ? y_.values[edge.row] : value};
      (kind_at(place, progress) == kind ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  const Axis& x_;
  const Axis& y_;
  std::span<const PlaceKind> corners_;
  std::vector<Edge> edges_;
  std::unordered_map<std::size_t, std::size_t> number_;
};

/// The axis with a value on either side of it.
Axis widened(const Axis& axis) {
  constexpr double share = 0.01;
  const double low = axis.values.front();
  const double high = axis.values.back();
  Axis wide = axis;
  const double ratio = std::pow(high / low, share);
  const double aside = share * (high - low);
  wide.values.insert(wide.values.begin(), axis.logarithmic ? low / ratio : low - aside);
  wide.values.push_back(axis.logarithmic ? high * ratio : high + aside);
  return wide;
}

bool contains(const Axis& axis, double value) {
  return value >= axis.values.front() && value <= axis.values.back();
}

PlaceKind kind_at_place(const Family& family, const std::optional<Target>& target,
                        const MapPoint& place, Progress& progress) {
  PlaceKind kind{};
  AskedOfRows asked = asked_for_kinds(family, target, {&kind, 1});
  asked.one_by_one = asked.whole;
  const std::array values = {place.y, place.x};
  evaluate(family, rows_of(std::span<const double>(values), 2), asked, progress);
  return kind;
}

/// The sides of the points of the widened axes: all beyond the map are outside.
std::vector<Side> widened_sides(std::span<const PlaceKind> points, std::size_t width,
                                PlaceKind kind) {
  std::vector<Side> sides((points.size() / width + 2) * (width + 2), Side::outside);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i] == kind) sides[(i / width + 1) * (width + 2) + i % width + 1] = Side::inside;
  }
  return sides;
}

/// The regions whose places on the map have these kinds.
std::vector<MapRegion> outlined(const Grid& grid, std::span<const PlaceKind> points,
                                const std::function<PlaceKind(const MapPoint&)>& kind_at,
                                const CurveAccuracy& accuracy, Progress& progress) {
  const Axis& x = grid.axes[1];
  const Axis& y = grid.axes[0];
  const Axis wide_x = widened(x);
  const Axis wide_y = widened(y);
  std::vector<MapRegion> regions;
  for (const PlaceKind kind : region_order) {
    if (std::find(points.begin(), points.end(), kind) == points.end()) continue;
    const auto side_at = [&](const MapPoint& place) {
      const bool is_on_map = contains(x, place.x) && contains(y, place.y);
      return is_on_map && kind_at(place) == kind ? Side::inside : Side::outside;
    };
    const std::vector<Side> sides = widened_sides(points, x.values.size(), kind);
    regions.push_back(
        {kind, boundary_of_region(wide_x, wide_y, sides, side_at, accuracy, progress)});
  }
  return regions;
}

}  // namespace

PlaceKind kind_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::cannot_hunt:
    case Verdict::comes_to_rest:
      return PlaceKind::rests;
    case Verdict::hunts_if_disturbed:
      return PlaceKind::hunts_if_disturbed;
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
    case Verdict::forced:
    case Verdict::undamped:
      return PlaceKind::hunts;
    case Verdict::grows_without_bound:
    case Verdict::runs_away:
    case Verdict::runs_away_if_disturbed:
      return PlaceKind::runs_away;
    case Verdict::undecided:
      break;
  }
  return PlaceKind::not_known;
}

std::string_view name_of(PlaceKind kind) {
  switch (kind) {
    case PlaceKind::rests:
      return "comes to rest";
    case PlaceKind::hunts_if_disturbed:
      return "hunts if disturbed";
    case PlaceKind::hunts:
      return "hunts";
    case PlaceKind::runs_away:
      return "runs away";
    case PlaceKind::met:
      return "met";
    case PlaceKind::missed:
      return "missed";
    case PlaceKind::not_known:
      break;
  }
  return "not known";
}

PlaceKind kind_of(const Target& target, const Answer& answer) {
  if (!is_known(target, answer)) return PlaceKind::not_known;
  return is_met(target, answer) ? PlaceKind::met : PlaceKind::missed;
}

AskedOfRows asked_for_kinds(const Family& family, const std::optional<Target>& target,
                            std::span<PlaceKind> kinds) {
  AskedOfRows asked{.take = [&target, kinds](std::size_t row, const Answer* answer) {
    if (answer == nullptr) return;
    kinds[row] = target ? kind_of(*target, *answer) : kind_of(answer->verdict);
  }};
  if (!target) return asked;
  asked.wanted = wanted_for(*target, family.base());
  asked.whole = !is_of_boxes(*target);
  return asked;
}

bool has_regions(const Grid& grid) {
  return std::all_of(grid.axes.begin(), grid.axes.end(), [&](const Axis& axis) {
    return axis.values.size() > 1 && std::isfinite(axis.values.back()) &&
           parameter_of(axis, grid.drive)->choices.empty();
  });
}

std::vector<MapRegion> regions_of(const Grid& grid, std::span<const PlaceKind> points,
                                  const std::optional<Target>& target, Progress& progress) {
  const Family family(grid);
  const KindAt kind_at = [&](const MapPoint& place, Progress& heard) {
    return kind_at_place(family, target, place, heard);
  };
  if (!family.engines().search) {
    std::vector<MapRegion> regions = outlined(
        grid, points, [&](const MapPoint& place) { return kind_at(place, no_progress()); },
        picture_accuracy, progress);
    if (progress.go_on(1.0)) return regions;
  }
  Kinds kinds(grid, points);
  kinds.locate(kind_at, progress);
  constexpr CurveAccuracy straight_in_cells{.shortest_chord = 2.0};
  return outlined(
      grid, points, [&](const MapPoint& place) { return kinds.at(place); }, straight_in_cells,
      no_progress());
}

std::vector<MapCurve> borders_of(const std::vector<MapRegion>& regions, const Grid& grid) {
  constexpr double rounding = 1e-9;
  const auto is_at_edge = [&](std::size_t axis, double one, double other) {
    const double at = position_on(grid.axes[axis], one);
    const double there = position_on(grid.axes[axis], other);
    return std::max(at, there) < rounding || std::min(at, there) > 1.0 - rounding;
  };
  const auto is_edge = [&](const MapPoint& from, const MapPoint& to) {
    return is_at_edge(1, from.x, to.x) || is_at_edge(0, from.y, to.y);
  };
  std::vector<MapCurve> borders;
  const auto add = [&](MapCurve outline) {
    // A ring begins along an edge, if it has one, so that no border is cut in two.
    const auto edge = std::adjacent_find(outline.begin(), outline.end(), is_edge);
    if (edge != outline.end()) {
      outline.pop_back();
      std::rotate(outline.begin(), edge, outline.end());
      outline.push_back(outline.front());
    }
    MapCurve border;
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
      if (!is_edge(outline[i], outline[i + 1])) {
        if (border.empty()) border.push_back(outline[i]);
        border.push_back(outline[i + 1]);
      }
      const bool ends = i + 2 == outline.size() || is_edge(outline[i], outline[i + 1]);
      if (ends && !border.empty()) borders.push_back(std::exchange(border, {}));
    }
  };
  // Each border has two sides: the last region's is that of the others.
  for (std::size_t i = 0; i + 1 < regions.size(); ++i) {
    for (const MapCurve& outline : regions[i].outlines) add(outline);
  }
  return borders;
}

}  // namespace gearlash
