// The hybrid engine alone: a block on a belt, held by a spring, sticks and slips.
#include <cstdio>
#include <gearlash/hybrid.hpp>

int main() {
  using namespace gearlash::hybrid;
  const double belt = 0.2, breakaway = 1.0, dry = 0.6;  // speed; forces
  System system({"position", "speed"});
  const Mode sliding = system.mode("sliding", {{0, 1}, {-1, 0}}, {0, dry});
  const Mode sticking = system.mode("sticking", {{0, 1}, {0, 0}});
  system.on(sticking, "slip", {{-1, 0}, breakaway}, sliding)
      .on(sliding, "stick", {{0, -1}, belt}, sticking);

  const auto orbit = find_orbit(system, sticking, {0, belt}, 60.0);
  if (!orbit) return std::puts("no cycle"), 1;
  const gearlash::Bounds position = extent(system, *orbit, {{1, 0}});
  std::printf("period %.12f, from %.12f to %.12f, residual %.2g, %s\n", orbit->period, position.low,
              position.high, orbit->residual, orbit->stable ? "stable" : "unstable");
}
