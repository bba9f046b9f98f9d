// What may change, by itself, so that a drive hunts no more; and which margins it has then.
#include <cstdio>
#include <gearlash/design.hpp>
#include <gearlash/input.hpp>

int main(int argument_count, char** arguments) {
  using namespace gearlash;
  if (argument_count != 2) return std::puts("usage: design DRIVE.toml"), 2;
  const Drive drive = read_drive(arguments[1]);
  const Target target = parse_target("no-hunting and growth-at-rest <= 0.9", drive);
  for (const char* path : {"controller.proportional", "load.friction", "motor.friction"}) {
    for (const Bounds& interval : values(drive, path, target).intervals)
      std::printf("%s: %.5g to %.5g\n", path, interval.low, interval.high);
  }
  const HuntingMargin margin = margins(drive);
  for (const ParameterMargin& one : margin.parameters) {
    if (one.above) std::printf("hunting ends with %s = %.5g\n", one.parameter.c_str(), *one.above);
  }
}
