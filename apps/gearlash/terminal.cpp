#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace gearlash::cli {
namespace {

constexpr auto patience = std::chrono::seconds(1);
constexpr auto refresh = std::chrono::milliseconds(100);

/// Escape sequences are understood, and not unwanted (no-color.org).
bool takes_escapes(int descriptor) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return isatty(descriptor) == 1 && (no_color == nullptr || *no_color == '\0') &&
         terminal != nullptr && std::string_view(terminal) != "dumb";
}

}  // namespace

std::string emphasized(const std::string& text) {
  return takes_escapes(STDOUT_FILENO) ? "\x1b[1m" + text + "\x1b[0m" : text;
}

Progress::Progress(std::string what)
    : what_(std::move(what)),
      is_watched_(isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + patience) {}

void Progress::show(double share) {
  if (!is_watched_ || Clock::now() < next_) return;
  is_shown_ = true;
  next_ = Clock::now() + refresh;
  fmt::print(stderr, "\r{}: {:3.0f} %", what_, 100.0 * share);
  std::fflush(stderr);
}

Progress::~Progress() {
  if (!is_shown_) return;
  // Blanks instead of an escape sequence: understood by every terminal.
  std::fputs(("\r" + std::string(what_.size() + 8, ' ') + "\r").c_str(), stderr);
}

}  // namespace gearlash::cli
