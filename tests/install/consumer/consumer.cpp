// What another project does first with Gearlash: the limit cycle of one servo.
#include <cmath>
#include <cstdio>
#include <gearlash/analyse.hpp>
#include <gearlash/version.hpp>

int main() {
  const gearlash::Answer answer = analyse(gearlash::normal_form(0.19, 2.0, 0.1, 0.3));
  if (answer.cycles.size() != 1) {
    std::printf("found %zu limit cycles instead of one\n", answer.cycles.size());
    return 1;
  }
  const double amplitude = answer.cycles.front().amplitude;
  std::printf("Gearlash %s: %s, amplitude %.9f\n", gearlash::version, name_of(answer.verdict),
              amplitude);
  // The exact amplitude to the nine digits that are printed of it.
  return std::abs(amplitude - 0.241611108) < 0.5e-9 ? 0 : 1;
}
