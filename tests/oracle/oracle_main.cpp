// oracle_run: random servos against the reference simulator, and the known limit cycles against its
// long runs. Prints the tables of docs/explanation/verification.md; exit status 1 when anything
// disagrees.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "comparison.hpp"
#include "dissipation.hpp"
#include "reference_cycle.hpp"

namespace {

using gearlash::oracle::CaseReport;
using gearlash::oracle::Method;

struct Settings {
  std::uint64_t servos = 1000;
  std::uint64_t seed = 1960;
  std::uint64_t dissipative = 5000;
  unsigned threads = 2;
  gearlash::oracle::ComparisonOptions comparison;
};

void show_progress(std::uint64_t done, std::uint64_t all) {
  if (isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "\r%llu of %llu servos%s", static_cast<unsigned long long>(done),
               static_cast<unsigned long long>(all), done == all ? "\n" : "");
}

/// `work` on every index below `count`, on all threads.
void for_all(const Settings& settings, std::uint64_t count,
             const std::function<void(std::uint64_t)>& work) {
  std::atomic<std::uint64_t> next = 0;
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < settings.threads; ++i) {
    workers.emplace_back([&] {
      for (std::uint64_t index = next++; index < count; index = next++) {
        work(index);
        show_progress(std::min(next.load(), count), count);
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
}

std::vector<CaseReport> compare_all(const Settings& settings) {
  std::vector<CaseReport> reports(settings.servos);
  std::mutex printing;
  for_all(settings, settings.servos, [&](std::uint64_t index) {
    const auto drawn = gearlash::oracle::random_case(settings.seed, index);
    reports[index] = gearlash::oracle::compare(drawn, settings.comparison);
    const std::lock_guard lock(printing);
    if (!reports[index].failure.empty()) {
      std::fprintf(stderr, "servo %llu: %s\n  %s\n", static_cast<unsigned long long>(index),
                   reports[index].failure.c_str(), gearlash::oracle::describe(drawn).c_str());
    }
  });
  return reports;
}

/// Servos that energy proves not to hunt.
bool print_dissipative(const Settings& settings) {
  std::atomic<std::uint64_t> hunting = 0;
  std::atomic<std::uint64_t> exhausted = 0;
  for_all(settings, settings.dissipative, [&](std::uint64_t index) {
    const auto check = gearlash::oracle::check_dissipation(settings.seed, index);
    exhausted += check.exhausted ? 1U : 0U;
    hunting += check.hunts ? 1U : 0U;
    if (!check.hunts) return;
    std::fprintf(stderr, "%s goes on swinging by %g\n",
                 gearlash::oracle::describe(check.drawn).c_str(), check.late);
  });
  std::printf(
      "\n%llu servos that only take energy from the gap (1/c + 1/D <= 2 damping): %llu hunt, %llu "
      "bounce more often than was followed.\n",
      static_cast<unsigned long long>(settings.dissipative),
      static_cast<unsigned long long>(hunting), static_cast<unsigned long long>(exhausted));
  return hunting == 0;
}

/// Median and worst of one number over the reports.
std::string spread(const std::vector<CaseReport>& reports, double CaseReport::*member) {
  std::vector<double> values;
  for (const CaseReport& report : reports) values.push_back(report.*member);
  if (values.empty()) return "-";
  std::sort(values.begin(), values.end());
  char text[64];
  std::snprintf(text, sizeof text, "%.1e, %.1e", values[values.size() / 2], values.back());
  return text;
}

std::string count(const std::vector<CaseReport>& reports,
                  const std::function<std::size_t(const CaseReport&)>& of) {
  std::size_t total = 0;
  for (const CaseReport& report : reports) total += of(report);
  return std::to_string(total);
}

std::vector<CaseReport> with_method(const std::vector<CaseReport>& reports, Method method) {
  std::vector<CaseReport> chosen;
  for (const CaseReport& report : reports) {
    if (report.method == method) chosen.push_back(report);
  }
  return chosen;
}

std::string percentile(const std::vector<CaseReport>& reports, double share) {
  std::vector<double> values;
  for (const CaseReport& report : reports) values.push_back(report.condition);
  if (values.empty()) return "-";
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", values[rank]);
  return text;
}

void print_table(const std::vector<CaseReport>& all) {
  const std::vector<std::vector<CaseReport>> columns = {with_method(all, Method::odeint),
                                                        with_method(all, Method::exponential)};
  const auto row = [&](const char* title, const auto& entry) {
    std::printf("| %s | %s | %s |\n", title, entry(columns[0]).c_str(), entry(columns[1]).c_str());
  };
  using Reports = std::vector<CaseReport>;
  std::printf("| | Boost.odeint (rates that are not stiff) | matrix exponential (stiff) |\n");
  std::printf("|---|---|---|\n");
  row("servos", [](const Reports& r) { return std::to_string(r.size()); });
  row("events compared", [](const Reports& r) {
    return count(r, [](const CaseReport& report) { return report.events; });
  });
  row("of these settlings (Zeno limits)", [](const Reports& r) {
    return count(r, [](const CaseReport& report) { return report.settlings; });
  });
  row("states compared between events", [](const Reports& r) {
    return count(r, [](const CaseReport& report) { return report.states; });
  });
  row("event time, error/period: median, worst",
      [](const Reports& r) { return spread(r, &CaseReport::time_error); });
  row("state, error/scale: median, worst",
      [](const Reports& r) { return spread(r, &CaseReport::state_error); });
  row("amplitude, relative error: median, worst",
      [](const Reports& r) { return spread(r, &CaseReport::amplitude_error); });
  row("any error/max(1, condition): median, worst",
      [](const Reports& r) { return spread(r, &CaseReport::scaled_error); });
  row("condition: median", [](const Reports& r) { return percentile(r, 0.5); });
  row("condition: 95 %", [](const Reports& r) { return percentile(r, 0.95); });
  row("condition: worst", [](const Reports& r) { return percentile(r, 1.0); });
  row("cut short (grazing, or condition too large)", [](const Reports& r) {
    return count(r, [](const CaseReport& report) { return report.cut_short ? 1U : 0U; });
  });
  row("the two references apart, /max(1, condition)",
      [](const Reports& r) { return spread(r, &CaseReport::reference_difference); });
  row("**failures**", [](const Reports& r) {
    return count(r, [](const CaseReport& report) { return report.failure.empty() ? 0U : 1U; });
  });
}

bool print_cycles() {
  std::printf(
      "\n| damping | inertia ratio | friction ratio | restitution | amplitude, reference | "
      "amplitude, library | period, reference | period, library | agrees |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  bool all_agree = true;
  for (const auto& check : gearlash::oracle::check_known_cycles()) {
    all_agree = all_agree && check.agrees;
    std::printf("| %g | %g | %g | %g | %.12g | %.12g | %.12g | %.12g | %s |\n", check.servo.damping,
                check.servo.inertia_ratio, check.servo.friction_ratio, check.servo.restitution,
                check.reference_amplitude, check.library_amplitude, check.reference_period,
                check.library_period, check.agrees ? "yes" : "**no**");
  }
  const auto irregular = gearlash::oracle::check_irregular_motion();
  std::printf("| %g | %g | %g | %g | %.4g | %.4g | irregular | irregular | %s |\n",
              irregular.servo.damping, irregular.servo.inertia_ratio,
              irregular.servo.friction_ratio, irregular.servo.restitution,
              irregular.reference_amplitude, irregular.library_amplitude,
              irregular.agrees ? "yes" : "**no**");
  return all_agree && irregular.agrees;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app{"Random servos against an independent reference simulator"};
  app.add_option("--servos", settings.servos, "how many")->capture_default_str();
  app.add_option("--seed", settings.seed, "of the random servos")->capture_default_str();
  app.add_option("--dissipative", settings.dissipative, "how many that energy proves not to hunt")
      ->capture_default_str();
  app.add_option("--threads", settings.threads, "workers")
      ->capture_default_str()
      ->check(CLI::Range(1U, 256U));
  app.add_option("--odeint-rate", settings.comparison.fastest_rate_for_odeint,
                 "fastest rate left to Boost.odeint")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);

  const auto start = std::chrono::steady_clock::now();
  const std::vector<CaseReport> reports = compare_all(settings);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  std::printf("Seed %llu, %llu servos, %u threads, %.0f s.\n\n",
              static_cast<unsigned long long>(settings.seed),
              static_cast<unsigned long long>(settings.servos), settings.threads, elapsed.count());
  print_table(reports);
  const bool cycles_agree = print_cycles();
  const bool none_hunts = print_dissipative(settings);
  const bool cases_agree = std::all_of(reports.begin(), reports.end(),
                                       [](const CaseReport& r) { return r.failure.empty(); });
  return cases_agree && cycles_agree && none_hunts ? 0 : 1;
}
