// The clocks of a drive, and the signals that change at their ticks.
#include "general/assemble/automata.hpp"

namespace gearlash::drive {

DriveClocks drive_clocks(const DriveForms& forms) {
  DriveClocks result;
  std::vector<hybrid::Clock>& clocks = result.clocks;
  const auto add_signal = [&](const Generator& generator, Eigen::Index at, const char* name) {
    if (generator.times.empty()) return;
    hybrid::Clock clock;
    clock.name = name;
    clock.times = generator.times;
    for (const hybrid::Vector& setting : generator.settings) {
      clock.additions.push_back(hybrid::Vector::Zero(forms.at().size));
      clock.additions.back().segment(at, generator.size()) = setting;
    }
    result.settings.push_back({clocks.size(), at, generator.size(), name});
    clocks.push_back(std::move(clock));
  };
  add_signal(forms.reference_generator(), forms.at().reference, "reference");
  add_signal(forms.load_generator(), forms.at().load_torque, "load torque");
  if (!forms.drive().sampling) return result;
  const Sampling& sampling = *forms.drive().sampling;
  if (keeps_error(forms.drive())) {
    clocks.push_back({.name = "reading",
                      .first = 0.0,
                      .period = sampling.period,
                      .every = static_cast<std::size_t>(position_ticks(sampling))});
  }
  result.sample = clocks.size();
  clocks.push_back({.name = "sample", .first = 0.0, .period = sampling.period});
  if (gives_out_between_samples(sampling)) {
    clocks.push_back(
        {.name = "output", .first = split_delay(sampling).rest, .period = sampling.period});
  }
  return result;
}

void add_settings(const DriveForms& forms, const DriveClocks& clocks, const DriveMode& mode,
                  hybrid::AffineMode& built) {
  for (const Setting& setting : clocks.settings) {
    hybrid::TimedTransition timed;
    timed.name = setting.name;
    timed.clock = setting.clock;
    timed.reset.matrix = forms.identity();
    timed.reset.matrix.block(setting.at, setting.at, setting.size, setting.size).setZero();
    timed.target = forms.modes().index_of(mode);
    if (setting.at == forms.at().reference && forms.drive().feedforward.torque != 0.0) {
      timed.alternatives = reference_speeds(forms, mode);
      const DriveMode still = with(mode, &DriveMode::reference_speed, Branch::inner);
      timed.target = forms.modes().index_of(still);
    }
    built.timed.push_back(std::move(timed));
  }
}

}  // namespace gearlash::drive
