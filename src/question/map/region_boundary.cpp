#include "question/map/region_boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "base/shared_progress.hpp"
#include "question/map/side_bisection.hpp"

namespace gearlash {
namespace {

using SideAt = std::function<Side(const MapPoint&)>;

/// A place in shares of the axes: the drawn plane except for its width and height.
struct Place {
  double along = 0.0;
  double up = 0.0;
};

/// An edge of the grid, numbered by its first point (x fastest) and its direction.
using EdgeId = std::size_t;

/// The boundary within a cell, from the edge where it enters to the edge where it leaves.
struct Crossing {
  EdgeId enters;
  EdgeId leaves;
};

/// Whether both ends lie on a finite scale; a logarithmic axis is always positive.
bool is_drawable(const Axis& axis) {
  return axis.values.size() > 1 && std::isfinite(axis.values.front()) &&
         std::isfinite(axis.values.back());
}

class BoundaryFinder {
 public:
  BoundaryFinder(const Axis& x, const Axis& y, std::span<const Side> corners, const SideAt& side_at,
                 const CurveAccuracy& accuracy, Progress& progress)
      : x_(x), y_(y), corners_(corners), side_at_(side_at), accuracy_(accuracy), whole_(progress) {
    progress_.emplace(progress, 1);
  }

  std::vector<MapCurve> curves() {
    find_crossings();
    locate_edges();
    std::vector<MapCurve> curves = joined();
    for (MapCurve& curve : curves) curve = refined(curve);
    return curves;
  }

 private:
  Side corner(std::size_t column, std::size_t row) const {
    return corners_[row * x_.values.size() + column];
  }
  EdgeId along_x(std::size_t column, std::size_t row) const {
    return 2 * (row * x_.values.size() + column);
  }
  EdgeId along_y(std::size_t column, std::size_t row) const { return along_x(column, row) + 1; }

  Side asked(const MapPoint& place) const {
    return progress_->go_on(0.0) ? side_at_(place) : Side::unknown;
  }

  void find_crossings();
  void cross_cell(std::size_t column, std::size_t row);
  Side middle_of_cell(std::size_t column, std::size_t row) const;
  void locate_edges();
  std::optional<MapPoint> on_edge(EdgeId edge) const;
  std::vector<MapCurve> joined() const;
  MapCurve refined(const MapCurve& curve) const;
  void divide(const Place& from, const Place& to, MapCurve& points) const;
  std::optional<Place> across_middle(const Place& from, const Place& to) const;

  Place place_of(const MapPoint& point) const {
    return {position_on(x_, point.x), position_on(y_, point.y)};
  }
  MapPoint point_at(const Place& place) const {
    return {value_at(x_, place.along), value_at(y_, place.up)};
  }

  /// The boundary between a place inside and one outside; empty where the other side
  /// turns out to be unknown.
  template <class At>
  std::optional<double> between(const At& at, double inside, double outside) const {
    const SideChange change = bisect_sides([&](double place) { return asked(at(place)); }, inside,
                                           outside, accuracy_.halvings);
    if (change.beyond == Side::unknown) return std::nullopt;
    return accuracy_.is_midway ? 0.5 * (change.place + change.outside) : change.place;
  }

  const Axis& x_;
  const Axis& y_;
  std::span<const Side> corners_;
  const SideAt& side_at_;
  CurveAccuracy accuracy_;
  Progress& whole_;
  mutable std::optional<SharedProgress> progress_;
  std::vector<Crossing> crossings_;
  std::unordered_map<EdgeId, MapPoint> points_;
};

void BoundaryFinder::find_crossings() {
  for (std::size_t row = 0; row + 1 < y_.values.size(); ++row) {
    for (std::size_t column = 0; column + 1 < x_.values.size(); ++column) cross_cell(column, row);
  }
}

/// Goes around the cell counterclockwise. The boundary has the inside on its left, so it enters the
/// cell where the corners change from inside to outside and leaves where they change back.
void BoundaryFinder::cross_cell(std::size_t column, std::size_t row) {
  const std::array corners = {corner(column, row), corner(column + 1, row),
                              corner(column + 1, row + 1), corner(column, row + 1)};
  const std::array edges = {along_x(column, row), along_y(column + 1, row),
                            along_x(column, row + 1), along_y(column, row)};
  std::vector<EdgeId> enters;
  std::vector<EdgeId> leaves;
  for (std::size_t i = 0; i < 4; ++i) {
    if (corners[i] == Side::unknown) return;
    const Side next = corners[(i + 1) % 4];
    if (corners[i] == Side::inside && next == Side::outside) enters.push_back(edges[i]);
    if (corners[i] == Side::outside && next == Side::inside) leaves.push_back(edges[i]);
  }
  // With four crossings, each entry is joined to the exit that follows it, around an outside
  // corner, or to the exit before it, around an inside corner.
  const bool four = enters.size() == 2;
  const bool follows = corners[0] == Side::inside;
  const bool turn = four && (middle_of_cell(column, row) == Side::inside) != follows;
  for (std::size_t i = 0; i < enters.size(); ++i) {
    crossings_.push_back({enters[i], leaves[turn ? 1 - i : i]});
  }
}

Side BoundaryFinder::middle_of_cell(std::size_t column, std::size_t row) const {
  const Place low = place_of({x_.values[column], y_.values[row]});
  const Place high = place_of({x_.values[column + 1], y_.values[row + 1]});
  return asked(point_at({0.5 * (low.along + high.along), 0.5 * (low.up + high.up)}));
}

void BoundaryFinder::locate_edges() {
  std::vector<EdgeId> edges;
  for (const Crossing& crossing : crossings_) {
    edges.push_back(crossing.enters);
    edges.push_back(crossing.leaves);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  progress_.emplace(whole_, std::max<std::size_t>(1, edges.size()));
  const auto places = of_each_on_threads(edges, [&](EdgeId edge) {
    const std::optional<MapPoint> place = on_edge(edge);
    progress_->finish(1);
    return place;
  });
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (places[i]) points_.emplace(edges[i], *places[i]);
  }
  std::erase_if(crossings_, [&](const Crossing& crossing) {
    return !points_.contains(crossing.enters) || !points_.contains(crossing.leaves);
  });
}

std::optional<MapPoint> BoundaryFinder::on_edge(EdgeId edge) const {
  const std::size_t column = edge / 2 % x_.values.size();
  const std::size_t row = edge / 2 / x_.values.size();
  const bool is_along_x = edge % 2 == 0;
  const Axis& axis = is_along_x ? x_ : y_;
  const std::size_t first = is_along_x ? column : row;
  const bool inside_first = corner(column, row) == Side::inside;
  const auto at = [&](double position) {
    const double value = value_at(axis, position);
    return is_along_x ? MapPoint{value, y_.values[row]} : MapPoint{x_.values[column], value};
  };
  const double from = position_on(axis, axis.values[first]);
  const double to = position_on(axis, axis.values[first + 1]);
  const auto position = between(at, inside_first ? from : to, inside_first ? to : from);
  if (!position) return std::nullopt;
  return at(*position);
}

/// An edge is entered by at most one cell and left by at most one.
std::vector<MapCurve> BoundaryFinder::joined() const {
  std::unordered_map<EdgeId, EdgeId> next;
  std::unordered_map<EdgeId, bool> is_left;
  for (const Crossing& crossing : crossings_) {
    next[crossing.enters] = crossing.leaves;
    is_left[crossing.leaves] = true;
  }
  std::vector<MapCurve> curves;
  const auto follow = [&](EdgeId edge) {
    MapCurve curve = {points_.at(edge)};
    for (auto step = next.find(edge); step != next.end(); step = next.find(edge)) {
      edge = step->second;
      next.erase(step);
      curve.push_back(points_.at(edge));
    }
    curves.push_back(std::move(curve));
  };
  for (const Crossing& crossing : crossings_) {
    if (!is_left.contains(crossing.enters)) follow(crossing.enters);
  }
  for (const Crossing& crossing : crossings_) {  // the remaining crossings form rings
    if (next.contains(crossing.enters)) follow(crossing.enters);
  }
  return curves;
}

MapCurve BoundaryFinder::refined(const MapCurve& curve) const {
  std::vector<MapCurve> inserted(curve.size() - 1);
  on_threads(0, inserted.size(), [&](std::size_t i) {
    divide(place_of(curve[i]), place_of(curve[i + 1]), inserted[i]);
  });
  MapCurve fine;
  for (std::size_t i = 0; i < inserted.size(); ++i) {
    fine.push_back(curve[i]);
    add_all(fine, inserted[i]);
  }
  fine.push_back(curve.back());
  return fine;
}

void BoundaryFinder::divide(const Place& from, const Place& to, MapCurve& points) const {
  // A longer chord may cross the boundary at its middle although the boundary deviates to both
  // sides.
  constexpr double longest_chord = 0.03;
  const double length = std::hypot(to.along - from.along, to.up - from.up);
  if (!(length > accuracy_.shortest_chord)) return;
  const std::optional<Place> between = across_middle(from, to);
  if (!between) return;
  const double deviation = std::hypot(between->along - 0.5 * (from.along + to.along),
                                      between->up - 0.5 * (from.up + to.up));
  if (deviation < accuracy_.straightness && length < longest_chord) return;
  divide(from, *between, points);
  points.push_back(point_at(*between));
  divide(*between, to, points);
}

/// The boundary on the perpendicular through the chord's middle, at most half the chord's length
/// away, or a tenth of the axes: the tip of a sharp corner may lie far from a short chord. The
/// region is on the left of the chord.
std::optional<Place> BoundaryFinder::across_middle(const Place& from, const Place& to) const {
  const Place middle{0.5 * (from.along + to.along), 0.5 * (from.up + to.up)};
  const Side side = asked(point_at(middle));
  if (side == Side::unknown) return std::nullopt;
  const double turn = side == Side::inside ? 1.0 : -1.0;  // to the right, or to the left
  const auto at = [&](double share) {
    return Place{std::clamp(middle.along + turn * share * (to.up - from.up), 0.0, 1.0),
                 std::clamp(middle.up - turn * share * (to.along - from.along), 0.0, 1.0)};
  };
  constexpr double farthest_tip = 0.1;  // beyond half the chord
  const double length = std::hypot(to.along - from.along, to.up - from.up);
  double near = 0.0;
  for (const double far : {1.0 / 64.0, 1.0 / 16.0, 1.0 / 4.0, 1.0 / 2.0, 1.0, 2.0, 4.0}) {
    if (far > 0.5 && far * length > farthest_tip) break;
    const Side there = asked(point_at(at(far)));
    if (there == Side::unknown) return std::nullopt;
    if (there == side) {
      near = far;
      continue;
    }
    const auto share = side == Side::inside
                           ? between([&](double s) { return point_at(at(s)); }, near, far)
                           : between([&](double s) { return point_at(at(s)); }, far, near);
    if (!share) return std::nullopt;
    return at(*share);
  }
  return std::nullopt;
}

}  // namespace

std::vector<MapCurve> boundary_of_region(const Axis& x, const Axis& y,
                                         std::span<const Side> corners, const SideAt& side_at,
                                         const CurveAccuracy& accuracy, Progress& progress) {
  if (!is_drawable(x) || !is_drawable(y)) return {};
  return BoundaryFinder(x, y, corners, side_at, accuracy, progress).curves();
}

}  // namespace gearlash
