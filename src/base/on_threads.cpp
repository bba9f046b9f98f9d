// on_threads() by oneTBB. on_one_thread.cpp is the other backend.
#include "base/on_threads.hpp"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

namespace gearlash {
namespace {

/// Number of threads that the system permits, at most `wanted`, with the calling one. They are
/// started for a moment, because TBB relies on all its threads: if one of them cannot start
/// another, the program ends.
std::size_t startable_threads(std::size_t wanted) {
  std::latch all_started(1);
  std::vector<std::jthread> others;
  others.reserve(wanted);
  try {
    while (others.size() + 1 < wanted) {
      others.emplace_back([&all_started] { all_started.wait(); });
    }
  } catch (const std::system_error&) {  // no more
  }
  all_started.count_down();
  return others.size() + 1;
}

/// `wanted`, or fewer if the system refuses them.
std::size_t permitted_threads(std::size_t wanted) {
  static std::atomic<std::size_t> most_started = 1;
  if (wanted <= most_started) return wanted;
  const std::size_t found = startable_threads(wanted);
  std::size_t before = most_started;
  while (before < found && !most_started.compare_exchange_weak(before, found)) {
  }
  return found;
}

}  // namespace

void on_threads(std::size_t threads, std::size_t count,
                const std::function<void(std::size_t)>& work) {
  const auto cores = static_cast<std::size_t>(std::max(1, tbb::info::default_concurrency()));
  const std::size_t wanted = threads == 0 ? cores : threads;
  const std::size_t permitted = permitted_threads(wanted);
  if (permitted == 1) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  std::optional<tbb::global_control> other_than_cores;
  if (permitted != cores) {
    other_than_cores.emplace(tbb::global_control::max_allowed_parallelism, permitted);
  }
  tbb::task_arena arena(static_cast<int>(permitted));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, std::size_t{1}, work); });
}

}  // namespace gearlash
