#include "question/map/motion_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "base/on_threads.hpp"
#include "base/shared_progress.hpp"

namespace gearlash {
namespace {

constexpr std::array motion_kinds = {MotionKind::rests, MotionKind::hunts_if_disturbed,
                                     MotionKind::hunts, MotionKind::runs_away,
                                     MotionKind::not_known};

/// The kinds of the points and where they change between two of them.
class Kinds {
 public:
  Kinds(const Grid& grid, const Table& table) : x_(grid.axes[1]), y_(grid.axes[0]) {
    for (const Verdict verdict : table.verdicts()) corners_.push_back(kind_of(verdict));
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

  bool has(MotionKind kind) const {
    return std::find(corners_.begin(), corners_.end(), kind) != corners_.end();
  }

  /// Locates the changes by searches.
  void locate(const Family& family, Progress& progress) {
    SharedProgress shared(progress, std::max<std::size_t>(1, edges_.size()));
    on_threads(0, edges_.size(), [&](std::size_t i) {
      edges_[i].change = change_on(edges_[i], family, shared);
      shared.finish(1);
    });
  }

  /// The kind at a place on a line of the grid, or at a cell's middle; none beyond the map.
  std::optional<MotionKind> at(const MapPoint& place) const {
    const auto [left, right] = around(x_, place.x);
    const auto [below, above] = around(y_, place.y);
    if (right >= x_.values.size() || above >= y_.values.size()) return std::nullopt;
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

  /// Numbers of the values on either side, the same of a value itself; beyond the axis both are
  /// its length.
  static std::pair<std::size_t, std::size_t> around(const Axis& axis, double value) {
    const std::size_t count = axis.values.size();
    const auto above = static_cast<std::size_t>(
        std::lower_bound(axis.values.begin(), axis.values.end(), value) - axis.values.begin());
    if (above == count) return {count, count};
    if (axis.values[above] == value) return {above, above};
    return above == 0 ? std::pair{count, count} : std::pair{above - 1, above};
  }

  MotionKind on_edge(const Edge& edge, double position) const {
    const MotionKind first = corners_[point(edge.column, edge.row)];
    const auto known = number_.find(id(edge));
    if (known == number_.end()) return first;
    return position < edges_[known->second].change ? first : corners_[end_of(edge)];
  }

  double change_on(const Edge& edge, const Family& family, SharedProgress& progress) const {
    constexpr double near = 1.0 / 400.0;
    const Axis& axis = edge.is_along_x ? x_ : y_;
    const std::size_t first = edge.is_along_x ? edge.column : edge.row;
    const MotionKind kind = corners_[point(edge.column, edge.row)];
    double low = position_on(axis, axis.values[first]);
    double high = position_on(axis, axis.values[first + 1]);
    while (high - low > near && !progress.is_stopped()) {
      const double middle = 0.5 * (low + high);
      const double value = value_at(axis, middle);
      const std::array place = {edge.is_along_x ? y_.values[edge.row] : value,
                                edge.is_along_x ? value : x_.values[edge.column]};
      const Verdict there = answer_at(family, place, Quantity::verdict, progress).verdict;
      (kind_of(there) == kind ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  const Axis& x_;
  const Axis& y_;
  std::vector<MotionKind> corners_;
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

}  // namespace

MotionKind kind_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::cannot_hunt:
    case Verdict::comes_to_rest:
      return MotionKind::rests;
    case Verdict::hunts_if_disturbed:
      return MotionKind::hunts_if_disturbed;
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
    case Verdict::forced:
    case Verdict::undamped:
      return MotionKind::hunts;
    case Verdict::grows_without_bound:
    case Verdict::runs_away:
    case Verdict::runs_away_if_disturbed:
      return MotionKind::runs_away;
    case Verdict::undecided:
      break;
  }
  return MotionKind::not_known;
}

std::string_view name_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::rests:
      return "comes to rest";
    case MotionKind::hunts_if_disturbed:
      return "hunts if disturbed";
    case MotionKind::hunts:
      return "hunts";
    case MotionKind::runs_away:
      return "runs away";
    case MotionKind::not_known:
      break;
  }
  return "not known";
}

std::vector<MotionRegion> motion_regions(const Grid& grid, const Table& table, Progress& progress) {
  Kinds map(grid, table);
  map.locate(Family(grid), progress);
  const Axis x = widened(grid.axes[1]);
  const Axis y = widened(grid.axes[0]);
  std::vector<MotionRegion> regions;
  for (const MotionKind kind : motion_kinds) {
    if (!map.has(kind)) continue;
    const auto side_at = [&](const MapPoint& place) {
      return map.at(place) == kind ? Side::inside : Side::outside;
    };
    std::vector<Side> corners;
    for (const double up : y.values) {
      for (const double along : x.values) corners.push_back(side_at({along, up}));
    }
    constexpr CurveAccuracy straight_in_cells{.shortest_chord = 2.0};
    regions.push_back({kind, boundary_of_region(x, y, corners, side_at, straight_in_cells)});
  }
  return regions;
}

std::vector<MapCurve> borders_of(const std::vector<MotionRegion>& regions, const Grid& grid) {
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
