#include "gearlash/progress.hpp"

namespace gearlash {
namespace {

class NoProgress : public Progress {
 public:
  bool go_on(double /*share*/, std::size_t /*bytes*/) override { return true; }
};

}  // namespace

Progress& no_progress() noexcept {
  static NoProgress progress;
  return progress;
}

}  // namespace gearlash
