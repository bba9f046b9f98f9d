// score_drives: random drives, or a folder of drive files, judged by the library and by the
// fixed-step simulator. With --follow the library's exact motions follow every start too, longer
// than the search did, and the ends of the pieces of rest. A line for each drive, one for each
// start that is not plainly right, and a summary. Exit status 1 when a drive is wrong.

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "drive_score.hpp"
#include "following.hpp"
#include "gearlash/input.hpp"
#include "gearlash/output.hpp"
#include "random_drive.hpp"

namespace {

using gearlash::Drive;
using gearlash::oracle::Agreement;
using gearlash::oracle::DriveKind;
using gearlash::oracle::DriveScore;
using gearlash::oracle::Ending;
using gearlash::oracle::FollowedDrive;
using gearlash::oracle::ScoredStart;

struct Settings {
  std::string seeds;
  std::string starts = "few";
  std::string folder;
  std::string write;
  bool all_lines = false;
  std::string kind = "industrial";
  bool follows = false;
  gearlash::oracle::ScoreOptions options;
  gearlash::oracle::FollowOptions follow_options;
};

using MakeDrive = std::function<Drive(std::uint64_t)>;

/// The kinds of random drives by name.
std::map<std::string, MakeDrive> kinds() {
  const auto of = [](DriveKind kind) {
    return [kind](std::uint64_t seed) { return gearlash::oracle::random_drive(seed, kind); };
  };
  return {{"industrial", of(DriveKind::industrial)},
          {"continuous", gearlash::oracle::continuous_drive},
          {"filtered-cascade", of(DriveKind::filtered_cascade)},
          {"weight-at-limit", of(DriveKind::weight_at_limit)},
          {"state-space", of(DriveKind::state_space)},
          {"moving-reference", of(DriveKind::moving_reference)},
          {"two-rates", of(DriveKind::two_rates)},
          {"without-integral", of(DriveKind::without_integral)},
          {"extreme", of(DriveKind::extreme)},
          {"frictionless", gearlash::oracle::frictionless_drive}};
}

struct NamedDrive {
  std::string name;
  Drive drive;
};

struct Totals {
  std::vector<std::string> right, wrong, undecided, no_measure, refused;
  std::vector<double> seconds;
  std::size_t starts = 0, followed = 0, cut_short = 0, times = 0, pieces = 0;
  std::size_t followed_near_border = 0;
  std::size_t starts_near_border = 0;
  std::size_t random = 0, random_unclear = 0, near_border = 0, unlisted = 0;
};

std::string kind_of(const Drive& drive) {
  std::string kind = "plastic";
  if (const auto* rigid = std::get_if<gearlash::RigidContact>(&drive.contact)) {
    if (rigid->restitution > 0.0) kind = "bouncing";
  } else {
    kind = "compliant";
  }
  const auto& law = drive.controller.law;
  kind += std::holds_alternative<gearlash::CascadeController>(law)      ? " cascade"
          : std::holds_alternative<gearlash::StateSpaceController>(law) ? " state-space"
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

void print_lines(const char* title, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::printf("    %s %s\n", title, line.c_str());
}

void print_drive(const NamedDrive& named, const DriveScore& score, const FollowedDrive& followed,
                 bool all_lines) {
  const std::size_t all = score.answer.search ? score.answer.search->starts.size() : 0;
  std::printf("%s | %s | %s | %.2f s | undecided %zu of %zu | right %zu", named.name.c_str(),
              kind_of(named.drive).c_str(), headline(named.drive, score.answer).c_str(),
              score.processor_seconds, score.undecided, all, score.count(Agreement::right));
  for (const Agreement one :
       {Agreement::right_as_it_fades, Agreement::right_of_other_size, Agreement::wrong,
        Agreement::undecided, Agreement::near_border, Agreement::no_measure}) {
    if (score.count(one) > 0) std::printf(", %s %zu", name_of(one), score.count(one));
  }
  if (!score.refused.empty()) std::printf(" | not compared: %s", score.refused.c_str());
  std::printf("\n");
  for (const ScoredStart& start : score.starts) {
    if (all_lines || start.agreement != Agreement::right) print_start(start);
  }
  print_lines("WRONG, a random start:", score.random.contradictions);
  print_lines("WRONG by simulate:", followed.contradictions);
  std::fflush(stdout);
}

bool is_wrong(const DriveScore& score, const FollowedDrive& followed) {
  return score.count(Agreement::wrong) > 0 || !score.random.contradictions.empty() ||
         !followed.contradictions.empty();
}

void count_in(const std::string& name, const DriveScore& score, const FollowedDrive& followed,
              Totals& totals) {
  totals.seconds.push_back(score.processor_seconds);
  totals.starts += score.starts.size();
  totals.starts_near_border += score.count(Agreement::near_border);
  totals.followed += followed.starts;
  totals.cut_short += followed.cut_short;
  totals.followed_near_border += followed.near_border;
  totals.times += followed.times;
  totals.pieces += followed.pieces;
  totals.random += score.random.followed;
  totals.random_unclear += score.random.unclear;
  totals.near_border += score.random.near_border;
  totals.unlisted += score.random.unlisted;
  if (is_wrong(score, followed)) {
    totals.wrong.push_back(name);
  } else if (!score.is_decided()) {
    totals.undecided.push_back(name);
  } else if (!score.refused.empty()) {
    totals.refused.push_back(name);
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
  print_names("simulator is unclear or disagrees with itself", totals.no_measure);
  print_names("simulator does not know", totals.refused);
  std::printf("starts of the library in the simulator: %zu, near a border %zu\n", totals.starts,
              totals.starts_near_border);
  std::printf("random starts: %zu, near a border %zu, unclear %zu, of unlisted size %zu\n",
              totals.random, totals.near_border, totals.random_unclear, totals.unlisted);
  std::printf(
      "starts by simulate: %zu, cut short %zu, near a border %zu; times to rest %zu; pieces of "
      "rest %zu\n",
      totals.followed, totals.cut_short, totals.followed_near_border, totals.times, totals.pieces);
  double sum = 0.0;
  for (const double seconds : totals.seconds) sum += seconds;
  std::printf(
      "processor time of the library: median %.2f s, 90 %% %.2f s, 99 %% %.2f s, sum %.0f s\n",
      percentile(totals.seconds, 0.5), percentile(totals.seconds, 0.9),
      percentile(totals.seconds, 0.99), sum);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak memory of this program: %ld MB\n", usage.ru_maxrss / 1024);
}

std::vector<NamedDrive> drives_of(const Settings& settings) {
  std::vector<NamedDrive> drives;
  const MakeDrive make = kinds().at(settings.kind);
  if (!settings.seeds.empty()) {
    const std::size_t colon = settings.seeds.find(':');
    const std::uint64_t first = std::stoull(settings.seeds.substr(0, colon));
    const std::uint64_t last =
        colon == std::string::npos ? first : std::stoull(settings.seeds.substr(colon + 1));
    for (std::uint64_t seed = first; seed <= last; ++seed) {
      drives.push_back({settings.kind + " seed " + std::to_string(seed), make(seed)});
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
      FollowedDrive followed;
      if (settings.follows) {
        followed = follow_all(named.drive, score.answer, settings.follow_options);
      }
      print_drive(named, score, followed, settings.all_lines);
      count_in(named.name, score, followed, totals);
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
  std::set<std::string> names;
  for (const auto& [name, make] : kinds()) names.insert(name);
  app.add_option("--kind", settings.kind, "of random drives")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  app.add_option("--random-starts", settings.options.random_starts,
                 "other starts, which the simulator follows beside the verdict")
      ->capture_default_str();
  app.add_flag("--follow", settings.follows,
               "every start by the library's exact motions too, ten times longer at rest and four "
               "times hunting, and the ends of the pieces of rest");
  app.add_option("--most-events", settings.follow_options.most_events, "of such a motion")
      ->capture_default_str();
  app.add_option("--folder", settings.folder, "drive files (*.toml)");
  app.add_option("--starts", settings.starts,
                 "compared of the library's own: few (6), all, N, or 0")
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
    settings.options.starts.reset();
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
