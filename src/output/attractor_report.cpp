#include "output/attractor_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "output/columns.hpp"
#include "output/json_values.hpp"
#include "picture/line_chart.hpp"

namespace gearlash {
namespace {

using drive::FoundCycle;
using drive::IrregularFound;
using drive::MotionEnd;

constexpr int headline_digits = 3;
constexpr int table_digits = 6;

std::string number(double value) { return significant(value, table_digits); }

const char* time_unit(const AttractorReport& report) {
  return report.file.is_normalized ? "/ ω_n" : "s";
}
const char* speed_unit(const AttractorReport& report) {
  return report.file.is_normalized ? "rad ω_n" : "rad/s";
}

std::string swing(const AttractorReport& report, double size, int digits) {
  return swing_text(size, report.file.backlash_unit, digits);
}

std::string angle(const AttractorReport& report, double radians) {
  const AngleUnit& unit = report.file.backlash_unit;
  return number(unit.from_radians(radians)) + " " + unit.name;
}

std::string pace(const AttractorReport& report, double period, int digits) {
  if (report.file.is_normalized)
    return fmt::format(", period {} / ω_n", significant(period, digits + 1));
  return fmt::format(" at {} Hz", significant(1.0 / period, digits));
}

std::string starts_text(std::size_t count) {
  return fmt::format("{} start{}", count, count == 1 ? "" : "s");
}

// ---- tables -------------------------------------------------------------------------------------

using Rows = std::vector<std::vector<std::string>>;

std::string of_backlash(const AttractorReport& report, double size) {
  return number(size / report.file.drive.backlash) + " of the backlash";
}

const char* text_of(drive::Stability stability) {
  switch (stability) {
    case drive::Stability::stable:
      return "stable";
    case drive::Stability::neutral:
      return "neither stable nor unstable";
    case drive::Stability::unstable:
      return "unstable";
  }
  return "";
}

/// Times with faces together and apart within a period.
struct ContactTimes {
  double together = 0.0;
  double apart = 0.0;
};

ContactTimes contact_times(const AttractorReport& report, const FoundCycle& cycle) {
  const drive::DriveSystem system = drive::drive_system(report.file.drive);
  ContactTimes times;
  double from = cycle.orbit.start_time;
  std::size_t mode = cycle.orbit.start.mode;
  const auto add = [&](double to) {
    const bool is_apart = system.modes.mode(mode).contact == drive::ContactState::apart;
    (is_apart ? times.apart : times.together) += to - from;
    from = to;
  };
  for (const hybrid::Event& event : cycle.orbit.events) {
    add(event.time);
    mode = event.mode_after;
  }
  add(cycle.orbit.start_time + cycle.orbit.period);
  return times;
}

std::string cycle_title(const FoundCycle& cycle) {
  std::string title = fmt::format("{}, {}", cycle.is_symmetric ? "symmetric" : "not symmetric",
                                  text_of(cycle.stability));
  if (cycle.has_mirror_image) title += ", and its mirror image";
  return title;
}

std::string cycle_text(const AttractorReport& report, const FoundCycle& cycle) {
  const ContactTimes times = contact_times(report, cycle);
  const double period = cycle.period();
  Rows rows = {
      {"size, load", swing(report, cycle.size, table_digits), of_backlash(report, cycle.size)},
      {"size, motor", swing(report, cycle.motor_size, table_digits),
       of_backlash(report, cycle.motor_size)},
      {"middle, from the reference", angle(report, cycle.is_symmetric ? 0.0 : cycle.center), ""},
      {"period", number(period) + " " + time_unit(report), ""}};
  if (!report.file.is_normalized) rows.push_back({"frequency", number(1.0 / period) + " Hz", ""});
  rows.push_back({"largest multiplier", number(cycle.multiplier),
                  cycle.stability == drive::Stability::unstable ? "disturbances grow"
                                                                : "disturbances die away"});
  if (cycle.impact_speed > 0.0) {
    rows.push_back({"hardest impact", number(cycle.impact_speed) + " " + speed_unit(report), ""});
  }
  rows.push_back({"faces together", number(times.together) + " " + time_unit(report),
                  fmt::format("{:.1f} % of a period", 100.0 * times.together / period)});
  rows.push_back({"faces apart", number(times.apart) + " " + time_unit(report),
                  fmt::format("{:.1f} % of a period", 100.0 * times.apart / period)});
  rows.push_back({"events in a period", std::to_string(cycle.orbit.events.size()), ""});
  rows.push_back({"reached from", starts_text(cycle.starts), ""});
  return "\nLimit cycle: " + cycle_title(cycle) + "\n" + table_text(rows);
}

std::string extent(const AttractorReport& report, const drive::Extent& extent) {
  const AngleUnit& unit = report.file.backlash_unit;
  const double low = unit.from_radians(extent.lowest);
  const double high = unit.from_radians(extent.highest);
  if (high - low <= 1e-9 * std::max(std::abs(low), std::abs(high)))
    return angle(report, extent.lowest);
  return fmt::format("{} … {} {}", number(low), number(high), unit.name);
}

std::string rest_text(const AttractorReport& report) {
  const drive::RestFound& rest = *report.search.rest;
  Rows rows = {{"load, from the reference", extent(report, rest.load), ""},
               {"motor, from the reference", extent(report, rest.motor), ""},
               {"reached from", starts_text(rest.starts), ""}};
  if (!std::isnan(rest.swing_ratio)) {
    rows.push_back({"neared by swings, ratio", number(rest.swing_ratio), "never quite reached"});
  }
  return "\nRest\n" + table_text(rows);
}

std::string irregular_text(const AttractorReport& report, const IrregularFound& motion) {
  const auto spread = [&](double mean, double deviation) {
    return fmt::format("spread {:.2g} %", 100.0 * deviation / mean);
  };
  const bool is_chaotic = motion.exponent * motion.watched > 10.0;
  const std::string title = motion.is_motor_alone
                                ? "The motor hunts within the gap, while the load hardly moves"
                                : "Motion that was not seen to repeat";
  return "\n" + title + "\n" +
         table_text(
             {{"size, load", swing(report, motion.size, table_digits),
               of_backlash(report, motion.size)},
              {"size, motor", swing(report, motion.motor_size, table_digits),
               of_backlash(report, motion.motor_size)},
              {"middle, from the reference", angle(report, motion.center), ""},
              {"mean swing", swing(report, motion.half_swing, table_digits),
               spread(motion.half_swing, motion.half_swing_deviation)},
              {"mean period", number(motion.period) + " " + time_unit(report),
               spread(motion.period, motion.period_deviation)},
              {"swings that repeat, but for", fmt::format("{:.2g} %", 100.0 * motion.mismatch), ""},
              {"neighbours part at a rate of",
               number(motion.exponent) + (report.file.is_normalized ? " ω_n" : " /s"),
               is_chaotic ? "chaotic" : ""},
              {"watched for", number(motion.watched) + " " + time_unit(report), ""},
              {"reached from", starts_text(motion.starts), ""}});
}

// ---- what was searched --------------------------------------------------------------------------

std::string search_text(const AttractorReport& report) {
  const drive::AttractorSearch& search = report.search;
  const double reference = drive::value_at(drive::settled(report.file.drive.reference), 0.0);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (const drive::Outcome& outcome : search.outcomes) {
    const double distance = std::abs(outcome.start.load_position - reference);
    if (distance > 0.0) nearest = std::min(nearest, distance);
    farthest = std::max(farthest, distance);
  }
  std::string text = fmt::format(
      "Searched from {}, with the load {} to {} from the reference, each watched for up to {} {}: ",
      starts_text(search.outcomes.size()), angle(report, nearest), angle(report, farthest),
      significant(search.watch_time, headline_digits), report.file.is_normalized ? "/ ω_n" : "s");
  std::vector<std::string> ends;
  const auto add = [&](MotionEnd end, const char* what) {
    const std::size_t count = search.count(end);
    if (count > 0) ends.push_back(fmt::format("{} {}", count, what));
  };
  add(MotionEnd::cycle, "to a cycle");
  add(MotionEnd::rest, "to rest");
  add(MotionEnd::irregular, "to motion that was not seen to repeat");
  add(MotionEnd::diverges, "away without end");
  add(MotionEnd::undecided, "undecided");
  for (std::size_t i = 0; i < ends.size(); ++i) text += (i == 0 ? "" : ", ") + ends[i];
  text += ". Cycles were closed by shooting; ";
  const auto found = std::count_if(search.edges.begin(), search.edges.end(),
                                   [](const drive::Edge& edge) { return edge.cycle.has_value(); });
  text += search.edges.empty()
              ? "no border between starts that led elsewhere had to be searched. "
              : fmt::format(
                    "{} of {} borders between starts that led elsewhere are unstable "
                    "cycles. ",
                    found, search.edges.size());
  if (!search.is_complete) text += "The search was stopped before its end. ";
  text += "A search is no proof: what no start leads to is not seen.";
  return text;
}

std::string reasons_text(const AttractorReport& report) {
  std::set<std::string> reasons;
  for (const drive::Outcome& outcome : report.search.outcomes) {
    if (outcome.end == MotionEnd::undecided && !outcome.reason.empty()) {
      reasons.insert(outcome.reason);
    }
  }
  std::string text;
  for (const std::string& reason : reasons) text += wrapped("Undecided: " + reason + ".");
  return text;
}

std::string coordinates_text(const AttractorReport& report) {
  switch (report.search.coordinates) {
    case drive::Coordinates::fixed:
      return {};
    case drive::Coordinates::co_moving:
      return wrapped("The reference is a ramp: all is told from where it is at the time.");
    case drive::Coordinates::in_place:
      return wrapped(
          "The reference is a ramp that encoder or controller do not move along with: "
          "motion was measured, cycles were not closed.");
  }
  return {};
}

// ---- JSON ---------------------------------------------------------------------------------------

Json json_cycle(const AttractorReport& report, const FoundCycle& cycle) {
  const ContactTimes times = contact_times(report, cycle);
  return {{"kind", cycle.is_symmetric ? "symmetric" : "asymmetric"},
          {"stable", cycle.stability == drive::Stability::stable},
          {"stability", text_of(cycle.stability)},
          {"size", json_number(cycle.size)},
          {"motor_size", json_number(cycle.motor_size)},
          {"center", json_number(cycle.center)},
          {"period", json_number(cycle.period())},
          {"frequency", json_number(1.0 / cycle.period())},
          {"multiplier", json_number(cycle.multiplier)},
          {"impact_speed", json_number(cycle.impact_speed)},
          {"engaged_time", json_number(times.together)},
          {"separated_time", json_number(times.apart)},
          {"residual", json_number(cycle.orbit.residual)},
          {"events_per_period", cycle.orbit.events.size()},
          {"mirror_image", cycle.has_mirror_image},
          {"starts", cycle.starts}};
}

Json json_extent(const drive::Extent& extent) {
  return {json_number(extent.lowest), json_number(extent.highest)};
}

Json json_irregular(const IrregularFound& motion) {
  return {{"size", json_number(motion.size)},
          {"motor_size", json_number(motion.motor_size)},
          {"motor_alone", motion.is_motor_alone},
          {"center", json_number(motion.center)},
          {"mean_swing", json_number(motion.half_swing)},
          {"swing_deviation", json_number(motion.half_swing_deviation)},
          {"mean_period", json_number(motion.period)},
          {"period_deviation", json_number(motion.period_deviation)},
          {"mismatch", json_number(motion.mismatch)},
          {"exponent", json_number(motion.exponent)},
          {"watched", json_number(motion.watched)},
          {"starts", motion.starts}};
}

const char* name_of(MotionEnd end) {
  switch (end) {
    case MotionEnd::rest:
      return "rest";
    case MotionEnd::cycle:
      return "cycle";
    case MotionEnd::irregular:
      return "irregular";
    case MotionEnd::diverges:
      return "diverges";
    case MotionEnd::undecided:
      return "undecided";
  }
  return "";
}

Json json_outcome(const drive::Outcome& outcome) {
  Json json = {{"load_position", json_number(outcome.start.load_position)},
               {"load_speed", json_number(outcome.start.load_speed)},
               {"motor_position", json_number(outcome.start.motor_position)},
               {"motor_speed", json_number(outcome.start.motor_speed)},
               {"end", name_of(outcome.end)},
               {"watched", json_number(outcome.watched)}};
  if (outcome.end == MotionEnd::cycle || outcome.end == MotionEnd::irregular) {
    json["which"] = outcome.which;
  }
  if (!outcome.reason.empty()) json["reason"] = outcome.reason;
  return json;
}

Json json_search(const AttractorReport& report) {
  Json starts = Json::array();
  for (const drive::Outcome& outcome : report.search.outcomes) {
    starts.push_back(json_outcome(outcome));
  }
  return {{"watch_time", json_number(report.search.watch_time)},
          {"complete", report.search.is_complete},
          {"borders", report.search.edges.size()},
          {"starts", std::move(starts)}};
}

}  // namespace

std::string verdict_line(const AttractorReport& report) {
  const drive::DriveVerdict verdict = drive::verdict_of(report.search);
  const std::string name = drive::name_of(verdict, report.file.drive);
  const FoundCycle* cycle = drive::largest_stable(report.search);
  const auto swings = [&]() -> std::string {
    if (cycle != nullptr) {
      return swing(report, cycle->size, headline_digits) +
             pace(report, cycle->period(), headline_digits);
    }
    const IrregularFound& motion = report.search.irregular.front();
    if (motion.is_motor_alone) {
      return "the motor within the gap, " + swing(report, motion.motor_size, headline_digits) +
             pace(report, motion.period, headline_digits) + ", while the load hardly moves";
    }
    return "up to " + swing(report, motion.size, headline_digits) +
           pace(report, motion.period, headline_digits);
  };
  switch (verdict) {
    case drive::DriveVerdict::hunts:
    case drive::DriveVerdict::hunts_irregularly:
    case drive::DriveVerdict::hunts_if_disturbed:
      return name + ": " + swings();
    case drive::DriveVerdict::comes_to_rest:
      return fmt::format("{} from all {}", name, starts_text(report.search.outcomes.size()));
    default:
      return name;
  }
}

std::string attractor_text(const AttractorReport& report) {
  std::string text = verdict_line(report) + "\n";
  for (const FoundCycle& cycle : report.search.cycles) text += cycle_text(report, cycle);
  for (const IrregularFound& motion : report.search.irregular) {
    text += irregular_text(report, motion);
  }
  if (report.search.rest) text += rest_text(report);
  return text + "\n" + coordinates_text(report) + wrapped(search_text(report)) +
         reasons_text(report);
}

std::string attractor_json(const AttractorReport& report) {
  const drive::AttractorSearch& search = report.search;
  Json cycles = Json::array();
  for (const FoundCycle& cycle : search.cycles) cycles.push_back(json_cycle(report, cycle));
  Json irregular = Json::array();
  for (const IrregularFound& motion : search.irregular) irregular.push_back(json_irregular(motion));
  const bool normalized = report.file.is_normalized;
  Json json = {
      {"servo", nullptr},
      {"growth_at_rest", nullptr},
      {"method", "piecewise-affine hybrid system: simulation from several starts, shooting"},
      {"verdict", drive::name_of(drive::verdict_of(search))},
      {"units", {{"time", normalized ? "1/omega_n" : "s"}, {"angle", "rad"}}},
      {"cycles", std::move(cycles)},
      {"irregular", std::move(irregular)},
      {"rest", nullptr},
      {"search", json_search(report)}};
  if (search.rest) {
    json["rest"] = {{"load", json_extent(search.rest->load)},
                    {"motor", json_extent(search.rest->motor)},
                    {"error", json_extent(search.rest->error)},
                    {"starts", search.rest->starts}};
  }
  const FoundCycle* cycle = drive::largest_stable(search);
  if (cycle != nullptr && !normalized) {
    json["physical"] = {{"size", json_number(cycle->size)},
                        {"motor_size", json_number(cycle->motor_size)},
                        {"period", json_number(cycle->period())},
                        {"frequency", json_number(1.0 / cycle->period())},
                        {"impact_speed", json_number(cycle->impact_speed)}};
  }
  json["provenance"] = json_provenance(report.provenance);
  return json.dump(2) + "\n";
}

// ---- picture ------------------------------------------------------------------------------------

namespace {

struct Curves {
  ChartCurve load;
  ChartCurve motor;
};

/// In the unit of the backlash; positions from the reference.
Curves curves_of(const AttractorReport& report, const hybrid::Trajectory& motion, double from,
                 const hybrid::AffineForm& reference) {
  const AngleUnit& unit = report.file.backlash_unit;
  constexpr int samples = 4000;
  Curves curves;
  for (int i = 0; i <= samples; ++i) {
    const hybrid::State state = motion.at(from + (motion.end_time() - from) * i / samples);
    const drive::ShaftStates shafts = drive::shafts_of(state);
    const double at = reference.at(state.numbers);
    curves.load.line.push_back(
        {unit.from_radians(shafts.load_position - at), unit.from_radians(shafts.load_speed)});
    curves.motor.line.push_back(
        {unit.from_radians(shafts.motor_position - at), unit.from_radians(shafts.motor_speed)});
  }
  return curves;
}

Curves curves_of(const AttractorReport& report, const FoundCycle& cycle) {
  const double from = cycle.orbit.start_time;
  const hybrid::Trajectory motion = hybrid::simulate(
      report.search.system, cycle.orbit.start, {.from = from, .until = from + cycle.period()});
  // The search's positions are from the reference.
  return curves_of(report, motion, from, {hybrid::Vector::Zero(report.search.system.size()), 0.0});
}

/// Some of its mean periods, as far on as it was watched.
Curves curves_of(const AttractorReport& report, const IrregularFound& irregular,
                 const drive::Outcome& outcome) {
  constexpr double periods = 5.0;
  drive::Drive drive = report.file.drive;
  drive.reference = drive::settled(drive.reference);
  drive.load_torque = drive::settled(drive.load_torque);
  const drive::DriveSystem system = drive::drive_system(drive);
  const hybrid::Trajectory motion = hybrid::simulate(
      system.system, drive::drive_start(drive, system, outcome.start), {.until = outcome.watched});
  const double from = std::max(0.0, motion.end_time() - periods * irregular.period);
  return curves_of(report, motion, from, system.reference);
}

}  // namespace

std::string draw_attractor(const AttractorReport& report, PictureFormat format) {
  const AngleUnit& unit = report.file.backlash_unit;
  LineChart chart;
  chart.title = verdict_line(report);
  chart.subtitle =
      "backlash " + number(unit.from_radians(report.file.drive.backlash)) + " " + unit.name;
  chart.x.label = "position from the reference, " + unit.name;
  chart.y.label = fmt::format("speed, {}{}", unit.name, report.file.is_normalized ? " ω_n" : "/s");
  chart.empty_meaning = "no cycle was found";
  const auto add = [&](Curves curves, const std::string& what) {
    curves.load.name = "load, " + what;
    curves.motor.name = "motor, " + what;
    chart.curves.push_back(std::move(curves.load));
    chart.curves.push_back(std::move(curves.motor));
  };
  for (const FoundCycle& cycle : report.search.cycles) {
    add(curves_of(report, cycle), std::string(text_of(cycle.stability)) + " cycle");
  }
  if (chart.curves.empty() && !report.search.irregular.empty()) {
    const auto outcome =
        std::find_if(report.search.outcomes.begin(), report.search.outcomes.end(),
                     [](const drive::Outcome& one) { return one.end == MotionEnd::irregular; });
    add(curves_of(report, report.search.irregular[outcome->which], *outcome), "for some periods");
  }
  return draw_line_chart(chart, format);
}

}  // namespace gearlash
