// The same work for many indices, on a requested number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace gearlash {

/// Calls work(0), …, work(count − 1) in any order, several at a time. 0 threads means as many as
/// the machine has cores. If the system permits fewer, uses those, or the calling thread alone.
/// Rethrows what an index throws. Built with GEARLASH_THREADS=OFF it uses the calling thread.
void on_threads(std::size_t threads, std::size_t count,
                const std::function<void(std::size_t)>& work);

}  // namespace gearlash
