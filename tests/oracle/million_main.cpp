// million_servos: random servos by the million, every segment of their motion certified free of
// missed crossings, every event checked. Exit status 1 when there is a fault.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <mutex>
#include <thread>
#include <vector>

#include "segment_certificate.hpp"

namespace {

using gearlash::oracle::CertificateCounts;

struct Settings {
  std::uint64_t servos = 1'000'000;
  std::uint64_t seed = 1960;
  unsigned threads = 2;
  double until = 12.566370614359172;  // two undamped periods
  std::size_t event_limit = 20;
  bool list = false;
};

void show_progress(std::uint64_t done, std::uint64_t all) {
  if (isatty(STDERR_FILENO) == 0) return;
  constexpr std::uint64_t width = 40;
  const auto filled = static_cast<int>(done * width / all);
  std::fprintf(stderr, "\r[%.*s%*s] %3llu %%%s", filled, "########################################",
               static_cast<int>(width) - filled, "",
               static_cast<unsigned long long>(done * 100 / all), done == all ? "\n" : "");
}

/// Every servo has its own seed and the counts are sums and maxima, so the result is the same for
/// any number of threads.
CertificateCounts certify_all(const Settings& settings) {
  constexpr std::uint64_t batch = 1000;
  CertificateCounts total;
  std::atomic<std::uint64_t> next = 0;
  std::mutex adding;
  const auto work = [&] {
    for (std::uint64_t first = next.fetch_add(batch); first < settings.servos;
         first = next.fetch_add(batch)) {
      CertificateCounts counts;
      const std::uint64_t last = std::min(first + batch, settings.servos);
      for (std::uint64_t index = first; index < last; ++index) {
        const auto drawn = gearlash::oracle::random_case(settings.seed, index);
        CertificateCounts one =
            gearlash::oracle::certify(drawn, settings.until, settings.event_limit);
        one.first_fault_servo = index;
        if (settings.list && one.faults > 0) {
          std::fprintf(stderr, "servo %llu: %s\n", static_cast<unsigned long long>(index),
                       one.first_fault.c_str());
        }
        counts.add(one);
      }
      const std::lock_guard lock(adding);
      total.add(counts);
      show_progress(total.servos, settings.servos);
    }
  };
  std::vector<std::thread> workers;
  for (unsigned i = 0; i < settings.threads; ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  return total;
}

void print_row(const char* title, std::uint64_t value) {
  std::printf("| %s | %llu |\n", title, static_cast<unsigned long long>(value));
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app{"Certify the motion of random servos, a million by default"};
  app.add_option("--servos", settings.servos, "how many")->capture_default_str();
  app.add_option("--seed", settings.seed, "of the random servos")->capture_default_str();
  app.add_option("--threads", settings.threads, "workers")
      ->capture_default_str()
      ->check(CLI::Range(1U, 256U));
  app.add_flag("--list", settings.list, "every fault on standard error");
  CLI11_PARSE(app, argc, argv);

  const auto start = std::chrono::steady_clock::now();
  const CertificateCounts counts = certify_all(settings);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  std::printf("Seed %llu, %u threads, %.0f s.\n\n| | |\n|---|---|\n",
              static_cast<unsigned long long>(settings.seed), settings.threads, elapsed.count());
  print_row("servos", counts.servos);
  print_row("segments", counts.segments);
  print_row("events", counts.events);
  print_row("of these chains of bounces summed up", counts.settlings);
  print_row("cells in which a zero was excluded", counts.cells);
  print_row("undecidable: closer to grazing than rounding can tell", counts.undecidable);
  std::printf("| largest distance of those, of the scale | %.1e |\n", counts.closest_grazing);
  std::printf("| worst error of an event's time, of the period | %.1e |\n",
              counts.worst_event_time);
  print_row("**faults**", counts.faults);
  if (counts.faults == 0) return 0;
  std::printf("\nFirst: servo %llu: %s\n%s\n",
              static_cast<unsigned long long>(counts.first_fault_servo), counts.first_fault.c_str(),
              gearlash::oracle::describe(
                  gearlash::oracle::random_case(settings.seed, counts.first_fault_servo))
                  .c_str());
  return 1;
}
