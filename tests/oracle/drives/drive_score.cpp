#include "drive_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <stdexcept>

#include "following.hpp"
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
                                          std::optional<std::size_t> most) {
  const std::vector<StartOutcome> all = answer.search && !answer.search->starts.empty()
                                            ? answer.search->starts
                                            : own_starts(answer, drive);
  if (!most || all.size() <= *most) return all;
  std::vector<StartOutcome> chosen;
  for (std::size_t i = 0; i < *most; ++i) {
    chosen.push_back(all[*most == 1 ? all.size() / 2 : i * (all.size() - 1) / (*most - 1)]);
  }
  return chosen;
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

/// Whether the headline names the motion in which a start ends.
bool is_of_headline(const Answer& answer, const StartOutcome& start) {
  const Cycle* named = answer.largest_stable();
  if (start.end == "cycle") return &answer.cycles[*start.which] == named;
  return named == nullptr && start.which == 0;
}

Agreement agreement_of(const ScoredStart& scored, const Ending& ending, const PlainDrive& drive,
                       const Answer& answer, double share, double irregular_share) {
  const std::string& end = scored.start.end;
  if (end == "undecided") return Agreement::undecided;
  if (ending.kind == EndKind::unclear) return Agreement::no_measure;
  const bool rests = ending.kind == EndKind::rest || ending.kind == EndKind::fades;
  if (end == "rest") {
    if (!rests) return Agreement::wrong;
    return ending.kind == EndKind::fades ? Agreement::right_as_it_fades : Agreement::right;
  }
  if (end == "diverges") {
    return ending.kind == EndKind::runs_away ? Agreement::right : Agreement::wrong;
  }
  if (rests && answer.rests_engaged) return Agreement::right;  // small disturbances leave that rest
  Ending stated{.kind = EndKind::hunts,
                .amplitude = scored.amplitude,
                .motor_amplitude = scored.motor_amplitude};
  if (agree(stated, ending, drive, share)) return Agreement::right;
  // A headline has the amplitude of the load, of one motion. Extremes of irregular motion grow with
  // the time that it is watched, those of the motor within the gap above all.
  if (ending.kind == EndKind::hunts && !is_of_headline(answer, scored.start)) {
    return Agreement::right_of_other_size;
  }
  const bool load_swings = scored.amplitude > 0.1 * scored.motor_amplitude;
  if (end == "irregular" && load_swings) stated.motor_amplitude = ending.motor_amplitude;
  return agree(stated, ending, drive, irregular_share) ? Agreement::right_of_other_size
                                                       : Agreement::wrong;
}

bool is_right(Agreement agreement) {
  return agreement == Agreement::right || agreement == Agreement::right_as_it_fades ||
         agreement == Agreement::right_of_other_size;
}

constexpr std::array beside = {-0.01, 0.01};  // of a start

ShaftReadings moved(ShaftReadings start, const PlainDrive& drive, double share) {
  const double way = share * (start.load_position - drive.reference);
  start.load_position += way;
  start.motor_position += way;
  start.load_speed *= 1.0 + share;
  start.motor_speed *= 1.0 + share;
  return start;
}

ScoredStart scored_start(const StartOutcome& start, const Answer& answer, const PlainDrive& drive,
                         const ScoreOptions& options) {
  ScoredStart scored{.start = start};
  if (start.end == "undecided") return scored;
  const ShaftReadings shafts{start.motor_position, start.motor_speed, start.load_position,
                             start.load_speed};
  state_amplitudes(answer, scored);
  EndingOptions whole = options.ending;
  const double times = start.end == "rest" ? options.times_of_rest : options.times_of_hunting;
  whole.first_time =
      std::min(std::max(whole.first_time, times * start.watched), whole.longest_time);
  // The extremes of slow irregular motion need many of its periods.
  constexpr double periods = 200.0;
  if (scored.frequency > 0.0) {
    constexpr double most = 10.0;  // times the longest time: its trace has half a gigabyte
    const double needed = periods / scored.frequency;
    if (needed > most * whole.longest_time) {
      scored.agreement = Agreement::no_measure;
      return scored;
    }
    whole.longest_time = std::max(whole.longest_time, needed);
  }
  EndingOptions half = whole;
  half.longest_step *= 0.5;
  const double share = permitted_share(answer, start, options.share, options.irregular_share);
  const auto judged = [&](const Ending& ending) {
    return agreement_of(scored, ending, drive, answer, share, options.irregular_share);
  };
  scored.ending = ending_of(drive, shafts, whole);
  scored.agreement = judged(scored.ending);
  if (scored.agreement == Agreement::wrong) {  // a chaotic transient may last much longer
    whole.first_time = half.first_time = 4.0 * scored.ending.time;
    whole.longest_time = half.longest_time = std::max(whole.longest_time, 4.0 * scored.ending.time);
    scored.ending = ending_of(drive, shafts, whole);
    scored.agreement = judged(scored.ending);
  }
  if (scored.agreement == Agreement::wrong) {
    scored.ending_of_half_step = ending_of(drive, shafts, half);
    if (!agree(scored.ending, scored.ending_of_half_step, drive, share)) {
      scored.agreement = Agreement::no_measure;
    }
  }
  for (const double aside : beside) {
    if (scored.agreement != Agreement::wrong) break;
    if (is_right(judged(ending_of(drive, moved(shafts, drive, aside), whole)))) {
      scored.agreement = Agreement::near_border;
    }
  }
  return scored;
}

// ---- other starts -------------------------------------------------------------------------------

ShaftReadings random_start(std::mt19937_64& engine, const PlainDrive& drive) {
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine() >> 11U), -53);
  };
  const double sign = between(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
  const double way = sign * drive.backlash * std::exp(between(std::log(0.05), std::log(100.0)));
  const bool moves = between(0.0, 1.0) < 0.3;
  const double speed = way * std::exp(between(0.0, std::log(100.0)));
  ShaftReadings start;
  start.load_position = drive.reference + way;
  start.motor_position = start.load_position + drive.backlash * between(-0.5, 0.5);
  if (moves) start.load_speed = start.motor_speed = between(0.0, 1.0) < 0.5 ? -speed : speed;
  return start;
}

/// Whether a motion may end so by the verdict.
bool permits(const Answer& answer, EndKind kind) {
  if (kind == EndKind::unclear) return true;
  const bool rests = kind == EndKind::rest || kind == EndKind::fades;
  // The headline says besides that starts run away, or stay undecided: then the drive counts as
  // undecided.
  if (kind == EndKind::runs_away && answer.search &&
      answer.search->count("diverges") + answer.search->count("undecided") > 0) {
    return true;
  }
  switch (answer.verdict) {
    case Verdict::cannot_hunt:
    case Verdict::comes_to_rest:
      return rests;
    case Verdict::hunts:
    case Verdict::hunts_irregularly:
      return kind == EndKind::hunts || (rests && (answer.rest || answer.rests_engaged));
    case Verdict::hunts_if_disturbed:
      return kind != EndKind::runs_away;
    case Verdict::forced:
    case Verdict::undamped:
      return kind != EndKind::runs_away;
    case Verdict::runs_away:
    case Verdict::grows_without_bound:
      return kind == EndKind::runs_away;
    case Verdict::runs_away_if_disturbed:
    case Verdict::undecided:
      break;
  }
  return true;
}

bool is_listed(const Answer& answer, const Ending& ending, const PlainDrive& drive,
               const ScoreOptions& options) {
  const auto agrees = [&](double load, std::optional<double> motor, double share) {
    const Ending stated{.kind = EndKind::hunts,
                        .amplitude = load,
                        .motor_amplitude = motor.value_or(ending.motor_amplitude)};
    return agree(stated, ending, drive, share);
  };
  for (const Cycle& cycle : answer.cycles) {
    if (agrees(cycle.amplitude, cycle.motor_amplitude, options.share)) return true;
  }
  for (const IrregularMotion& motion : answer.irregular) {
    if (agrees(motion.amplitude, motion.motor_amplitude, 2.0 * options.irregular_share)) {
      return true;
    }
  }
  return false;
}

std::string text_of(const ShaftReadings& start, const Ending& ending) {
  std::array<char, 300> line{};
  std::snprintf(
      line.data(), line.size(),
      "load %.9g at %.6g, motor %.9g at %.6g: %s, load ±%.4g motor ±%.4g %.4g Hz after %.4g s",
      start.load_position, start.load_speed, start.motor_position, start.motor_speed,
      name_of(ending.kind), ending.amplitude, ending.motor_amplitude, ending.frequency,
      ending.time);
  return line.data();
}

/// Whether swings that grow to thousands of gaps, which is called running away, are no larger than
/// hunting that is listed.
bool grows_towards_listed(const Answer& answer, const Ending& ending, const ScoreOptions& options) {
  const double listed = answer.value(Quantity::amplitude).value_or(0.0);
  return ending.kind == EndKind::runs_away && ending.amplitude > 0.0 &&
         ending.amplitude <= (1.0 + options.irregular_share) * listed;
}

void follow_random_start(const ShaftReadings& start, const Answer& answer, const PlainDrive& drive,
                         const ScoreOptions& options, RandomStarts& random) {
  ++random.followed;
  const Ending ending = ending_of(drive, start, options.ending);
  if (ending.kind == EndKind::unclear || grows_towards_listed(answer, ending, options)) {
    ++random.unclear;
    return;
  }
  if (permits(answer, ending.kind)) {
    const bool is_other =
        ending.kind == EndKind::hunts && !is_listed(answer, ending, drive, options);
    if (is_other) ++random.unlisted;
    return;
  }
  EndingOptions half = options.ending;
  half.longest_step *= 0.5;
  const Ending finer = ending_of(drive, start, half);
  if (!agree(ending, finer, drive, options.irregular_share)) {
    ++random.unclear;
    return;
  }
  for (const double share : beside) {
    const Ending there = ending_of(drive, moved(start, drive, share), options.ending);
    if (permits(answer, there.kind)) {
      ++random.near_border;
      return;
    }
  }
  random.contradictions.push_back(text_of(start, ending));
}

RandomStarts follow_random_starts(const Answer& answer, const PlainDrive& drive,
                                  const ScoreOptions& options) {
  RandomStarts random;
  std::mt19937_64 engine(options.seed);
  for (std::size_t i = 0; i < options.random_starts; ++i) {
    follow_random_start(random_start(engine, drive), answer, drive, options, random);
  }
  return random;
}

}  // namespace

const char* name_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::right:
      return "right";
    case Agreement::right_as_it_fades:
      return "right, as it fades";
    case Agreement::right_of_other_size:
      return "right, of another size";
    case Agreement::wrong:
      return "WRONG";
    case Agreement::undecided:
      return "undecided";
    case Agreement::near_border:
      return "near a border";
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
  Deadline deadline(options.time_limit);
  const double before = processor_time();
  score.answer = analyse(drive, {.proofs = false}, deadline);
  score.processor_seconds = processor_time() - before;
  if (score.answer.search) score.undecided = score.answer.search->count("undecided");
  try {
    const PlainDrive plain = settled(plain_drive(drive));
    for (const StartOutcome& start : compared_starts(score.answer, plain, options.starts)) {
      score.starts.push_back(scored_start(start, score.answer, plain, options));
    }
    score.random = follow_random_starts(score.answer, plain, options);
  } catch (const std::invalid_argument& refused) {
    score.refused = refused.what();
  }
  return score;
}

}  // namespace gearlash::oracle
