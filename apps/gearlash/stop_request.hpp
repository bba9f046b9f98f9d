// Ctrl-C and similar signals, for work that saves its results before it ends.
#pragma once

namespace gearlash::cli {

/// While one exists, SIGINT, SIGTERM and SIGHUP are noted and do not end the program. Signals that
/// were ignored at the start stay ignored. A second signal has the effect that it had before. There
/// is one at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool is_made() const;
  /// Ends the program as the signal would have.
  [[noreturn]] void obey() const;
};

}  // namespace gearlash::cli
