#include "thesis/mendings.hpp"

#include <limits>

#include "thesis/exact_curve.hpp"
#include "thesis/printout.hpp"
#include "thesis/settled_cycle.hpp"

namespace gearlash::thesis {

const std::vector<NamedMending>& mendings() {
  static const std::vector<NamedMending> all = {
      {"as it was", {}},
      {"1 mended: derivatives formed anew at each step", {.fresh_first_stage = true}},
      {"2 mended: the load's own derivative after RESET", {.load_derivative_its_own = true}},
      {"3 mended: motor and load in one step in the gap", {.shafts_together = true}},
      {"4 mended: contact found within the step", {.contact_interpolated = true}},
      {"4 mended: derivative with the motor's new position", {.new_position_at_contact = true}},
      {"3 and 4 mended: one step, contact found within it",
       {.shafts_together = true, .contact_interpolated = true}},
      {"θ_M in the motor's equation in the gap", {.motor_position_in_gap = true}}};
  return all;
}

int numbers_reproduced(const Mending& mending) {
  const auto lines = printout<double>(listed_parameters, thesis_table_2().size(), mending);
  return reproduction_of(lines).within_one;
}

double amplitude_error(const NormalizedServo& servo, const Mending& mending) {
  const SettledCycle cycle = run_until_settled(program_parameters(servo), mending);
  if (!cycle.hunts) return std::numeric_limits<double>::quiet_NaN();
  return cycle.amplitude / exact_amplitude(servo).value() - 1.0;
}

}  // namespace gearlash::thesis
