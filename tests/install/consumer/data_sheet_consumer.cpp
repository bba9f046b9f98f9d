// A project that reads data sheets through the installed component io.
#include <cstdio>

#include "input/servo_file.hpp"

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::printf("usage: data_sheet_consumer SERVO.toml\n");
    return 2;
  }
  const gearlash::ServoFile file = gearlash::read_servo_file(arguments[1]);
  std::printf("damping %.6f, inertia ratio %.6f, friction ratio %.6f\n", file.servo.damping,
              file.servo.inertia_ratio, file.servo.friction_ratio);
  return file.drivetrain.has_value() && file.servo.damping > 0 ? 0 : 1;
}
