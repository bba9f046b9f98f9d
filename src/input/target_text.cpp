#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/lists.hpp"
#include "gearlash/input.hpp"
#include "gearlash/units.hpp"
#include "input/section_reader.hpp"
#include "model/quantities.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash {
namespace {

constexpr char target_forms[] =
    "must be no-hunting, no-hunting-if-disturbed or no-runaway, or a quantity such as amplitude, "
    "frequency, period, growth-at-rest, ceiling, bandwidth, overshoot or static-error, then <= or "
    ">=, then a limit, as in \"amplitude <= 1 arcmin\"; several joined by \"and\"";

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
    return Condition{trimmed(condition.substr(0, place)), is_at_most,
                     trimmed(condition.substr(place + relation.size()))};
  }
  return std::nullopt;
}

bool has_time(Quantity quantity) {
  const Dimension* dimension = entry_of(quantity).dimension;
  return dimension == &dimensions::time || dimension == &dimensions::rate ||
         dimension == &dimensions::angular_speed;
}

class TargetReader {
 public:
  TargetReader(std::string_view field, TimeScale time_scale, BareNumbers bare_numbers)
      : field_(field), time_scale_(time_scale), bare_numbers_(bare_numbers) {}

  void read(std::string_view condition) {
    try {
      std::string word(condition);
      std::replace(word.begin(), word.end(), ' ', '-');
      if (bool* flag = flag_of(word)) {
        *flag = true;
        return;
      }
      const std::optional<Condition> parts = split(condition);
      if (!parts || parts->limit.empty()) refuse(field_, condition, why_incomplete(condition));
      add(condition, *parts);
    } catch (const InvalidInput& error) {
      for (Fault fault : error.faults()) {
        fault.value = shown(condition);
        faults_.push_back(std::move(fault));
      }
    }
  }

  Target target(std::string_view text) {
    for (Fault& fault : faults(target_)) {
      fault.path = field_;
      fault.value = shown(text);
      faults_.push_back(std::move(fault));
    }
    require_none(std::move(faults_));
    return target_;
  }

 private:
  bool* flag_of(std::string_view word) {
    if (word == "no-hunting") return &target_.no_hunting;
    if (word == "no-hunting-if-disturbed") return &target_.no_hunting_if_disturbed;
    if (word == "no-runaway") return &target_.no_runaway;
    return nullptr;
  }

  /// Of a word, or of a quantity without relation or limit.
  static std::string why_incomplete(std::string_view condition) {
    const std::string quantity(trimmed(condition.substr(0, condition.find_first_of("<>=≤≥"))));
    if (!find_quantity(quantity)) return why_unknown(quantity);
    return "must be " + quantity + " <= LIMIT or " + quantity + " >= LIMIT, with the limit's unit";
  }

  static std::string why_unknown(std::string_view name) {
    const std::string guess = guess_of(known_words(), name);
    return guess.empty() ? target_forms : "must name a quantity or a condition" + guess;
  }

  static std::vector<std::string> known_words() {
    std::vector<std::string> words = {"no-hunting", "no-hunting-if-disturbed", "no-runaway"};
    for (std::string& name : names_of_quantities(QuantityKind::number)) {
      std::replace(name.begin(), name.end(), '_', '-');
      words.push_back(std::move(name));
    }
    return words;
  }

  void add(std::string_view condition, const Condition& parts) {
    const std::optional<Quantity> quantity = find_quantity(parts.quantity);
    if (!quantity || info_of(*quantity).kind != QuantityKind::number) {
      refuse(field_, condition, why_unknown(parts.quantity));
    }
    if (parts.limit.find_first_of("<>") != std::string_view::npos) {
      refuse(field_, condition, "must have \"and\" between its conditions");
    }
    const bool is_period = quantity == Quantity::period;
    if (time_scale_ == TimeScale::unknown && has_time(*quantity)) {
      refuse(field_, condition,
             "needs a time scale: a servo with a natural_frequency, or a data sheet");
    }
    const double limit = read_limit(*quantity, parts.limit);
    if (is_period && !(limit > 0.0)) refuse(field_, condition, "must have a positive limit");
    if (!(limit >= 0.0)) refuse(field_, condition, "must have a limit of 0 or more");
    const bool is_at_most = parts.is_at_most != is_period;  // a period limits the frequency
    const double bound = is_period ? 1.0 / limit : limit;
    target_.require(
        is_period ? Quantity::frequency : *quantity,
        is_at_most ? Bounds{-Target::infinity, bound} : Bounds{bound, Target::infinity});
  }

  double read_limit(Quantity quantity, std::string_view text) const {
    const Dimension* dimension = entry_of(quantity).dimension;
    if (dimension == &dimensions::rate) {  // "5 Hz" or "30 rad/s"
      return to_si(field_, text, dimensions::angular_frequency) / (2.0 * std::numbers::pi);
    }
    if (dimension == nullptr) return read_share(field_, text);
    if (dimension == &dimensions::angle && bare_numbers_ == BareNumbers::in_si) {
      return read_measured(field_, text, dimensions::angle).si;
    }
    return to_si(field_, text, *dimension);
  }

  std::string field_;
  TimeScale time_scale_;
  BareNumbers bare_numbers_;
  Target target_;
  std::vector<Fault> faults_;
};

}  // namespace

std::vector<std::string> names_of_quantities(std::optional<QuantityKind> kind) {
  std::vector<std::string> names;
  for (const QuantityInfo& info : quantities()) {
    if (!kind || info.kind == kind) names.emplace_back(info.name);
  }
  return names;
}

Target read_target(std::string_view field, std::string_view text, TimeScale time_scale,
                   BareNumbers bare_numbers) {
  TargetReader reader(field, time_scale, bare_numbers);
  for (const std::string_view condition : split(text, " and ")) reader.read(condition);
  return reader.target(text);
}

Target parse_target(std::string_view text, const Drive& drive) {
  return read_target("target", text, is_normalized(drive) ? TimeScale::unknown : TimeScale::known);
}

}  // namespace gearlash
