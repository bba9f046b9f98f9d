#include "gearlash/io/large_table.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace gearlash {
namespace {

/// For the memory that the column has reserved and not yet touched. An advice: what comes of it
/// does not matter.
void advise_large_pages(std::vector<double>& column) {
#ifdef MADV_HUGEPAGE
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto data = reinterpret_cast<std::uintptr_t>(column.data());
  const std::uintptr_t begin = data / page * page;
  const std::uintptr_t end = data + column.capacity() * sizeof(double);
  static_cast<void>(madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
#else
  static_cast<void>(column);
#endif
}

}  // namespace

CycleTable large_cycle_table(std::size_t rows) {
  CycleTable table;
  table.verdict.assign(rows, Verdict::undecided);
  // All before the first is touched, so that a large page may reach from one column to the next.
  for (std::vector<double>& column : table.values) {
    column.reserve(rows);
    advise_large_pages(column);
  }
  for (std::vector<double>& column : table.values) {
    column.assign(rows, std::numeric_limits<double>::quiet_NaN());
  }
  return table;
}

}  // namespace gearlash
