#include "base/on_threads.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <optional>

namespace gearlash {

void on_threads(std::size_t threads, std::size_t count,
                const std::function<void(std::size_t)>& work) {
  std::optional<tbb::global_control> more_than_cores;
  if (threads > 0) {
    more_than_cores.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, std::size_t{1}, work); });
}

}  // namespace gearlash
