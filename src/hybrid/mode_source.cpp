#include "hybrid/mode_source.hpp"

#include <atomic>
#include <mutex>
#include <utility>
#include <vector>

#include "hybrid/hybrid_system.hpp"

namespace gearlash::hybrid {

struct ModeSource::Store {
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const AffineMode> mode;
  };

  Store(std::size_t count, Make made_by) : make(std::move(made_by)), slots(count) {}

  Make make;
  std::vector<Slot> slots;
  std::atomic<std::size_t> made = 0;
};

ModeSource::ModeSource(std::size_t count, Make make)
    : store_(std::make_shared<Store>(count, std::move(make))) {}

std::size_t ModeSource::count() const { return store_ ? store_->slots.size() : 0; }

std::size_t ModeSource::made() const { return store_ ? store_->made.load() : 0; }

const AffineMode& ModeSource::mode(std::size_t index) const {
  Store::Slot& slot = store_->slots[index];
  std::call_once(slot.once, [&] {
    slot.mode = std::make_unique<const AffineMode>(store_->make(index));
    ++store_->made;
  });
  return *slot.mode;
}

}  // namespace gearlash::hybrid
