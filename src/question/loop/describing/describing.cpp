#include "question/loop/describing/describing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/lists.hpp"
#include "base/names.hpp"
#include "model/rational_function.hpp"

namespace gearlash::drive {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

// ---- the linear parts ---------------------------------------------------------------------------

/// Feedback torque from θ_M and θ_L, as functions of s without the delay.
struct Feedback {
  RationalFunction from_load;
  RationalFunction from_motor;
  RationalFunction anti_windup;  ///< from the delivered to the requested torque
  double delay = 0.0;

  RationalFunction whole() const { return from_load + from_motor; }
};

/// z as a function of s: e^{sT} to second order.
RationalFunction forward_shift(double period) {
  const RationalFunction half = RationalFunction(Rational(period) / 2) * variable();
  return (RationalFunction(1.0) + half) / (RationalFunction(1.0) - half);
}

/// p(z) (1 − h)^degree at z = (1 + h)/(1 − h) with h = s T/2, that is, z of forward_shift().
Polynomial by_frequency(const Polynomial& p, std::size_t degree, double period) {
  const Rational half = Rational(period) / 2;
  Polynomial sum;
  std::vector<Rational> sizes(degree + 1, Rational(0));  // of all that is added to a coefficient
  for (std::size_t k = 0; k < p.size(); ++k) {
    Polynomial term(p[k]);
    for (std::size_t i = 0; i < degree; ++i) {
      term *= Polynomial{Rational(1), i < k ? half : Rational(-half)};
    }
    sum += term;
    for (std::size_t i = 0; i < term.size(); ++i) sizes[i] += abs(term[i]);
  }
  const Rational rounding(std::ldexp(1.0, -50));
  std::vector<Rational> coefficients(sum.data());
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (abs(coefficients[i]) < rounding * sizes[i]) coefficients[i] = 0;
  }
  return Polynomial(std::move(coefficients));
}

/// A function of z as one of s.
RationalFunction by_frequency(const RationalFunction& function, double period) {
  const std::size_t degree =
      std::max(function.numerator().size(), function.denominator().size()) - 1;
  return {by_frequency(function.numerator(), degree, period),
          by_frequency(function.denominator(), degree, period)};
}

/// What the computer has for d/dt, as a function of s: it advances a state by
/// T ((1 − share) ẋ(t) + share ẋ(t + T)). By Tustin's rule that is s itself.
RationalFunction rate(const Sampling& sampling, double share) {
  const RationalFunction slope(Rational(share - 0.5) * Rational(sampling.period));
  return variable() / (RationalFunction(1.0) + slope * variable());
}

/// The sampled controller as a function of s, without rounding: discretized in floating point, it
/// would have tiny coefficients where terms cancel.
ExactControllerTransfer sampled_transfer(const ReducedDrive& drive, TorqueGiven torque) {
  const Sampling& sampling = *drive.sampling;
  ExactControllerTransfer transfer = exact_transfer(drive.controller, torque);
  if (drive.controller.is_of_samples) {
    transfer.position = by_frequency(transfer.position, sampling.period);
    return transfer;  // it has neither speed nor anti-windup
  }
  const double share = share_of_end(sampling.method);
  const RationalFunction by_rate = rate(sampling, share);
  transfer.position = composed(transfer.position, by_rate);
  transfer.speed = composed(transfer.speed, by_rate);
  if (transfer.given.is_zero()) return transfer;
  // τ = H u + G (τ_given − τ), and the computer's G is without the part that acts within a sample.
  const RationalFunction one(1.0);
  const RationalFunction winding_back = transfer.given / (one - transfer.given);
  const RationalFunction continuous = composed(winding_back, by_rate);
  RationalFunction sampled = continuous;
  if (share > 0.0) {
    const Rational end = 1 / (Rational(share) * Rational(sampling.period));
    sampled = continuous - composed(winding_back, RationalFunction(end));
  }
  const RationalFunction change = (one + continuous) / (one + sampled);
  transfer.position = transfer.position * change;
  transfer.speed = transfer.speed * change;
  transfer.given = sampled / (one + sampled);
  return transfer;
}

/// 1 + T s of a winding that lags.
RationalFunction lag_of(const Winding& winding) {
  return RationalFunction(1.0) + RationalFunction(Rational(winding.time_constant)) * variable();
}

/// Of the torque as the winding gives it; of the requested torque where that may be limited.
Feedback feedback_of(const ReducedDrive& drive, TorqueGiven torque) {
  ExactControllerTransfer transfer =
      drive.sampling ? sampled_transfer(drive, torque) : exact_transfer(drive.controller, torque);
  RationalFunction speed_by_position = variable();
  double delay = 0.0;
  if (drive.sampling) {
    if (drive.sampling->speed_by_differences) {
      const RationalFunction shift = forward_shift(drive.sampling->period);
      speed_by_position = (RationalFunction(1.0) - RationalFunction(1.0) / shift) /
                          RationalFunction(drive.sampling->period);
    }
    delay = 0.5 * drive.sampling->period + drive.sampling->delay;
    const double kept = position_period(*drive.sampling) - drive.sampling->period;
    if (kept > 0.0) transfer.position = transfer.position * delay_approximation(0.5 * kept);
  }
  const RationalFunction minus(-1.0);
  if (torque == TorqueGiven::as_asked) {
    transfer.position = transfer.position / lag_of(drive.winding);
    transfer.speed = transfer.speed / lag_of(drive.winding);
  }
  const RationalFunction position = minus * transfer.position;
  const RationalFunction speed = minus * transfer.speed * speed_by_position;
  const RationalFunction one(1.0);
  const RationalFunction position_share(drive.sensing.load_share_of_position);
  const RationalFunction speed_share(drive.sensing.load_share_of_speed);
  return {position_share * position + speed_share * speed,
          (one - position_share) * position + (one - speed_share) * speed, transfer.given, delay};
}

/// J s² + F s.
RationalFunction inertia_and_friction(const Rational& inertia, const Rational& friction) {
  return {Polynomial{Rational(0), friction, inertia}, Polynomial(Rational(1))};
}

RationalFunction plant_of(const Shaft& shaft) {
  return inertia_and_friction(Rational(shaft.inertia), Rational(shaft.friction.viscous));
}

/// With the back-EMF of a winding that lags.
RationalFunction motor_of(const ReducedDrive& drive) {
  if (drive.winding.time_constant == 0.0) return plant_of(drive.motor);
  return plant_of(drive.motor) +
         RationalFunction(Rational(drive.winding.back_emf)) * variable() / lag_of(drive.winding);
}

RationalFunction load_of(const ReducedDrive& drive) {
  return plant_of(drive.load) + RationalFunction(Rational(drive.gravity.stiffness));
}

RationalFunction plant_of(const ReducedDrive& drive) { return motor_of(drive) + load_of(drive); }

// ---- assumptions --------------------------------------------------------------------------------

bool is_always_0(const Signal& signal) {
  const auto* number = std::get_if<double>(&signal);
  return number != nullptr && *number == 0.0;
}

double coulomb_of(const ReducedDrive& drive) {
  return drive.motor.friction.coulomb + drive.load.friction.coulomb;
}

/// What is neglected so that the part stands alone.
std::vector<Assumption> omissions(const ReducedDrive& drive, DescribedPart part,
                                  bool delay_is_rational) {
  std::vector<Assumption> found;
  const auto add = [&](bool applies, Assumption assumption) {
    if (applies) found.push_back(assumption);
  };
  const bool is_friction = part == DescribedPart::coulomb_friction;
  const bool is_gap = part == DescribedPart::gap_load_held ||
                      part == DescribedPart::gap_load_coasting ||
                      part == DescribedPart::elastic_gap;
  add(!is_gap, Assumption::gap_left_out);
  add(part != DescribedPart::torque_limit && std::isfinite(drive.torque_limit),
      Assumption::torque_limit_left_out);
  add(!is_friction && has_dry_friction(drive), Assumption::coulomb_left_out);
  add(is_friction && has_stiction(drive), Assumption::breakaway_left_out);
  const bool has_shape = drive.error_shape.is_present();
  add(has_shape && part != DescribedPart::dead_band && part != DescribedPart::relay,
      Assumption::error_shape_left_out);
  add(is_friction && (drive.motor.friction.falls() || drive.load.friction.falls()),
      Assumption::falling_friction_left_out);
  add(drive.sampling.has_value(), Assumption::sampling_as_delay);
  const bool keeps = drive.sampling && position_ticks(*drive.sampling) > 1;
  add(delay_is_rational || keeps, Assumption::delay_as_rational);
  add(drive.sensing.reads_steps(), Assumption::encoder_left_out);
  add(!is_always_0(drive.reference) || !is_always_0(drive.load_torque),
      Assumption::signals_left_out);
  return found;
}

// ---- the search ---------------------------------------------------------------------------------

/// Frequencies of poles, zeros and of |L| = 1 on the high-frequency asymptote, with margins.
Bounds frequency_range(const TransferFunction& loop) {
  Bounds range = natural_frequency_range(loop);
  const FactoredTransferFunction factors = factored(loop);
  const double order =
      static_cast<double>(factors.poles.size()) - static_cast<double>(factors.zeros.size());
  if (order > 0.0) {
    const double crossover = std::pow(std::abs(factors.gain), 1.0 / order);
    range.low = std::min(range.low, 1e-6 * crossover);
    // With a delay natural_frequency_range() sets the upper end, because the phase turns without
    // end.
    if (loop.delay == 0.0) range.high = std::max(range.high, 1e6 * crossover);
  }
  range.low *= 1e-3;
  return range;
}

double modulus(const TransferFunction& transfer, double frequency) {
  return std::abs(frequency_response(transfer, frequency).value);
}

DescribedMotion motion_of(const DescribingAnalysis& analysis, const PredictedCycle& cycle) {
  DescribedMotion motion{.balance = cycle};
  motion.motor_amplitude = cycle.amplitude / modulus(analysis.input_per_motor, cycle.frequency);
  if (analysis.load_per_motor) {
    motion.amplitude = motion.motor_amplitude * modulus(*analysis.load_per_motor, cycle.frequency);
  } else if (const auto* held = std::get_if<FrictionControlledBacklash>(&analysis.nonlinearity)) {
    motion.amplitude = load_amplitude(*held, cycle);
  } else {
    motion.amplitude =
        load_amplitude(std::get<InertiaControlledBacklash>(analysis.nonlinearity), cycle);
  }
  return motion;
}

/// With assumptions and cycles.
DescribingAnalysis completed(DescribingAnalysis analysis, const ReducedDrive& drive,
                             bool delay_is_rational) {
  analysis.assumptions = omissions(drive, analysis.part, delay_is_rational);
  if (!is_in_loop(analysis)) return analysis;
  HarmonicBalance balance =
      harmonic_balance(analysis.nonlinearity, analysis.loop, frequency_range(analysis.loop));
  analysis.unresolved = std::move(balance.unresolved);
  for (const PredictedCycle& cycle : balance.cycles) {
    analysis.cycles.push_back(motion_of(analysis, cycle));
  }
  return analysis;
}

const TransferFunction unchanged{{1.0}, {1.0}};

// ---- one part at a time -------------------------------------------------------------------------

/// A loop, and whether its delay had to be replaced.
struct GapLoop {
  TransferFunction function;
  bool delay_is_rational = false;
};

GapLoop gap_loop(const ReducedDrive& drive, const Feedback& feedback) {
  if (feedback.from_motor.is_zero()) {
    return {rounded(feedback.from_load / plant_of(drive), feedback.delay)};
  }
  const RationalFunction delay = delay_approximation(feedback.delay);
  const bool is_rational = feedback.delay > 0.0;
  if (feedback.from_load.is_zero()) {
    return {rounded(load_of(drive) / (motor_of(drive) + feedback.from_motor * delay)), is_rational};
  }
  return {rounded(feedback.from_load * delay / (plant_of(drive) + feedback.from_motor * delay)),
          is_rational};
}

DescribingAnalysis described_gap(const ReducedDrive& drive, DescribedPart part,
                                 const Nonlinearity& play) {
  const Feedback feedback = feedback_of(drive, TorqueGiven::as_asked);
  const GapLoop loop = gap_loop(drive, feedback);
  DescribingAnalysis analysis = completed(
      {.part = part, .nonlinearity = play, .loop = loop.function, .input_per_motor = unchanged},
      drive, loop.delay_is_rational);
  const bool reacts = feedback.from_load.is_zero() && !feedback.from_motor.is_zero();
  analysis.assumptions.insert(analysis.assumptions.begin(),
                              reacts ? Assumption::load_reacts : Assumption::motor_carries_all);
  return analysis;
}

DescribingAnalysis described_elastic_gap(const ReducedDrive& drive,
                                         const CompliantContact& contact) {
  const Feedback feedback = feedback_of(drive, TorqueGiven::as_asked);
  const RationalFunction delay = delay_approximation(feedback.delay);
  const RationalFunction from_load = feedback.from_load * delay;
  const RationalFunction motor = motor_of(drive) + feedback.from_motor * delay;
  const RationalFunction load = load_of(drive);
  const RationalFunction damping =
      RationalFunction(1.0) +
      RationalFunction(Rational(contact.damping) / Rational(contact.stiffness)) * variable();
  const RationalFunction whole = motor + load + from_load;
  return completed({.part = DescribedPart::elastic_gap,
                    .nonlinearity = DeadZone{0.5 * drive.backlash, contact.stiffness},
                    .loop = rounded(damping * whole / (motor * load)),
                    .input_per_motor = rounded(whole / (load + from_load)),
                    .load_per_motor = rounded(RationalFunction(-1.0) * motor / (load + from_load))},
                   drive, feedback.delay > 0.0);
}

DescribingAnalysis described_torque_limit(const ReducedDrive& drive) {
  const Feedback feedback = feedback_of(drive, TorqueGiven::limited);
  const bool winds_back = !feedback.anti_windup.is_zero();
  const RationalFunction plant = lag_of(drive.winding) * plant_of(drive);
  const RationalFunction delay =
      winds_back ? delay_approximation(feedback.delay) : RationalFunction(1.0);
  const RationalFunction loop = feedback.whole() * delay / plant - feedback.anti_windup;
  return completed({.part = DescribedPart::torque_limit,
                    .nonlinearity = Saturation{drive.torque_limit, 1.0},
                    .loop = rounded(loop, winds_back ? 0.0 : feedback.delay),
                    .input_per_motor = rounded(loop * plant),
                    .load_per_motor = unchanged},
                   drive, winds_back && feedback.delay > 0.0);
}

DescribingAnalysis described_coulomb_friction(const ReducedDrive& drive) {
  const Feedback feedback = feedback_of(drive, TorqueGiven::as_asked);
  const RationalFunction back = feedback.whole() * delay_approximation(feedback.delay);
  return completed({.part = DescribedPart::coulomb_friction,
                    .nonlinearity = CoulombFriction{coulomb_of(drive)},
                    .loop = rounded(variable() / (plant_of(drive) + back)),
                    .input_per_motor = rounded(variable()),
                    .load_per_motor = unchanged},
                   drive, feedback.delay > 0.0);
}

/// The drive whose controller does not receive the speed.
ReducedDrive without_speed(ReducedDrive drive) {
  for (std::vector<double>& row : drive.controller.input_matrix) row[2] = 0.0;
  drive.controller.direct[2] = 0.0;
  return drive;
}

/// A nonlinearity that gives the error that the controller receives.
DescribingAnalysis described_error(const ReducedDrive& drive, DescribedPart part,
                                   const Nonlinearity& nonlinearity) {
  const Feedback whole = feedback_of(drive, TorqueGiven::as_asked);
  const RationalFunction of_error =
      feedback_of(without_speed(drive), TorqueGiven::as_asked).whole();
  const RationalFunction of_speed = whole.whole() - of_error;
  const bool has_speed = !of_speed.is_zero();
  const RationalFunction delay =
      has_speed ? delay_approximation(whole.delay) : RationalFunction(1.0);
  const RationalFunction input = drive.error_shape.is_of_speed ? variable() : RationalFunction(1.0);
  const RationalFunction loop = input * of_error * delay / (plant_of(drive) + of_speed * delay);
  return completed({.part = part,
                    .nonlinearity = nonlinearity,
                    .loop = rounded(loop, has_speed ? 0.0 : whole.delay),
                    .input_per_motor = rounded(input),
                    .load_per_motor = unchanged},
                   drive, has_speed && whole.delay > 0.0);
}

}  // namespace

std::vector<DescribingAnalysis> describing_analyses(const ReducedDrive& drive) {
  require_none(faults(drive));
  std::vector<DescribingAnalysis> analyses;
  const ErrorShape& shape = drive.error_shape;
  if (shape.is_relay()) {
    if (shape.is_two_level()) {
      analyses = {
          described_error(drive, DescribedPart::relay, RelayWithHysteresis{1.0, shape.begins})};
    }
    return analyses;
  }
  if (drive.backlash > 0.0) {
    analyses = {described_gap(drive, DescribedPart::gap_load_held,
                              FrictionControlledBacklash{drive.backlash}),
                described_gap(drive, DescribedPart::gap_load_coasting,
                              InertiaControlledBacklash{drive.backlash})};
    if (const auto* compliant = std::get_if<CompliantContact>(&drive.contact)) {
      analyses.push_back(described_elastic_gap(drive, *compliant));
    }
  }
  if (std::isfinite(drive.torque_limit)) analyses.push_back(described_torque_limit(drive));
  if (coulomb_of(drive) > 0.0) analyses.push_back(described_coulomb_friction(drive));
  if (shape.inner_gain == 0.0 && !shape.jumps) {
    analyses.push_back(
        described_error(drive, DescribedPart::dead_band, DeadZone{shape.begins, 1.0}));
  }
  return analyses;
}

bool is_in_loop(const DescribingAnalysis& analysis) {
  const std::vector<double>& numerator = analysis.loop.numerator;
  return any_of(numerator, [](double coefficient) { return coefficient != 0.0; });
}

const char* name_of(DescribedPart part) {
  constexpr Names<DescribedPart::relay> names("gap, load held by friction", "gap, load coasting",
                                              "gap with elastic faces", "torque limit",
                                              "Coulomb friction", "dead band", "relay");
  return names[part];
}

const char* name_of(Assumption assumption) {
  constexpr Names<Assumption::falling_friction_left_out> descriptions(
      "the motor drives all inertia and viscous friction at all times",
      "the sensors are on the motor, so the gap is outside the loop of positions and causes "
      "no cycle there; the description takes the first harmonic of the load's inertia and "
      "viscous friction, which act back on the motor",
      "there is no gap: both shafts turn as one", "the torque is not limited",
      "all friction is viscous",
      "breakaway torque has no effect, because a sine is never at rest; hunting from "
      "stiction is not described",
      "the controller is continuous, with a delay of half a sampling period plus its "
      "computational delay",
      "this delay inside the loop is a rational function of order 4", "encoders have no steps",
      "reference and load torque are 0",
      "the controller receives the error itself, without dead band, limit of speed or compensation",
      "dry friction does not fall with speed");
  return descriptions[assumption];
}

std::vector<ExactMotion> exact_motions(const Answer& answer) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<ExactMotion> motions;
  if (answer.verdict == Verdict::forced) return motions;
  for (const Cycle& cycle : answer.cycles) {
    motions.push_back({cycle.amplitude, cycle.motor_amplitude, cycle.period,
                       cycle.stability == Stability::stable});
  }
  for (const IrregularMotion& motion : answer.irregular) {
    motions.push_back({motion.amplitude, motion.motor_amplitude.value_or(unknown),
                       motion.mean_period.value_or(unknown), true});
  }
  return motions;
}

std::optional<PredictionError> prediction_error(DescribedPart part,
                                                const DescribedMotion& predicted,
                                                const std::vector<ExactMotion>& exact) {
  const bool is_of_gap =
      part != DescribedPart::torque_limit && part != DescribedPart::coulomb_friction;
  const double farthest =
      is_of_gap ? std::numeric_limits<double>::infinity() : std::log(same_cycle_factor);
  std::optional<PredictionError> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const ExactMotion& cycle = exact[i];
    if (cycle.is_stable != predicted.balance.stable) continue;
    const double amplitude = predicted.amplitude / cycle.amplitude;
    const double period = predicted.balance.period / cycle.period;
    const double of_amplitude = std::abs(std::log(amplitude));
    const double of_period = std::abs(std::log(period));
    const double distance = of_amplitude + of_period;
    if (!(distance < least) || std::max(of_amplitude, of_period) > farthest) continue;
    least = distance;
    nearest =
        PredictionError{i, amplitude - 1.0, predicted.motor_amplitude / cycle.motor_amplitude - 1.0,
                        period - 1.0, 1.0 / period - 1.0};
  }
  return nearest;
}

void set_errors(std::vector<DescribingAnalysis>& analyses, const Answer& answer) {
  const std::vector<ExactMotion> exact = exact_motions(answer);
  for (DescribingAnalysis& analysis : analyses) {
    for (DescribedMotion& cycle : analysis.cycles) {
      cycle.error = prediction_error(analysis.part, cycle, exact);
    }
  }
}

bool is_unseen(const DescribedMotion& predicted, double backlash) {
  return predicted.amplitude < unseen_share * backlash;
}

double input_amplitude(const DescribingAnalysis& analysis, const ExactMotion& exact) {
  return exact.motor_amplitude * modulus(analysis.input_per_motor, turn / exact.period);
}

}  // namespace gearlash::drive
