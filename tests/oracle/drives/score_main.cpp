// score_drives: random industrial drives, or a folder of drive files, judged by the library and by
// the fixed-step simulator. A line for each drive, one for each start that is not plainly right,
// and a summary. Exit status 1 when a drive is wrong.

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "drive_score.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "random_drive.hpp"

namespace {

using gearlash::Drive;
using gearlash::oracle::Agreement;
using gearlash::oracle::DriveScore;
using gearlash::oracle::Ending;
using gearlash::oracle::ScoredStart;

struct Settings {
  std::string seeds;
  std::string starts = "few";
  std::string folder;
  std::string write;
  bool all_lines = false;
  bool continuous = false;
  gearlash::oracle::ScoreOptions options;
};

struct NamedDrive {
  std::string name;
  Drive drive;
};

struct Totals {
  std::vector<std::string> right, wrong, undecided, no_measure;
  std::vector<double> seconds;
};

std::string kind_of(const Drive& drive) {
  std::string kind = "plastic";
  if (const auto* rigid = std::get_if<gearlash::RigidContact>(&drive.contact)) {
    if (rigid->restitution > 0.0) kind = "bouncing";
  } else {
    kind = "compliant";
  }
  kind += std::holds_alternative<gearlash::CascadeController>(drive.controller.law) ? " cascade"
                                                                                    : " PID";
  if (drive.load_torque) kind += " load-torque";
  if (drive.load.gravity > 0.0) kind += " gravity";
  return kind;
}

std::string text_of(const Ending& ending) {
  char text[160];
  std::snprintf(text, sizeof text, "%s load %.4g motor %.4g (before %.4g %.4g) %.4g Hz, %.0f s",
                name_of(ending.kind), ending.amplitude, ending.motor_amplitude,
                ending.earlier_amplitude, ending.earlier_motor_amplitude, ending.frequency,
                ending.time);
  return text;
}

void print_start(const ScoredStart& scored) {
  const gearlash::StartOutcome& start = scored.start;
  std::printf("    %s: load %.6g at %.3g, motor %.6g: library %s", name_of(scored.agreement),
              start.load_position, start.load_speed, start.motor_position, start.end.c_str());
  if (start.which) {
    std::printf(" load %.4g motor %.4g %.4g Hz", scored.amplitude, scored.motor_amplitude,
                scored.frequency);
  }
  if (!start.reason.empty()) std::printf(" (%s)", start.reason.c_str());
  std::printf(" watched %.3g s", start.watched);
  std::printf(" | simulator %s", text_of(scored.ending).c_str());
  if (scored.agreement == Agreement::no_measure) {
    std::printf(" | half step %s", text_of(scored.ending_of_half_step).c_str());
  }
  std::printf("\n");
}

void print_drive(const NamedDrive& named, const DriveScore& score, bool all_lines) {
  const std::size_t all = score.answer.search ? score.answer.search->starts.size() : 0;
  std::printf("%s | %s | %s | %.2f s | undecided %zu of %zu | right %zu", named.name.c_str(),
              kind_of(named.drive).c_str(), headline(named.drive, score.answer).c_str(),
              score.processor_seconds, score.undecided, all, score.count(Agreement::right));
  for (const Agreement one : {Agreement::right_as_it_fades, Agreement::wrong, Agreement::undecided,
                              Agreement::no_measure}) {
    if (score.count(one) > 0) std::printf(", %s %zu", name_of(one), score.count(one));
  }
  std::printf("\n");
  for (const ScoredStart& start : score.starts) {
    if (all_lines || start.agreement != Agreement::right) print_start(start);
  }
  std::fflush(stdout);
}

void count_in(const std::string& name, const DriveScore& score, Totals& totals) {
  totals.seconds.push_back(score.processor_seconds);
  if (score.count(Agreement::wrong) > 0) {
    totals.wrong.push_back(name);
  } else if (!score.is_decided()) {
    totals.undecided.push_back(name);
  } else if (score.count(Agreement::no_measure) > 0) {
    totals.no_measure.push_back(name);
  } else {
    totals.right.push_back(name);
  }
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank =
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
  return values[rank];
}

void print_names(const char* title, const std::vector<std::string>& names) {
  std::printf("%s: %zu", title, names.size());
  for (const std::string& name : names) std::printf(" %s", name.c_str());
  std::printf("\n");
}

void print_summary(const Totals& totals) {
  if (totals.seconds.empty()) return;
  std::printf("\ndrives: %zu\nright: %zu\n", totals.seconds.size(), totals.right.size());
  print_names("wrong", totals.wrong);
  print_names("undecided", totals.undecided);
  print_names("simulator disagrees with itself", totals.no_measure);
  double sum = 0.0;
  for (const double seconds : totals.seconds) sum += seconds;
  std::printf("processor time of the library: median %.2f s, 99 %% %.2f s, sum %.0f s\n",
              percentile(totals.seconds, 0.5), percentile(totals.seconds, 0.99), sum);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak memory of this program: %ld MB\n", usage.ru_maxrss / 1024);
}

std::vector<NamedDrive> drives_of(const Settings& settings) {
  std::vector<NamedDrive> drives;
  if (!settings.seeds.empty()) {
    const std::size_t colon = settings.seeds.find(':');
    const std::uint64_t first = std::stoull(settings.seeds.substr(0, colon));
    const std::uint64_t last =
        colon == std::string::npos ? first : std::stoull(settings.seeds.substr(colon + 1));
    for (std::uint64_t seed = first; seed <= last; ++seed) {
      drives.push_back({"seed " + std::to_string(seed),
                        settings.continuous ? gearlash::oracle::continuous_drive(seed)
                                            : gearlash::oracle::random_drive(seed)});
    }
  }
  if (!settings.folder.empty()) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(settings.folder)) {
      if (entry.path().extension() == ".toml") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
      drives.push_back({file.filename().string(), gearlash::read_drive(file)});
    }
  }
  return drives;
}

void write(const NamedDrive& named, const std::string& folder) {
  std::string file = named.name;
  std::replace(file.begin(), file.end(), ' ', '-');
  gearlash::save(std::filesystem::path(folder) / (file + ".toml"), gearlash::to_toml(named.drive));
}

int score(const Settings& settings) {
  Totals totals;
  for (const NamedDrive& named : drives_of(settings)) {
    if (!settings.write.empty()) {
      write(named, settings.write);
      continue;
    }
    try {
      const DriveScore score = score_of(named.drive, settings.options);
      print_drive(named, score, settings.all_lines);
      count_in(named.name, score, totals);
    } catch (const std::exception& refused) {
      std::printf("%s | not compared: %s\n", named.name.c_str(), refused.what());
    }
  }
  print_summary(totals);
  return totals.wrong.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app{"Industrial drives: the library against a fixed-step simulator, start by start"};
  app.add_option("--seeds", settings.seeds, "random drives, FROM:TO");
  app.add_flag("--continuous", settings.continuous,
               "random drives without a computer: continuous controllers, exact sensors");
  app.add_option("--folder", settings.folder, "drive files (*.toml)");
  app.add_option("--starts", settings.starts, "compared of the library's own: few (6), all, N")
      ->capture_default_str();
  app.add_option("--time-limit", settings.options.time_limit,
                 "processor seconds of the library for each drive; 0: none")
      ->capture_default_str();
  app.add_option("--longest", settings.options.ending.longest_time,
                 "seconds that the simulator follows a start at most")
      ->capture_default_str();
  app.add_option("--step", settings.options.ending.longest_step, "seconds, of the simulator")
      ->capture_default_str();
  app.add_option("--write", settings.write, "write the drives into this folder, score nothing");
  app.add_flag("--all-lines", settings.all_lines, "print the starts that are right too");
  CLI11_PARSE(app, argc, argv);
  if (settings.starts == "all") {
    settings.options.starts = 0;
  } else if (settings.starts != "few") {
    settings.options.starts = std::stoull(settings.starts);
  }
  try {
    return score(settings);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "score_drives: %s\n", failure.what());
    return 2;
  }
}
