// A drive built in code: does it matter on which shaft the encoder is?
#include <gearlash/gearlash.hpp>
#include <iostream>
#include <numbers>

int main() {
  using namespace gearlash;
  Drive drive{
      .motor = {.inertia = 2e-4, .friction = {.viscous = 1e-4}},
      .gearbox = {.ratio = 50.0, .backlash = 0.2 * std::numbers::pi / 180.0},
      .load = {.inertia = 0.02, .friction = {.viscous = 0.01}},
      .controller = {
          .law = PID{
              .terms = PIDTerms::PD, .proportional = 0.5, .derivative = 20e-3, .filter = 5e-3}}};
  for (const SensorPlace place : {SensorPlace::load, SensorPlace::motor}) {
    drive.sensor.position = place;
    std::cout << (place == SensorPlace::load ? "load:  " : "motor: ")
              << headline(drive, analyse(drive)) << '\n';
  }
}
