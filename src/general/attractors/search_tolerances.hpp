// Tolerances and budget of a search: what it calls rest, cycle, irregular or runaway.
#pragma once

#include <cstddef>

namespace gearlash::drive {

/// What counts as rest. The small length is the smallest of backlash and encoder steps.
struct RestTolerances {
  /// A number stands still if in the last half it moved by at most this share of its total
  /// movement. A motion whose numbers all stand still is at rest.
  double still = 1e-9;
  /// Swings below this share of the small length are small: they may vanish.
  double small_swing = 0.05;
  /// Motion within this share of the small length is examined for vanishing swings.
  double small_motion = 0.1;
  /// Swings below this share of the small length are not counted.
  double negligible_swing = 1e-6;
  /// A speed that moves less than this share of the last swing within a swing time is a standstill.
  /// It ends that swing.
  double standing_speed = 1e-6;
  /// Swings vanish if their limit, extrapolated from any three of them (Aitken), is below this
  /// share of the last.
  double vanishing_limit = 0.03;
  /// This many shrinking swings are enough ...
  std::size_t vanishing_swings = 7;
  /// ... or fewer, where the last is below this share of the first.
  double vanishing_fast = 0.1;
  /// Swings whose ratios scatter vanish if this many ratios are below 1, and the mean of their
  /// logarithms below 0 by this many standard errors.
  std::size_t scattering_swings = 12;
  double scattering_errors = 3.0;
  /// Rounds of events that shrink, after half of them to this share, fade to rest; their limit is
  /// known to `vanishing_limit` of what is left.
  double fading = 0.5;
  /// A drive without stiction rests on a cycle if it moves, by more than this share of the cycle's
  /// extent, for no more than this share of its period.
  double hardly_moving = 1e-4;
  /// At the end of its watch a drive without stiction rests if it has stood this many times as long
  /// as it ever moved.
  double long_standstill = 1e3;
  /// Below this share of the small length nothing has moved.
  double no_move = 1e-9;
};

/// What counts as a cycle, and as the same cycle.
struct CycleTolerances {
  /// Passings this near each other, as a share of the state, may be a cycle. A watched motion is
  /// closed from them, the nearest first.
  double nearness = 1e-6;
  double wide_nearness = 1e-3;
  /// The same for a motion that approaches its cycle slowly, or hovers at an unstable one.
  double widest_nearness = 1e-2;
  /// A closed orbit must close this well, as a share of the state.
  double residual = 1e-9;
  /// Both shafts must be back in their places after a period, to this share of the cycle's extent,
  /// or this share times an unstable one's multiplier.
  double return_of_shafts = 1e-6;
  /// Anything below this share of the small length is rest.
  double least_amplitude = 1e-9;
  /// A motion is on a cycle if amplitudes and centre agree to this share of its amplitude.
  double agreement = 0.02;
  /// Motion is compared with a cycle over this many of its periods.
  double compared_periods = 1.01;
  /// A multiplier whose modulus is this near 1 is neutral.
  double neutral_band = 1e-6;
  /// States this near each other, as a share, are one: half a period later (symmetry), or after a
  /// part of it (a cycle gone round several times).
  double recurrence = 1e-7;
  /// Rounds sought within an orbit: primes below this number.
  int most_rounds = 100;
  /// An orbit is closed again from this many of its periods ...
  double closing_periods = 2.5;
  /// ... and replaced if the new period is below this share of the former.
  double shorter_period = 0.75;
  /// Whole multiples of the sampling period are recognised to this share of it.
  double whole_ticks = 1e-6;
  /// Periods, amplitudes and centres of one cycle agree to this share.
  double same_cycle = 1e-8;
  /// Neutral cycles whose periods agree to this share are one family.
  double same_family = 1e-6;
  /// A motion is on a known stable cycle if its last event is this near one of the cycle's, as a
  /// share of the state.
  double known_event = 1e-4;
};

/// What counts as motion that does not repeat.
struct IrregularTolerances {
  /// The last part must have this many extremes.
  std::size_t least_turns = 8;
  /// Both halves of the watched motion must extend equally far, to this share.
  double steadiness = 0.2;
  /// Motions whose amplitudes, swings and centres agree to this share of their amplitude are one.
  double same_motion = 0.1;
  /// A sampled drive's motion is steady once this many swings ...
  std::size_t enough_swings = 40;
  /// ... or fewer, if the standard errors of their means are below a share, to which they agree ...
  std::size_t few_swings = 8;
  double error_of_means = 0.01;
  /// ... have the mean statistics of those before them, to this share ...
  double steady_statistics = 0.03;
  /// ... or to this share of the encoder's step.
  double steady_steps = 0.5;
  /// Whether, of enough swings, the mean time of a swing may agree in place of the mean period,
  /// which scatters more where the middle wanders. A middle that still drifts may then stay
  /// unnoticed.
  bool pace_suffices = false;
  /// All numbers must then cover the ranges that they covered before, to this share. The period of
  /// a motor that hunts alone, and the extremes of swings that scatter and their middle, may differ
  /// by it too.
  double same_ranges = 0.15;
  /// A decay of the swings by this share over a measurement may be hidden in their scatter: a
  /// faster one must be excluded at 95 %.
  double hidden_decay = 0.1;
  /// Middles of motions with the same means may differ by this share of the amplitude: integral
  /// action moves them slowly to and fro.
  double wandering = 0.3;
  /// Swings that repeat to this share may be a cycle ...
  double repeating = 1e-3;
  /// ... and to this share they need not be many to be steady.
  double repeating_exactly = 1e-6;
};

struct SearchTolerances {
  RestTolerances rest{};
  CycleTolerances cycle{};
  IrregularTolerances irregular{};
  /// A load beyond this many of the drive's largest lengths has run away ...
  double far_away = 1e6;
  /// ... if it is also beyond this many of all its lengths, however many backlashes these are; or
  /// with swings beyond that, if the last of them grow ...
  double far_grown = 1e3;
  /// ... this many, each by no less than the one before, to this share.
  std::size_t growing_swings = 8;
  double steady_growth = 0.99;
};

/// Duration of the search. Swing and settling times are those of the linear loop (TimeScales).
struct SearchBudget {
  /// Decays are negligible after this many settling times: e⁻³⁰ is about 1e-13.
  double settling_times = 30.0;
  /// Swings of the first stretch. Each next one is twice as long.
  double first_stretch = 10.0;
  /// The first stretch of a sampled drive under a sine that is slower than its loop takes this many
  /// periods ...
  double periods_of_sine = 5.0;
  /// ... or this many once a motion is known that it may join.
  double periods_to_join = 1.25;
  /// Ticks do not count as events within so many.
  double most_periods_of_sine = 16.0;
  /// A stretch of a sampled drive ends after this many events, or twice those of the one before: a
  /// motor that ticks after a long standstill has its swings soon.
  std::size_t ticks_of_stretch = 20'000;
  /// The first stretch takes this share of them once a cycle is known that the motion may join.
  double share_to_join = 0.25;
  /// A motion in which hardly anything happens is watched this many times as long ...
  double patience = 20.0;
  /// ... or this many between two starts with different outcomes.
  double patience_at_edges = 2.0;
  /// Irregular motion within which a stable cycle lies is watched this many times as long.
  double longer_if_transient = 8.0;
  /// Time between events and turns counts up to this many swings. While shafts stand, or slide
  /// steadily, it costs nothing to watch; integral action may end it after an hour.
  double counted_between_events = 1.0;
  /// A sampled motion in which hardly anything happens is watched this many times longer.
  double patience_if_sampled = 200.0;
  /// ... but this many times, whatever else, where the search may hurry.
  double hurried_if_sampled = 10.0;
  /// Where watching costs as long as it lasts, because the drive is sampled, a sine acts on it, or
  /// it takes more steps than are kept, all time counts, but of a standstill this share.
  double counted_if_costly = 0.1;
  /// Hardly anything happens if a stretch has fewer swings than this ...
  std::size_t hardly_any_swings = 12;
  /// ... or if one of the stretch's first and last swings is below this share of the other.
  double still_changing = 0.8;
  /// A stretch that is kept ends after this many events. A shaft whose torque comes to rest at its
  /// friction's edge stops and breaks away there without end: its next stretch is at rest.
  std::size_t events_of_stretch = 10'000;
  /// It ends once its steps take this many bytes. A stiff drive takes many steps.
  std::size_t bytes_kept = 64'000'000;
  /// Ticks of a clock do not count as events, up to this many times the events.
  std::size_t most_ticks = 20;
  /// Swings and events of the first glance, which shows the magnitude of the numbers.
  double glance_swings = 5.0;
  std::size_t glance_events = 5000;
  /// Mean periods of a sampled drive's motion that are kept to close a cycle ...
  double closing_periods = 5.0;
  /// ... or to see whether neighbours part.
  double compared_periods = 200.0;
  std::size_t recorded_events = 20'000;
  /// Bisections, by ratio, of the step from which on a drive does not come to rest.
  int bisections_of_steps = 5;
  /// Bisections between two starts; a double has 52 bits.
  int bisections = 52;
  /// After this many of them each time a test shows whether the motion hovers at a cycle ...
  int bisections_between_tries = 13;
  /// ... after one swing, two, and so on up to this many.
  double most_hovering_swings = 40.0;
};

/// Starts that a search chooses by itself.
struct StartTolerances {
  /// Steps from the reference, from this share of the small length ...
  double least_step = 1e-2;
  /// ... to this many of the large length.
  double largest_step = 1e2;
  double steps_per_decade = 2.0;
  int most_steps = 16;
  /// Lengths of friction, load torque and torque limit count up to this many backlashes. Beyond,
  /// the gap does not matter.
  double longest_length = 1e4;
};

}  // namespace gearlash::drive
