#include "input/target_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "input/units.hpp"

namespace gearlash {
namespace {

constexpr std::string_view blanks = " \t";
constexpr char forms[] =
    "must be no-hunting, or size, frequency, period or growth-at-rest, then <= or >=, then a "
    "limit, as in \"size <= 1 arcmin\"; several joined by \"and\"";

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// Between the words "and".
std::vector<std::string_view> conditions_of(std::string_view text) {
  constexpr std::string_view joint = " and ";
  std::vector<std::string_view> conditions;
  while (true) {
    const std::size_t end = text.find(joint);
    conditions.push_back(without_blanks(text.substr(0, end)));
    if (end == std::string_view::npos) return conditions;
    text.remove_prefix(end + joint.size());
  }
}

struct Condition {
  std::string_view quantity;
  bool is_at_most;
  std::string_view limit;
};

std::optional<Condition> split(std::string_view condition) {
  constexpr std::array<std::pair<std::string_view, bool>, 6> relations = {
      {{"<=", true}, {">=", false}, {"≤", true}, {"≥", false}, {"<", true}, {">", false}}};
  for (const auto& [relation, is_at_most] : relations) {
    const std::size_t place = condition.find(relation);
    if (place == std::string_view::npos) continue;
    return Condition{without_blanks(condition.substr(0, place)), is_at_most,
                     without_blanks(condition.substr(place + relation.size()))};
  }
  return std::nullopt;
}

class TargetReader {
 public:
  TargetReader(std::string_view field, TimeScale time_scale)
      : field_(field), time_scale_(time_scale) {}

  void read(std::string_view condition) {
    try {
      if (condition == "no-hunting" || condition == "no hunting") {
        target_.no_hunting = true;
        return;
      }
      const std::optional<Condition> parts = split(condition);
      if (!parts || parts->limit.empty()) refuse(condition, forms);
      add(condition, *parts);
    } catch (const InvalidInput& error) {
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
    }
  }

  Target target() {
    for (Fault& fault : validate(target_)) {
      fault.path = field_;
      faults_.push_back(std::move(fault));
    }
    require_none(std::move(faults_));
    return target_;
  }

 private:
  [[noreturn]] void refuse(std::string_view value, std::string permitted) const {
    throw InvalidInput({{std::string(field_), shown(value), std::move(permitted), ""}});
  }

  void add(std::string_view condition, const Condition& parts) {
    if (parts.quantity == "size") {
      restrict(target_.size, parts.is_at_most,
               not_negative(condition, read_angle(field_, parts.limit).si));
    } else if (parts.quantity == "frequency" || parts.quantity == "period") {
      add_pace(condition, parts);
    } else if (parts.quantity == "growth-at-rest" || parts.quantity == "growth_at_rest") {
      restrict(target_.growth_at_rest, parts.is_at_most,
               not_negative(condition, read_number(field_, parts.limit)));
    } else {
      refuse(condition, forms);
    }
  }

  void add_pace(std::string_view condition, const Condition& parts) {
    if (time_scale_ == TimeScale::unknown) {
      refuse(condition, "must be told of a servo with a natural_frequency, or of a data sheet");
    }
    if (parts.quantity == "frequency") {
      const double angular = to_si(field_, parts.limit, dimensions::angular_frequency);
      restrict(target_.frequency, parts.is_at_most,
               not_negative(condition, angular / (2.0 * std::numbers::pi)));
    } else {
      const double period = to_si(field_, parts.limit, dimensions::time);
      if (!(period > 0.0)) refuse(condition, "must have a positive limit");
      restrict(target_.frequency, !parts.is_at_most, 1.0 / period);
    }
  }

  double not_negative(std::string_view text, double limit) const {
    if (!(limit >= 0.0)) refuse(text, "must have a limit of 0 or more");
    return limit;
  }

  static void restrict(Bounds& limits, bool is_at_most, double limit) {
    if (is_at_most) {
      limits.high = std::min(limits.high, limit);
    } else {
      limits.low = std::max(limits.low, limit);
    }
  }

  std::string field_;
  TimeScale time_scale_;
  Target target_;
  std::vector<Fault> faults_;
};

}  // namespace

Target read_target(std::string_view field, std::string_view text, TimeScale time_scale) {
  TargetReader reader(field, time_scale);
  for (const std::string_view condition : conditions_of(text)) reader.read(condition);
  return reader.target();
}

}  // namespace gearlash
