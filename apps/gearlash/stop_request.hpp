// Ctrl-C and its like, for work that brings what it has to safety before it ends.
#pragma once

#include <array>

namespace gearlash::cli {

/// While one exists, SIGINT, SIGTERM and SIGHUP do not end the program but are noted; those that
/// the program was started to ignore stay ignored. A second signal ends it at once.
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
