#include "stop_request.hpp"

#include <csignal>
#include <cstddef>
#include <cstdlib>

namespace gearlash::cli {
namespace {

constexpr std::array signals = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t noted_signal = 0;

extern "C" void note_signal(int signal_number) {
  std::signal(signal_number, SIG_DFL);
  noted_signal = signal_number;
}

}  // namespace

StopRequest::StopRequest() {
  static_assert(signals.size() == count);
  noted_signal = 0;
  for (std::size_t i = 0; i < count; ++i) {
    before_[i] = std::signal(signals[i], note_signal);
    if (before_[i] == SIG_IGN) std::signal(signals[i], SIG_IGN);
  }
}

StopRequest::~StopRequest() {
  for (std::size_t i = 0; i < count; ++i) std::signal(signals[i], before_[i]);
}

bool StopRequest::is_made() const { return noted_signal != 0; }

void StopRequest::obey() const {
  const int signal_number = noted_signal;
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number);
  std::abort();  // not reached: the default action of all three ends the program
}

}  // namespace gearlash::cli
