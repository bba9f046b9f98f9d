// The same work for many indices, on as many threads as are asked for.
#pragma once

#include <cstddef>
#include <functional>

namespace gearlash {

/// work(0), …, work(count − 1) in any order, several at a time; 0 threads: as many as the machine
/// has cores. Where the system lets fewer be started, on those, if need be on the calling one
/// alone. What an index throws is thrown on. Built with GEARLASH_THREADS=OFF: on the calling one.
void on_threads(std::size_t threads, std::size_t count,
                const std::function<void(std::size_t)>& work);

}  // namespace gearlash
