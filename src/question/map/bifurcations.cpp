#include "question/map/bifurcations.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/lists.hpp"
#include "base/on_threads.hpp"
#include "base/shared_progress.hpp"
#include "base/special_numbers.hpp"
#include "question/map/cycle_following.hpp"

namespace gearlash {
namespace {

// ---- the values ---------------------------------------------------------------------------------

bool comes_to_rest(const Analysis& analysis) {
  if (analysis.search && !analysis.search->outcomes.empty()) {
    return analysis.search->count(drive::MotionEnd::rest) > 0;
  }
  const Verdict verdict = analysis.answer.verdict;
  return is_at_rest(verdict) || verdict == Verdict::hunts_if_disturbed;
}

bool may_run_away(const Analysis& analysis) {
  if (analysis.search) return analysis.search->count(drive::MotionEnd::diverges) > 0;
  return analysis.answer.verdict == Verdict::grows_without_bound;
}

/// The place between two positions on the axis at which a property changes, if it differs.
struct ChangeOnAxis {
  double parameter = 0.0;
  bool is_above = false;  ///< whether the property holds above the place
};

std::optional<ChangeOnAxis> change_between(AnalysedLine& line, const Axis& axis, std::size_t low,
                                           bool holds_low, bool holds_high,
                                           const std::function<bool(const Analysis&)>& holds,
                                           bool is_closed) {
  if (holds_low == holds_high) return std::nullopt;
  double from = position_on(axis, axis.values[low]);
  double to = position_on(axis, axis.values[low + 1]);
  for (int i = 0; i < (is_closed ? 40 : 6); ++i) {
    const double middle = 0.5 * (from + to);
    const AnalysedLine::Known there = line.afresh(value_at(axis, middle));
    if (!there) break;
    (holds(*there) == holds_low ? from : to) = middle;
  }
  return ChangeOnAxis{value_at(axis, 0.5 * (from + to)), holds_high};
}

// ---- chains of cycles ---------------------------------------------------------------------------

/// A cycle at a value of the axis, and what continues it.
struct Node {
  FollowedCycle cycle;
  bool has_previous = false;
  std::optional<std::size_t> next{};    ///< index among the nodes of the next value
  std::vector<FollowedCycle> after{};   ///< on the way to the next, or to where the branch ends
  std::vector<FollowedCycle> before{};  ///< on the way down to where it begins, if it has none
};

using Column = std::vector<Node>;

CycleAt point_of(const FollowedCycle& followed) {
  const drive::FoundCycle& cycle = followed.cycle;
  const auto& multipliers = cycle.orbit.multipliers;
  return {.parameter = followed.parameter,
          .stability = cycle.stability,
          .amplitude = cycle.amplitude,
          .motor_amplitude = cycle.motor_amplitude,
          .period = cycle.period(),
          .multiplier = multipliers.empty() ? std::complex<double>(cycle.multiplier, 0.0)
                                            : multipliers.front(),
          .events = cycle.orbit.events.size()};
}

/// Between two cycles of a branch, as if its numbers were linear.
CycleAt point_between(const CycleAt& one, const CycleAt& other, double parameter) {
  const double share = (parameter - one.parameter) / (other.parameter - one.parameter);
  const auto between = [&](const auto& a, const auto& b) { return a + share * (b - a); };
  CycleAt point = one;
  point.parameter = parameter;
  point.amplitude = between(one.amplitude, other.amplitude);
  point.motor_amplitude = between(one.motor_amplitude, other.motor_amplitude);
  point.period = between(one.period, other.period);
  point.multiplier = between(one.multiplier, other.multiplier);
  return point;
}

/// At the parameter of the first.
CycleAt middle_of(const CycleAt& one, const CycleAt& other) {
  CycleAt middle = one;
  middle.amplitude = 0.5 * (one.amplitude + other.amplitude);
  middle.motor_amplitude = 0.5 * (one.motor_amplitude + other.motor_amplitude);
  middle.period = 0.5 * (one.period + other.period);
  return middle;
}

/// Where a branch ends, away from the ends of the axis.
struct BranchTip {
  CycleAt point;
  Border border;          ///< by following the cycle as far as the next value
  bool is_upper = false;  ///< no cycle above it
  std::size_t branch = 0;
};

class Chains {
 public:
  Chains(const Drive& drive, const Axis& axis, const std::vector<AnalysedLine::Known>& values,
         SharedProgress& progress)
      : axis_(axis),
        drive_(drives_along(axis, drive)),
        progress_(progress),
        following_(drive, axis, progress),
        columns_(values.size()) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!values[i] || !values[i]->search) continue;
      const drive::AttractorSearch& search = *values[i]->search;
      for (const drive::FoundCycle& cycle : search.cycles) {
        columns_[i].push_back({.cycle = following_.known(axis.values[i], search, cycle)});
      }
    }
  }

  void follow() {
    for (std::size_t i = 0; i + 1 < columns_.size() && !progress_.is_stopped(); ++i) {
      for (std::size_t k = 0; k < columns_[i].size(); ++k) follow_up(i, k);
      progress_.finish(1);
    }
    for (std::size_t i = columns_.size() - 1; i > 0 && !progress_.is_stopped(); --i) {
      for (std::size_t k = 0; k < columns_[i].size(); ++k) {
        if (!columns_[i][k].has_previous) follow_down(i, k);
      }
    }
  }

  void write(BifurcationDiagram& diagram) const {
    std::vector<BranchTip> tips;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      for (std::size_t k = 0; k < columns_[i].size(); ++k) {
        if (!columns_[i][k].has_previous) write_chain(i, k, diagram, tips);
      }
    }
    name_tips(tips, diagram);
  }

 private:
  void follow_up(std::size_t i, std::size_t k) {
    FollowedWay way = following_.to(columns_[i][k].cycle, axis_.values[i + 1]);
    Node& node = columns_[i][k];
    node.after = std::move(way.passed);
    if (!way.end) return;
    node.next = place_in(i + 1, *way.end);
    columns_[i + 1][*node.next].has_previous = true;
  }

  void follow_down(std::size_t i, std::size_t k) {
    FollowedWay way = following_.to(columns_[i][k].cycle, axis_.values[i - 1]);
    if (!way.end) {
      columns_[i][k].before = std::move(way.passed);
      return;
    }
    const std::size_t place = place_in(i - 1, *way.end);
    Node& lower = columns_[i - 1][place];
    if (lower.next) return;
    std::reverse(way.passed.begin(), way.passed.end());
    lower.next = k;
    lower.after = std::move(way.passed);
    columns_[i][k].has_previous = true;
  }

  std::size_t place_in(std::size_t i, const FollowedCycle& found) {
    Column& column = columns_[i];
    for (std::size_t k = 0; k < column.size(); ++k) {
      if (is_same_cycle(column[k].cycle.cycle, found.cycle)) return k;
    }
    column.push_back({.cycle = found});
    return column.size() - 1;
  }

  void write_chain(std::size_t i, std::size_t k, BifurcationDiagram& diagram,
                   std::vector<BranchTip>& tips) const {
    std::vector<FollowedCycle> chain(columns_[i][k].before.rbegin(), columns_[i][k].before.rend());
    const std::size_t first_branch = diagram.branches.size();
    bool ends = false;
    for (std::size_t column = i; column < columns_.size(); ++column) {
      const Node& node = columns_[column][k];
      chain.push_back(node.cycle);
      add_all(chain, node.after);
      if (!node.next) {
        ends = column + 1 < columns_.size();
        break;
      }
      k = *node.next;
    }
    split(chain, diagram);
    if (i > 0) tips.push_back(tip_of(chain.front(), false, first_branch));
    if (ends) tips.push_back(tip_of(chain.back(), true, diagram.branches.size() - 1));
  }

  BranchTip tip_of(const FollowedCycle& last, bool is_upper, std::size_t branch) const {
    const std::vector<double>& values = axis_.values;  // rising
    const double from = last.parameter;
    const double to = is_upper ? *std::upper_bound(values.begin(), values.end(), from)
                               : *std::prev(std::lower_bound(values.begin(), values.end(), from));
    return {.point = point_of(last),
            .border = end_of_cycle(drive_, last.cycle, from, to, progress_),
            .is_upper = is_upper,
            .branch = branch};
  }

  /// Branches of one stability each. They meet where the stability changes.
  void split(const std::vector<FollowedCycle>& chain, BifurcationDiagram& diagram) const {
    CycleBranch branch{.stability = chain.front().cycle.stability};
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const CycleAt here = point_of(chain[i]);
      if (here.stability != branch.stability) {
        const CycleAt last = branch.points.back();
        const Border border =
            end_of_cycle(drive_, chain[i - 1].cycle, last.parameter, here.parameter, progress_);
        const bool is_named = border.kind != BorderKind::unnamed;
        const double parameter = is_named ? border.at : 0.5 * (last.parameter + here.parameter);
        const CycleAt there = point_between(last, here, parameter);
        diagram.borders.push_back({.parameter = parameter,
                                   .word = is_named ? name_of(border.kind) : "stability changes",
                                   .cycle = there});
        branch.points.push_back(there);
        diagram.branches.push_back(std::move(branch));
        branch = {.stability = here.stability, .points = {there}};
      }
      branch.points.push_back(here);
    }
    diagram.branches.push_back(std::move(branch));
  }

  double position(double parameter) const { return position_on(axis_, parameter); }

  /// Both branches are drawn to their fold, or to where their events change.
  static void meet(const BranchTip& tip, const CycleAt& place, BifurcationDiagram& diagram) {
    CycleBranch& branch = diagram.branches[tip.branch];
    CycleAt end = tip.point;
    end.parameter = place.parameter;
    end.amplitude = place.amplitude;
    end.motor_amplitude = place.motor_amplitude;
    end.period = place.period;
    branch.points.insert(tip.is_upper ? branch.points.end() : branch.points.begin(), end);
  }

  /// Whether two tips are one place, as far as the last steps tell.
  bool are_together(const CycleAt& one, const CycleAt& other, double intervals) const {
    constexpr double alike = 0.25;  // of the amplitude
    const double interval = 1.0 / static_cast<double>(axis_.values.size() - 1);
    const double size = std::max(one.motor_amplitude, other.motor_amplitude);
    return std::abs(position(one.parameter) - position(other.parameter)) < intervals * interval &&
           std::abs(one.amplitude - other.amplitude) < alike * size &&
           std::abs(one.motor_amplitude - other.motor_amplitude) < alike * size;
  }

  /// Whether a stable and an unstable branch end together.
  static bool is_fold(const BranchTip& tip, const BranchTip& other) {
    return other.is_upper == tip.is_upper && other.point.stability != tip.point.stability;
  }

  /// Of the tips from `first` on that have no name yet, the one at which the same happens.
  std::size_t partner_of(const BranchTip& tip, const std::vector<BranchTip>& tips,
                         std::size_t first, const std::vector<bool>& is_named) const {
    constexpr double near = 0.02;  // of an interval: some of the last steps
    for (std::size_t i = first; i < tips.size(); ++i) {
      const BranchTip& other = tips[i];
      if (is_named[i] || !are_together(tip.point, other.point, near)) continue;
      const bool is_change =
          other.is_upper != tip.is_upper && other.point.events != tip.point.events;
      if (is_fold(tip, other) || is_change) return i;
    }
    return tips.size();
  }

  /// Of two borders the one that is named, and located more closely.
  static const Border& better_known(const Border& one, const Border& other) {
    if (one.kind == BorderKind::unnamed || other.kind == BorderKind::unnamed) {
      return one.kind == BorderKind::unnamed ? other : one;
    }
    return other.located < one.located ? other : one;
  }

  /// What is seen at two tips, of which neither was followed to a border.
  static Border border_seen(const BranchTip& tip, const BranchTip& other) {
    const auto [low, high] = std::minmax(tip.point.parameter, other.point.parameter);
    if (!is_fold(tip, other)) return {.at = 0.5 * (low + high)};
    return {.kind = BorderKind::fold, .at = tip.is_upper ? high : low};  // both are on one side
  }

  void name_tips(const std::vector<BranchTip>& tips, BifurcationDiagram& diagram) const {
    std::vector<bool> is_named(tips.size(), false);
    for (std::size_t i = 0; i < tips.size(); ++i) {
      if (is_named[i]) continue;
      const BranchTip& tip = tips[i];
      const std::size_t partner = partner_of(tip, tips, i + 1, is_named);
      const bool has_partner = partner < tips.size();
      Border border = tip.border;
      CycleAt place = tip.point;
      if (has_partner) {
        const BranchTip& other = tips[partner];
        is_named[partner] = true;
        border = better_known(border, other.border);
        if (border.kind == BorderKind::unnamed) border = border_seen(tip, other);
        place = middle_of(tip.point, other.point);
      }
      const bool is_lost = !has_partner && border.kind == BorderKind::unnamed;
      if (!is_lost) {
        place.parameter = border.at;
        meet(tip, place, diagram);
        if (has_partner) meet(tips[partner], place, diagram);
      }
      diagram.borders.push_back({.parameter = place.parameter,
                                 .word = is_lost ? "cycle is lost"
                                         : border.kind == BorderKind::unnamed
                                             ? "events change"
                                             : name_of(border.kind),
                                 .cycle = place});
    }
  }

  const Axis& axis_;
  DriveAlong drive_;
  SharedProgress& progress_;
  CycleFollowing following_;
  std::vector<Column> columns_;
};

// ---- closed form --------------------------------------------------------------------------------

CycleAt point_of(const Cycle& cycle, double parameter) {
  return {.parameter = parameter,
          .stability = cycle.stability,
          .amplitude = cycle.amplitude,
          .motor_amplitude = cycle.motor_amplitude,
          .period = cycle.period,
          .multiplier = cycle.multiplier,
          .events = cycle.events_per_period};
}

/// Joins cycles of one value to those of the next.
class ClosedBranches {
 public:
  explicit ClosedBranches(BifurcationDiagram& diagram) : diagram_(diagram) {}

  /// The cycles at the next value. Each continues the nearest branch.
  void add(const std::vector<Cycle>& cycles, double parameter) {
    std::vector<std::size_t> still_open;
    for (const Cycle& cycle : cycles) {
      const CycleAt point = point_of(cycle, parameter);
      const bool is_only = cycles.size() == 1 && open_.size() == 1;  // of plastic contact
      const std::optional<std::size_t> nearest =
          is_only ? std::optional(open_.front()) : nearest_to(point);
      if (nearest) open_.erase(std::find(open_.begin(), open_.end(), *nearest));
      still_open.push_back(continued(nearest, point));
    }
    open_ = std::move(still_open);
  }

 private:
  std::optional<std::size_t> nearest_to(const CycleAt& point) const {
    constexpr double alike = 0.3;
    constexpr double same_kind = 1.7;  // of periods: a flip doubles it
    std::optional<std::size_t> chosen;
    double nearest = alike * std::max(point.motor_amplitude, point.amplitude);
    for (const std::size_t branch : open_) {
      const CycleAt& last = diagram_.branches[branch].points.back();
      const double away = std::abs(last.amplitude - point.amplitude);
      const bool has_period =
          std::max(last.period, point.period) < same_kind * std::min(last.period, point.period);
      if (!has_period || away > nearest) continue;
      nearest = away;
      chosen = branch;
    }
    return chosen;
  }

  std::size_t continued(std::optional<std::size_t> branch, const CycleAt& point) {
    if (branch && diagram_.branches[*branch].stability == point.stability) {
      diagram_.branches[*branch].points.push_back(point);
      return *branch;
    }
    CycleBranch begun{.stability = point.stability};
    if (branch) {
      const CycleAt last = diagram_.branches[*branch].points.back();
      const bool is_lost = point.stability == Stability::unstable;
      CycleAt middle = is_lost ? middle_of(point, last) : middle_of(last, point);
      middle.parameter = 0.5 * (last.parameter + point.parameter);
      diagram_.branches[*branch].points.push_back(middle);
      begun.points.push_back(middle);
      diagram_.borders.push_back(
          {.parameter = middle.parameter,
           // A positive number may be the modulus of a pair.
           .word = middle.multiplier.real() < 0.0 ? "flip" : "stability changes",
           .cycle = middle});
    }
    begun.points.push_back(point);
    diagram_.branches.push_back(std::move(begun));
    return diagram_.branches.size() - 1;
  }

  BifurcationDiagram& diagram_;
  std::vector<std::size_t> open_;  ///< branches that the last value continued
};

/// With plastic contact the one cycle vanishes where rest is lost.
void extend_to_rest(double parameter, bool rests_above, double half_gap,
                    BifurcationDiagram& diagram) {
  const CycleAt end{.parameter = parameter,
                    .amplitude = 0.0,
                    .motor_amplitude = half_gap,
                    .period = infinity,
                    .multiplier = 1.0};
  CycleBranch* nearest = nullptr;
  double least = infinity;
  for (CycleBranch& branch : diagram.branches) {
    const CycleAt& tip = rests_above ? branch.points.back() : branch.points.front();
    const double away = rests_above ? parameter - tip.parameter : tip.parameter - parameter;
    if (away < 0.0 || away > least) continue;
    least = away;
    nearest = &branch;
  }
  if (nearest == nullptr) return;
  nearest->points.insert(rests_above ? nearest->points.end() : nearest->points.begin(), end);
}

// ---- the whole ----------------------------------------------------------------------------------

void add_rest_and_runaway(AnalysedLine& line, const Axis& axis,
                          const std::vector<AnalysedLine::Known>& values,
                          BifurcationDiagram& diagram) {
  std::optional<double> rests_from;
  double last = axis.values.front();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) {
      if (rests_from) diagram.rests.push_back({*rests_from, last});
      rests_from.reset();
      continue;
    }
    const bool rests = comes_to_rest(*values[i]);
    if (i > 0 && values[i - 1] && !line.is_stopped()) {
      const Analysis& below = *values[i - 1];
      const bool is_closed = below.closed && values[i]->closed;
      if (const auto change = change_between(line, axis, i - 1, comes_to_rest(below), rests,
                                             comes_to_rest, is_closed)) {
        if (change->is_above) rests_from = change->parameter;
        if (!change->is_above) diagram.rests.push_back({*rests_from, change->parameter});
        if (!change->is_above) rests_from.reset();
        diagram.borders.push_back({.parameter = change->parameter,
                                   .word = "loss of rest",
                                   .cycle = CycleAt{.parameter = change->parameter}});
        if (is_closed && values[i]->servo->servo.restitution == 0.0) {
          extend_to_rest(change->parameter, change->is_above, 0.5 * values[i]->reduced.backlash,
                         diagram);
        }
      }
      if (const auto change = change_between(line, axis, i - 1, may_run_away(below),
                                             may_run_away(*values[i]), may_run_away, is_closed)) {
        diagram.borders.push_back(
            {.parameter = change->parameter, .word = "border of running away", .cycle = {}});
      }
    }
    if (rests && !rests_from) rests_from = axis.values[i];
    last = axis.values[i];
  }
  if (rests_from) diagram.rests.push_back({*rests_from, last});
}

}  // namespace

BifurcationDiagram bifurcations_of(const Drive& drive, const Axis& axis, Progress& progress) {
  const std::size_t count = axis.values.size();
  SharedProgress shared(progress, 3 * count);
  AnalysedLine line(drives_along(axis, drive), {.proofs = false}, count, shared);
  const auto values = of_each_on_threads(axis.values, [&](double value) {
    const AnalysedLine::Known there = shared.is_stopped() ? nullptr : line.afresh(value);
    shared.finish(2);
    return there;
  });
  BifurcationDiagram diagram;
  for (std::size_t i = 0; i < count; ++i) {
    if (!values[i]) continue;
    if (values[i]->search) ++diagram.searched;
    for (const IrregularMotion& motion : values[i]->answer.irregular) {
      diagram.irregular.push_back({.parameter = axis.values[i],
                                   .amplitude = motion.amplitude,
                                   .motor_amplitude = motion.motor_amplitude.value_or(NAN)});
    }
  }
  Chains chains(drive, axis, values, shared);
  chains.follow();
  chains.write(diagram);
  ClosedBranches closed(diagram);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_closed = values[i] && values[i]->closed;
    closed.add(is_closed ? values[i]->answer.cycles : std::vector<Cycle>{}, axis.values[i]);
  }
  add_rest_and_runaway(line, axis, values, diagram);
  diagram.is_complete = !shared.is_stopped();
  return diagram;
}

}  // namespace gearlash
