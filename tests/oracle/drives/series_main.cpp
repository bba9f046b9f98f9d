// check_series: random units of the series of a drive, by the fixed-step simulator alone. One line
// of JSON. Exit status 1 where a unit hunts by more than one step of its encoder or runs away.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "gearlash/input.hpp"
#include "series_check.hpp"
#include "textbook_gains.hpp"

namespace {

struct Settings {
  std::string file;
  bool textbook = false;
  gearlash::oracle::SeriesOptions options;
};

int check(const Settings& settings) {
  using namespace gearlash::oracle;
  PlainDrive drive = plain_drive(gearlash::read_drive(settings.file));
  if (settings.textbook) drive = with_textbook_gains(drive);
  const SeriesCheck found = check_series(drive, settings.options);
  const SeriesUnit worst = unit_of(drive, found.worst, settings.options);
  std::printf(
      "{\"units\": %zu, \"kept\": %zu, \"rest\": %zu, \"within\": %zu, \"beyond\": %zu, "
      "\"runs_away\": %zu, \"unclear\": %zu, \"worst\": %zu, \"worst_steps\": %.3g, "
      "\"motor_inertia\": %.2f, \"load_inertia\": %.2f, \"motor_dry\": %.2f, \"load_dry\": %.2f, "
      "\"gap\": %.2f, \"start\": %.3g, \"position\": %.4g, \"speed\": %.4g, \"integral\": %.4g}\n",
      settings.options.units, found.kept(), found.resting, found.within, found.beyond,
      found.running_away, found.unclear, found.worst,
      found.running_away > 0 ? 1e9 : found.worst_amplitude / drive.step, worst.motor_inertia,
      worst.load_inertia, worst.motor_dry, worst.load_dry, worst.gap,
      (worst.start.load_position - drive.reference) / drive.backlash, drive.controller.position,
      drive.controller.proportional, drive.controller.integral);
  return found.kept() == settings.options.units ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app{"Random units of the series of a drive, by the fixed-step simulator"};
  app.add_option("DRIVE.toml", settings.file, "of a cascade with an encoder")->required();
  app.add_flag("--textbook", settings.textbook, "with the gains of the symmetric optimum");
  app.add_option("--units", settings.options.units, "number of units")->capture_default_str();
  app.add_option("--seed", settings.options.seed, "of the units")->capture_default_str();
  app.add_option("--step", settings.options.ending.longest_step, "seconds, of the simulator")
      ->capture_default_str();
  app.add_option("--longest", settings.options.patience, "seconds that a unit is followed at most")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return check(settings);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "check_series: %s\n", failure.what());
    return 2;
  }
}
