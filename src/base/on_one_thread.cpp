// on_threads() for a platform without threads, such as a browser (GEARLASH_THREADS=OFF).
#include "base/on_threads.hpp"

namespace gearlash {

void on_threads(std::size_t /*threads*/, std::size_t count,
                const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

}  // namespace gearlash
