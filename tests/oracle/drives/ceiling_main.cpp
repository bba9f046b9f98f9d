// bound_drives: the ceilings of random industrial drives: how many have one, and the time it takes.
// With --follow each is also followed by the fixed-step simulator: exit status 1 if one swings
// further than its ceiling.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "ending.hpp"
#include "model/reduced_drive.hpp"
#include "plain_drive.hpp"
#include "question/loop/ceiling/ceiling.hpp"
#include "random_drive.hpp"

namespace {

using gearlash::Ceiling;
using gearlash::Drive;

struct Settings {
  std::uint64_t first = 1;
  std::uint64_t count = 100;
  bool follows = false;
};

/// Ceilings hold for what damping of the faces cannot exceed, and off the limits of torque and
/// current: without them.
Drive drive_of(std::uint64_t seed) {
  Drive drive = gearlash::oracle::random_drive(seed);
  drive.motor.limit.reset();
  drive.motor.current_limit.reset();
  if (auto* faces = std::get_if<gearlash::CompliantContact>(&drive.contact)) faces->damping = 0.0;
  return drive;
}

std::string kind_of(const Drive& drive) {
  const bool is_rigid = std::holds_alternative<gearlash::RigidContact>(drive.contact);
  const bool is_cascade = std::holds_alternative<gearlash::CascadeController>(drive.controller.law);
  return std::string(is_rigid ? "rigid" : "compliant") + (is_cascade ? ", cascade" : ", PID") +
         (drive.sampling->speed_by_differences ? "" : ", tachometer");
}

/// Whether the simulator stays within the ceiling, from a start of some gaps.
bool stays_within(const Drive& drive, const Ceiling& ceiling, std::uint64_t seed) {
  const gearlash::oracle::PlainDrive plain = gearlash::oracle::plain_drive(drive);
  const double start = 2.0 * plain.backlash;
  const gearlash::oracle::Ending ending =
      ending_of(plain, {.motor_position = start, .load_position = start});
  if (ending.kind != gearlash::oracle::EndKind::hunts) return true;
  const bool is_within =
      ending.amplitude <= *ceiling.load && ending.motor_amplitude <= *ceiling.motor;
  std::printf("seed %llu: load %.4g of %.4g, motor %.4g of %.4g%s\n",
              static_cast<unsigned long long>(seed), ending.amplitude, *ceiling.load,
              ending.motor_amplitude, *ceiling.motor, is_within ? "" : " EXCEEDED");
  return is_within;
}

int bound(const Settings& settings) {
  std::vector<std::pair<double, std::uint64_t>> times;
  std::map<std::string, std::pair<int, int>> kinds;  // with a ceiling, all
  std::map<std::string, int> reasons;
  int exceeded = 0;
  for (std::uint64_t seed = settings.first; seed < settings.first + settings.count; ++seed) {
    const Drive drive = drive_of(seed);
    const auto reduced = gearlash::reduce(drive);
    const std::clock_t start = std::clock();
    const Ceiling ceiling = gearlash::ceiling_of(reduced);
    times.emplace_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, seed);
    auto& [bounded, all] = kinds[kind_of(drive)];
    ++all;
    bounded += ceiling.load ? 1 : 0;
    if (!ceiling.load) ++reasons[ceiling.reason];
    if (settings.follows && ceiling.load && !stays_within(drive, ceiling, seed)) ++exceeded;
  }
  std::sort(times.begin(), times.end());
  for (const auto& [kind, counts] : kinds) {
    std::printf("%-32s %d of %d have a ceiling\n", kind.c_str(), counts.first, counts.second);
  }
  for (const auto& [reason, count] : reasons) std::printf("%d: %s\n", count, reason.c_str());
  const auto at = [&](double share) {
    return 1e3 *
           times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))].first;
  };
  std::printf("processor time: median %.1f ms, 99 %% %.1f ms, worst %.1f ms (seed %llu)\n", at(0.5),
              at(0.99), at(1.0), static_cast<unsigned long long>(times.back().second));
  if (settings.follows) std::printf("exceeded: %d\n", exceeded);
  return exceeded == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app{"Ceilings of random industrial drives: how many, how soon, and never exceeded"};
  app.add_option("--first", settings.first, "seed of the first drive")->capture_default_str();
  app.add_option("--count", settings.count, "number of drives, ≥ 1")->capture_default_str();
  app.add_flag("--follow", settings.follows, "follow each drive in the fixed-step simulator");
  CLI11_PARSE(app, argc, argv);
  try {
    return bound(settings);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "bound_drives: %s\n", failure.what());
    return 2;
  }
}
