#include "question/contradictions.hpp"

#include <optional>

#include "base/lists.hpp"
#include "base/range_check.hpp"
#include "question/loop/energy/computed_rest.hpp"

namespace gearlash {
namespace {

/// The proved ceiling that bounds all motion in the end, rad.
std::optional<double> ceiling_of_all(const Answer& answer) {
  if (!answer.ceiling || answer.ceiling->is_below_limit) return std::nullopt;
  return answer.ceiling->load;
}

void compare_with_ceiling(const Answer& answer, std::vector<std::string>& all) {
  const std::optional<double> ceiling = ceiling_of_all(answer);
  if (!ceiling) return;
  constexpr double rounding = 1e-6;
  const auto check = [&](const char* what, double amplitude) {
    if (!(amplitude > *ceiling * (1.0 + rounding))) return;
    all.push_back(std::string(what) + " ±" + exact_text(amplitude) +
                  " rad, beyond the proved ceiling of ±" + exact_text(*ceiling) + " rad.");
  };
  for (const Cycle& cycle : answer.cycles) check("A cycle has", cycle.amplitude);
  for (const IrregularMotion& motion : answer.irregular) {
    check("Motion that does not repeat has", motion.amplitude);
  }
  if (answer.rest) {
    check("Rest extends over", 0.5 * (answer.rest->load.high - answer.rest->load.low));
  }
}

bool is_listed(const StartOutcome& start, const Answer& answer) {
  if (start.end == "rest") return answer.rest.has_value();
  if (start.end == "cycle") return start.which && *start.which < answer.cycles.size();
  if (start.end == "irregular") return start.which && *start.which < answer.irregular.size();
  return true;
}

/// The first start that rests where nothing can, by the equations of equilibrium; nullptr if there
/// is none, or where these were not computed.
const StartOutcome* start_beside_rest(const Answer& answer) {
  if (!answer.rest || answer.rest->pieces.empty()) return nullptr;
  const std::vector<RestPiece>& pieces = answer.rest->pieces;
  return first_of(answer.search->starts, [&](const StartOutcome& start) {
    return start.rest &&
           !any_of(pieces, [&](const RestPiece& piece) { return may_hold(piece, *start.rest); });
  });
}

}  // namespace

std::vector<std::string> contradictions(const Answer& answer) {
  std::vector<std::string> all;
  compare_with_ceiling(answer, all);
  if (!answer.search) return all;
  const std::vector<StartOutcome>& starts = answer.search->starts;
  if (!all_of(starts, [&](const StartOutcome& start) { return is_listed(start, answer); })) {
    all.push_back("A start leads to an end that is not listed.");
  }
  if (const StartOutcome* start = start_beside_rest(answer)) {
    all.push_back("A start comes to rest with the load at " + exact_text(start->rest->load) +
                  " rad from the reference, where the computed equilibria do not reach.");
  }
  return all;
}

void withdraw_if_contradictory(Answer& answer) {
  for (const std::string& text : contradictions(answer)) {
    answer.verdict = Verdict::undecided;
    answer.notes.push_back(
        {"contradiction", "The answer contradicts itself. " + text + " Please report this drive."});
  }
}

}  // namespace gearlash
