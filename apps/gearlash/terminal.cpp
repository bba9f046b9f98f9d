#include "terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "output/report_units.hpp"

namespace gearlash::cli {
namespace {

constexpr auto patience = std::chrono::seconds(1);
constexpr auto refresh = std::chrono::milliseconds(100);

/// Whether escape sequences are understood and wanted (no-color.org).
bool takes_escapes(int descriptor) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return isatty(descriptor) == 1 && (no_color == nullptr || *no_color == '\0') &&
         terminal != nullptr && std::string_view(terminal) != "dumb";
}

}  // namespace

std::string with_bold_headline(const std::string& text) {
  if (!takes_escapes(STDOUT_FILENO)) return text;
  const std::size_t end = text.find('\n');
  return "\x1b[1m" + text.substr(0, end) + "\x1b[0m" + text.substr(end);
}

std::string progress_text(double share, double seconds, double things, const std::string& name,
                          double begun) {
  std::string text = fmt::format("{:3.0f} %", 100.0 * share);
  const double worked = share - begun;
  if (!(worked > 0.0 && seconds > 0.0)) return text;
  if (things > 0.0) {
    const double rate = things * worked / seconds;
    text += rate >= 1e6 ? fmt::format(", {} million {}/s", significant(rate / 1e6, 2), name)
                        : fmt::format(", {:.0f} {}/s", rate, name);
  }
  const double left = std::ceil(seconds * (1.0 - share) / worked);
  if (left < 120.0) return text + fmt::format(", {:.0f} s left", left);
  if (left < 7200.0) return text + fmt::format(", {:.0f} min left", std::ceil(left / 60.0));
  return text + fmt::format(", {:.0f} h left", std::ceil(left / 3600.0));
}

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TerminalProgress::TerminalProgress(LimitedWork& work, std::string what, std::size_t count,
                                   std::string name)
    : work_(work),
      what_(std::move(what)),
      count_(count),
      name_(std::move(name)),
      is_watched_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_(start_ + patience) {}

bool TerminalProgress::go_on(double share, std::size_t /*bytes*/) {
  if (!has_begun_) begun_ = share;
  has_begun_ = true;
  if (!work_.go_on()) return false;
  const Clock::time_point now = Clock::now();
  if (!is_watched_ || now < next_) return true;
  next_ = now + refresh;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::string line =
      what_ + ": " + progress_text(share, seconds, static_cast<double>(count_), name_, begun_);
  width_ = std::max(width_, line.size());
  line.resize(width_, ' ');  // covers a longer line before it
  fmt::print(stderr, "\r{}", line);
  std::fflush(stderr);
  return true;
}

TerminalProgress::~TerminalProgress() {
  if (width_ == 0) return;
  // Blanks, because not every terminal understands escape sequences.
  std::fputs(("\r" + std::string(width_, ' ') + "\r").c_str(), stderr);
}

}  // namespace gearlash::cli
