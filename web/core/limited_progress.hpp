// Progress of one request, with a limit of its time.
#pragma once

#include <limits>

#include "core.hpp"
#include "gearlash/progress.hpp"

namespace gearlash::web {

/// Reports to the page, and stops the work after some seconds.
class LimitedProgress : public Progress {
 public:
  LimitedProgress(const Host& host, double seconds)
      : host_(host), until_(host.seconds() + seconds), next_report_(host.seconds()) {}

  bool go_on(double share, std::size_t) override {
    const double now = host_.seconds();
    if (now >= next_report_) {
      host_.report(share);
      next_report_ = now + seconds_between_reports;
    }
    return now < until_;
  }

 private:
  static constexpr double seconds_between_reports = 0.1;

  const Host& host_;
  double until_;
  double next_report_;
};

}  // namespace gearlash::web
