// What a program calls thousands of times a second allocates nothing. This program counts its own
// allocations: those of `new`, which it replaces, and those of malloc, which the linker leads here
// (--wrap=malloc; Eigen's).
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "gearlash/motion.hpp"
#include "general/assemble/drive_system.hpp"
#include "hybrid/hybrid_trajectory.hpp"
#include "model/reduced_drive.hpp"

namespace {

std::atomic<std::size_t> allocations{0};

}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);   // NOLINT: the linker's name
void* __wrap_malloc(std::size_t size) {  // NOLINT: the linker's name
  ++allocations;
  return __real_malloc(size);
}
}

void* operator new(std::size_t size) {
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace gearlash::motion_allocation_test {
namespace {

Drive geared_drive() {
  Drive drive = normal_form(0.19, 2.0, 0.1, 0.3);
  drive.reference = 1.0;
  return drive;
}

std::size_t allocations_of_samples(const Motion& motion) {
  double sum = motion.at(0.5 * motion.end_time()).motor_torque;  // the thread's first call
  const std::size_t before = allocations;
  for (int i = 0; i <= 1000; ++i) sum += motion.at(i * 0.001 * motion.end_time()).motor_torque;
  EXPECT_NE(sum, 0.0);
  return allocations - before;
}

TEST(Allocation, IsCounted) {
  const std::size_t before = allocations;
  const Motion motion = simulate(geared_drive(), {.until = 1.0});
  EXPECT_GT(allocations, before);
}

TEST(Allocation, IsNotMadeByAMotionOfTheClosedForm) {
  const Motion motion = simulate(geared_drive(), {.until = 10.0});
  ASSERT_EQ(motion.engine(), Engine::closed_form);
  EXPECT_EQ(allocations_of_samples(motion), 0U);
}

TEST(Allocation, IsNotMadeByAMotionOfTheGeneralEngine) {
  Drive drive = geared_drive();
  drive.sampling = Sampling{.period = 0.01};
  drive.contact = CompliantContact{.stiffness = 1e4, .damping = 1e3};  // with fast decays
  const Motion motion = simulate(drive, {.until = 10.0});
  ASSERT_EQ(motion.engine(), Engine::general);
  EXPECT_EQ(allocations_of_samples(motion), 0U);
}

/// Forgets what it receives.
struct Forgotten : hybrid::MotionObserver {
  std::size_t pieces = 0;
  void moved(double /*from*/, double /*to*/, const hybrid::Vector& /*before*/,
             const hybrid::Vector& /*after*/) override {
    ++pieces;
  }
};

/// A search observes some 1e5 ticks a start: what a motion needs does not grow with them.
TEST(Allocation, IsNotMadeByTheTicksOfAMotionThatIsObserved) {
  constexpr double period = 0.01;
  Drive drive = geared_drive();
  drive.sampling = Sampling{.period = period, .delay = 0.4 * period};
  const drive::ReducedDrive reduced = reduce(drive);
  const drive::DriveSystem built = drive_system(reduced);
  const hybrid::PreparedSystem system(built.system);
  const hybrid::State start = drive_start(reduced, built, {});
  const auto allocations_of_ticks = [&](std::size_t count) {
    Forgotten observer;
    const std::size_t before = allocations;
    const hybrid::Observed seen =
        observe(system, start, {.until = (static_cast<double>(count) + 0.5) * period}, observer);
    const std::size_t made = allocations - before;
    EXPECT_GT(seen.events, count / 4);  // rounds of ticks are jumped
    EXPECT_GT(observer.pieces, count / 4);
    return made;
  };
  allocations_of_ticks(40'000);  // enters all modes
  EXPECT_EQ(allocations_of_ticks(40'000), allocations_of_ticks(20'000));
}

/// Shafts that a spring joins swing without an event until the next tick, which may be years away.
TEST(Allocation, IsNotMadeByTheStepsOfALongFlightThatIsObserved) {
  Drive drive;
  drive.motor = {.kind = TorqueControl{}, .inertia = 1.0};
  drive.load = {.inertia = 1.0, .friction = {.viscous = 1e-6}};
  drive.gearbox = {.ratio = 1.0, .backlash = 0.0};
  drive.contact = CompliantContact{.stiffness = 1.0};
  drive.controller.law = PID{.proportional = 1.0};
  drive.sampling = Sampling{.period = 1e8};
  const drive::ReducedDrive reduced = reduce(drive);
  const drive::DriveSystem built = drive_system(reduced);
  const hybrid::PreparedSystem system(built.system);
  const hybrid::State start = drive_start(reduced, built, {.motor_position = 1.0});
  const auto allocations_until = [&](double until) {
    Forgotten observer;
    const std::size_t before = allocations;
    observe(system, start, {.until = until}, observer);
    EXPECT_GT(static_cast<double>(observer.pieces), 0.1 * until);
    return allocations - before;
  };
  allocations_until(40'000.0);  // the thread's first call
  EXPECT_EQ(allocations_until(40'000.0), allocations_until(20'000.0));
}

}  // namespace
}  // namespace gearlash::motion_allocation_test
