#include "drive_score.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "gearlash/analyse.hpp"

namespace gearlash::oracle {
namespace {

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class Deadline : public Progress {
 public:
  explicit Deadline(double seconds) : seconds_(seconds), from_(processor_time()) {}
  bool go_on(double /*share*/, std::size_t /*bytes*/) override {
    return seconds_ <= 0.0 || processor_time() - from_ < seconds_;
  }

 private:
  double seconds_;
  double from_;
};

/// For answers that need no search: what holds for every start holds for these.
std::vector<StartOutcome> own_starts(const Answer& answer, const PlainDrive& drive) {
  std::vector<StartOutcome> starts;
  const bool is_rest =
      answer.verdict == Verdict::cannot_hunt || answer.verdict == Verdict::comes_to_rest;
  for (const double times : {0.1, 0.5, 2.0, 10.0, 50.0, 100.0}) {
    StartOutcome start;
    start.load_position = drive.reference + times * drive.backlash;
    start.motor_position = start.load_position - 0.5 * drive.backlash;
    start.end = is_rest ? "rest" : "cycle";
    if (!is_rest && !answer.cycles.empty()) start.which = 0;
    starts.push_back(start);
  }
  return starts;
}

std::vector<StartOutcome> compared_starts(const Answer& answer, const PlainDrive& drive,
                                          std::size_t most) {
  const std::vector<StartOutcome> all = answer.search && !answer.search->starts.empty()
                                            ? answer.search->starts
                                            : own_starts(answer, drive);
  if (most == 0 || all.size() <= most) return all;
  std::vector<StartOutcome> chosen;
  for (std::size_t i = 0; i < most; ++i) {
    chosen.push_back(all[most == 1 ? all.size() / 2 : i * (all.size() - 1) / (most - 1)]);
  }
  return chosen;
}

/// The share by which amplitudes may differ.
double permitted(const ScoredStart& scored, const Answer& answer, const ScoreOptions& options) {
  if (!scored.start.which) return options.share;
  const std::size_t which = *scored.start.which;
  if (scored.start.end == "cycle") {
    // Neutral cycles are a family, of which one is listed.
    const bool is_family = answer.cycles[which].stability == Stability::neutral;
    return is_family ? options.irregular_share : options.share;
  }
  const IrregularMotion& motion = answer.irregular[which];
  const double extent = std::max(motion.amplitude, motion.motor_amplitude.value_or(0.0));
  return options.irregular_share + 2.0 * motion.amplitude_deviation.value_or(0.0) / extent;
}

void state_amplitudes(const Answer& answer, ScoredStart& scored) {
  if (!scored.start.which) return;
  const std::size_t which = *scored.start.which;
  if (scored.start.end == "cycle") {
    scored.amplitude = answer.cycles[which].amplitude;
    scored.motor_amplitude = answer.cycles[which].motor_amplitude;
    scored.frequency = answer.cycles[which].frequency();
  } else if (scored.start.end == "irregular") {
    scored.amplitude = answer.irregular[which].amplitude;
    scored.motor_amplitude = answer.irregular[which].motor_amplitude.value_or(scored.amplitude);
    scored.frequency = 1.0 / answer.irregular[which].mean_period.value_or(0.0);
  }
}

Agreement agreement_of(const ScoredStart& scored, const PlainDrive& drive, double share) {
  const std::string& end = scored.start.end;
  if (end == "undecided") return Agreement::undecided;
  const Ending& ending = scored.ending;
  if (!agree(ending, scored.ending_of_half_step, drive, share)) return Agreement::no_measure;
  const bool rests = ending.kind == EndKind::rest || ending.kind == EndKind::fades;
  if (end == "rest") {
    if (!rests) return Agreement::wrong;
    return ending.kind == EndKind::fades ? Agreement::right_as_it_fades : Agreement::right;
  }
  if (end == "diverges") {
    return ending.kind == EndKind::runs_away ? Agreement::right : Agreement::wrong;
  }
  const Ending stated{.kind = EndKind::hunts,
                      .amplitude = scored.amplitude,
                      .motor_amplitude = scored.motor_amplitude};
  return agree(stated, ending, drive, share) ? Agreement::right : Agreement::wrong;
}

ScoredStart scored_start(const StartOutcome& start, const Answer& answer, const PlainDrive& drive,
                         const ScoreOptions& options) {
  ScoredStart scored{.start = start};
  const ShaftReadings shafts{start.motor_position, start.motor_speed, start.load_position,
                             start.load_speed};
  state_amplitudes(answer, scored);
  EndingOptions whole = options.ending;
  // The extremes of slow irregular motion need many of its periods.
  constexpr double periods = 200.0;
  if (scored.frequency > 0.0) {
    whole.longest_time = std::max(whole.longest_time, periods / scored.frequency);
  }
  EndingOptions half = whole;
  half.longest_step *= 0.5;
  scored.ending = ending_of(drive, shafts, whole);
  scored.ending_of_half_step = ending_of(drive, shafts, half);
  scored.agreement = agreement_of(scored, drive, permitted(scored, answer, options));
  return scored;
}

}  // namespace

const char* name_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::right:
      return "right";
    case Agreement::right_as_it_fades:
      return "right, as it fades";
    case Agreement::wrong:
      return "WRONG";
    case Agreement::undecided:
      return "undecided";
    case Agreement::no_measure:
      break;
  }
  return "no measure";
}

std::size_t DriveScore::count(Agreement agreement) const {
  return static_cast<std::size_t>(
      std::count_if(starts.begin(), starts.end(),
                    [&](const ScoredStart& start) { return start.agreement == agreement; }));
}

bool DriveScore::is_decided() const {
  return answer.verdict != Verdict::undecided && undecided == 0 &&
         (!answer.search || answer.search->is_complete);
}

DriveScore score_of(const Drive& drive, const ScoreOptions& options) {
  DriveScore score;
  const PlainDrive plain = settled(plain_drive(drive));
  Deadline deadline(options.time_limit);
  const double before = processor_time();
  score.answer = analyse(drive, {.proofs = false}, deadline);
  score.processor_seconds = processor_time() - before;
  if (score.answer.search) score.undecided = score.answer.search->count("undecided");
  for (const StartOutcome& start : compared_starts(score.answer, plain, options.starts)) {
    score.starts.push_back(scored_start(start, score.answer, plain, options));
  }
  return score;
}

}  // namespace gearlash::oracle
