#include "stop_request.hpp"

#include <array>
#include <csignal>
#include <cstddef>
#include <cstdlib>

namespace gearlash::cli {
namespace {

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

}  // namespace gearlash::cli
