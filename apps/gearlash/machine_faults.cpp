#include "machine_faults.hpp"

#include <algorithm>
#include <cstdio>
#include <new>
#include <system_error>

#include "output/output_file.hpp"

namespace gearlash::cli {

void report_lines(const std::string& lines) {
  std::size_t start = 0;
  while (start < lines.size()) {
    const std::size_t end = std::min(lines.find('\n', start), lines.size());
    std::fputs(("gearlash: " + lines.substr(start, end - start) + "\n").c_str(), stderr);
    start = end + 1;
  }
}

bool is_within_means(const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const OutputError& error) {
    report_lines(error.what());
  } catch (const std::bad_alloc&) {
    report_lines("not enough memory");
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::resource_unavailable_try_again) throw;
    report_lines("no thread or process could be started: " + error.code().message());
  }
  return false;
}

}  // namespace gearlash::cli
