// The same work for many indices, on a requested number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>
#include <vector>

namespace gearlash {

/// Calls work(0), …, work(count − 1) in any order, several at a time. 0 threads means as many as
/// the machine has cores. If the system permits fewer, uses those, or the calling thread alone.
/// Rethrows what an index throws. Built with GEARLASH_THREADS=OFF it uses the calling thread.
void on_threads(std::size_t threads, std::size_t count,
                const std::function<void(std::size_t)>& work);

/// What `make` gives of each element, in their order.
template <class List, class Make>
auto of_each_on_threads(const List& list, const Make& make) {
  std::vector<std::decay_t<decltype(make(*std::begin(list)))>> all(std::size(list));
  on_threads(0, all.size(), [&](std::size_t i) { all[i] = make(list[i]); });
  return all;
}

}  // namespace gearlash
