#include "work.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <utility>

#include "gearlash/analyse.hpp"
#include "gearlash/output.hpp"
#include "gearlash/units.hpp"

namespace gearlash::cli {
namespace {

// ---- signals ------------------------------------------------------------------------------------

constexpr std::array signals = {SIGINT, SIGTERM, SIGHUP};

using Handler = void (*)(int);
std::array<Handler, signals.size()> before{};  // of each signal

volatile std::sig_atomic_t noted_signal = 0;

void restore(int signal_number) {
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (signals[i] == signal_number) std::signal(signal_number, before[i]);
  }
}

extern "C" void note_signal(int signal_number) {
  restore(signal_number);
  noted_signal = signal_number;
}

}  // namespace

StopRequest::StopRequest() {
  noted_signal = 0;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    before[i] = std::signal(signals[i], note_signal);
    if (before[i] == SIG_IGN) std::signal(signals[i], SIG_IGN);
  }
}

StopRequest::~StopRequest() {
  for (const int signal_number : signals) restore(signal_number);
}

bool StopRequest::is_made() const { return noted_signal != 0; }

void StopRequest::obey() const {
  restore(noted_signal);
  std::raise(noted_signal);
  std::abort();  // not reached: each of the signals ends the program
}

// ---- limits -------------------------------------------------------------------------------------

namespace {

/// The most bytes of memory that the tool has taken so far. (getrusage() would count those of the
/// program that started it.) 0 where the system does not say.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  const std::string peak = "VmHWM:";
  constexpr double bytes_in_unit = 1024.0;
  for (std::string word; status >> word;) {
    double units = 0.0;
    if (word == peak && status >> units) return bytes_in_unit * units;
  }
  return 0.0;
}

}  // namespace

std::size_t bytes_of_motion(const Limits& limits, std::size_t searches) {
  constexpr double tool_bytes = 30e6;  // the tool itself
  // A third for a motion, what is made of it included.
  const double share = (limits.bytes - tool_bytes) / (3.0 * static_cast<double>(searches));
  const std::size_t usual = Wanted{}.motion_bytes;
  return share < static_cast<double>(usual) ? static_cast<std::size_t>(share) : usual;
}

LimitedWork::LimitedWork(const Limits& limits) : limits_(limits), request_(std::in_place) {
  constexpr double longest = 1e9;  // s; more would overflow the clock
  deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(std::min(limits.seconds, longest)));
}

bool LimitedWork::go_on() {
  if (is_stopped()) return false;
  const Clock::time_point now = Clock::now();
  if (is_interrupted()) {
    why_ = "a signal";
  } else if (now >= deadline_) {
    why_ = "--time-limit";
  } else if (limits_.bytes < no_limit && now >= next_look_) {
    constexpr auto between_looks = std::chrono::milliseconds(10);  // each reads a file
    next_look_ = now + between_looks;
    if (peak_memory() > limits_.bytes) why_ = "--memory-limit";
  }
  return !is_stopped();
}

void LimitedWork::end() {
  if (is_interrupted()) request_->obey();
  request_.reset();
}

// ---- the terminal -------------------------------------------------------------------------------

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

std::optional<std::size_t> columns_of_output() {
  constexpr std::size_t least = 40;
  constexpr std::size_t most = 160;
  std::size_t columns = 0;
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0) columns = window.ws_col;
  const char* variable = std::getenv("COLUMNS");
  if (columns == 0 && variable != nullptr) columns = std::strtoul(variable, nullptr, 10);
  return columns > 0 ? std::optional(std::clamp(columns, least, most)) : std::nullopt;
}

std::string fitted_to_output(const std::string& text) {
  const std::optional<std::size_t> columns = columns_of_output();
  return columns ? fitted(text, *columns) : text;
}

std::string with_bold_headline(const std::string& text) {
  if (!takes_escapes(STDOUT_FILENO)) return fitted_to_output(text);
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string headline = fitted_to_output(text.substr(0, end));
  if (headline.ends_with('\n')) headline.pop_back();
  return "\x1b[1m" + headline + "\x1b[0m" + text.substr(end, 1) +
         fitted_to_output(text.substr(std::min(end + 1, text.size())));
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
