// How the limit cycle of a drive with faces that give tends to that of rigid faces as they become
// stiffer. With damping in proportion to stiffness contact becomes plastic, as 1/stiffness; with
// the mesh's critical damping it becomes that of a restitution of exp(−2), as 1/√stiffness.
//
// Columns for a plot with both axes logarithmic (in gnuplot: set logscale; plot 'table' using 1:3,
// '' using 1:5).
#include <cmath>
#include <cstdio>

#include "general/attractors/attractors.hpp"

using gearlash::ContactDamping;
using namespace gearlash::drive;

namespace {

/// The servo of the thesis, ω_n = 1: ζ 0.19, J_L/J_M 2, F_L/F 0.1, total gap 0.3 rad.
ReducedDrive thesis_servo(const Contact& contact) {
  ReducedDrive drive;
  drive.motor = {.inertia = 1.0 / 3.0, .friction = {.viscous = 0.38 * 0.9}};
  drive.load = {.inertia = 2.0 / 3.0, .friction = {.viscous = 0.38 * 0.1}};
  drive.backlash = 0.3;
  drive.contact = contact;
  drive.controller.direct = {1.0, -1.0, 0.0};
  return drive;
}

/// Of the cycle that a step of 0.3 rad ends in.
double amplitude_of(const Contact& contact) {
  const ShaftStates start{.motor_position = 0.45, .load_position = 0.3};
  const AttractorSearch found = find_attractors(thesis_servo(contact), {.starts = {start}});
  return found.cycles.empty() ? std::nan("") : found.cycles.front().amplitude;
}

}  // namespace

int main() {
  constexpr double reduced_inertia = 2.0 / 9.0;  // J_M J_L/(J_M + J_L)
  constexpr double relaxation = 0.1;             // s, damping/stiffness
  const double plastic = amplitude_of(RigidContact{0.0});
  const double bouncing = amplitude_of(RigidContact{std::exp(-2.0)});
  std::printf("# rigid, restitution 0: %.9f; exp(-2): %.9f\n", plastic, bouncing);
  std::printf("# stiffness   c = 0.1 k    from plastic  c critical   from exp(-2)\n");
  for (int decade = 2; decade <= 6; ++decade) {
    const double stiffness = std::pow(10.0, decade);
    const double critical = 2.0 * std::sqrt(stiffness * reduced_inertia);
    const double slow =
        amplitude_of(CompliantContact{stiffness, relaxation * stiffness, ContactDamping::full});
    const double quick = amplitude_of(CompliantContact{stiffness, critical, ContactDamping::full});
    std::printf("  %9.0f   %.9f  %.3e     %.9f  %.3e\n", stiffness, slow, std::abs(slow - plastic),
                quick, std::abs(quick - bouncing));
  }
}
