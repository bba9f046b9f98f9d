// Ctrl-C and similar signals, for work that saves its results before it ends.
#pragma once

#include <array>

namespace gearlash::cli {

/// While one exists, SIGINT, SIGTERM and SIGHUP are noted and do not end the program. Signals that
/// were ignored at the start stay ignored. A second signal ends the program at once.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool is_made() const;
  /// Ends the program as the signal would have.
  [[noreturn]] void obey() const;

 private:
  using Handler = void (*)(int);
  static constexpr std::size_t count = 3;
  std::array<Handler, count> before_{};
};

}  // namespace gearlash::cli
