// The same work for many indices, on as many threads as are asked for.
#pragma once

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <optional>

namespace gearlash::detail {

/// work(0), …, work(count − 1) in any order; 0 threads: as many as the machine has cores.
template <class Work>
void on_threads(std::size_t threads, std::size_t count, const Work& work) {
  std::optional<tbb::global_control> more_than_cores;
  if (threads > 0) {
    more_than_cores.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, std::size_t{1}, work); });
}

}  // namespace gearlash::detail
