// Many servos at once: the answers of analyse_limit_cycles(), whatever the vector unit and
// whichever servos stand beside one another.
#include "closed_form/lanes/cycle_batch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "base/described.hpp"
#include "base/same_bits.hpp"
#include "base/seeded_draws.hpp"
#include "closed_form/growth_at_rest.hpp"
#include "question/map/hunting_boundary.hpp"
#include "question/map/servo_grids.hpp"

namespace gearlash::cycle_batch_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

Table one_by_one(const std::vector<NormalizedServo>& servos) {
  Table table = table_of(servos.size());
  for (std::size_t row = 0; row < servos.size(); ++row) {
    const LimitCycleAnalysis analysis = analyse_limit_cycles(servos[row]);
    const LimitCycle* found = largest_stable(analysis);
    LimitCycle cycle = found != nullptr ? *found : LimitCycle{};
    if (found == nullptr) cycle.amplitude = analysis.irregular_amplitude;
    const std::array values = {analysis.growth_at_rest,     cycle.amplitude,
                               cycle.motor_amplitude,       cycle.period,
                               1.0 / cycle.period,          cycle.multiplier,
                               cycle.impact_speed,          cycle.mesh_torque,
                               cycle.engaged_time,          cycle.separated_time,
                               cycle.energy.motor_friction, cycle.energy.load_friction,
                               cycle.energy.impacts,        cycle.residual};
    table.column_of_verdicts()[row] = analysis.verdict;
    for (std::size_t i = 0; i < values.size(); ++i) {
      table.column(solved_quantities.at(i))[row] = values.at(i);
    }
  }
  return table;
}

/// The largest relative difference that the header states.
double tolerance(Quantity quantity) {
  switch (quantity) {
    case Quantity::growth_at_rest:
    case Quantity::engaged_time:
      return 5e-14;
    case Quantity::motor_friction_loss:
      return 5e-11;
    default:
      return 5e-13;
  }
}

void expect_near(const Table& batch, const Table& single,
                 const std::vector<NormalizedServo>& servos) {
  for (std::size_t row = 0; row < servos.size(); ++row) {
    SCOPED_TRACE(described(servos[row]));
    ASSERT_EQ(batch.verdict(row), single.verdict(row));
    for (const Quantity quantity : solved_quantities) {
      const double value = batch[quantity][row];
      const double reference = single[quantity][row];
      ASSERT_EQ(std::isnan(value), std::isnan(reference)) << name_of(quantity);
      if (std::isnan(value) || value == reference) continue;
      const double scale = quantity == Quantity::residual ? 1.0 : std::abs(reference);
      ASSERT_NEAR(value, reference, tolerance(quantity) * scale) << name_of(quantity);
    }
  }
}

/// Anything at all that has two masses, friction and plastic contact.
NormalizedServo any_servo(SeededDraws& draws) {
  return {.damping = draws.log_uniform(1e-5, 3.0),
          .inertia_ratio = draws.log_uniform(1e-5, 1e5),
          .friction_ratio = draws.uniform(0.0, 1.0),
          .backlash = draws.log_uniform(1e-6, 1e3)};
}

NormalizedServo drive_servo(SeededDraws& draws) {
  return {.damping = draws.uniform(0.05, 0.6),
          .inertia_ratio = draws.log_uniform(1.0 / 9.0, 9.0),
          .friction_ratio = draws.uniform(0.04, 0.99),
          .backlash = 0.3};
}

/// In its flights the motor all but coasts and the load all but comes to rest.
NormalizedServo light_friction_at_the_motor(SeededDraws& draws) {
  return {.damping = draws.log_uniform(1e-3, 0.9),
          .inertia_ratio = draws.log_uniform(1e-3, 10.0),
          .friction_ratio = 1.0 - draws.log_uniform(1e-4, 0.05),
          .backlash = 1.0};
}

/// Growth at rest next to 1: just hunting, or just not.
NormalizedServo borderline_servo(SeededDraws& draws) {
  NormalizedServo servo = drive_servo(draws);
  double hunting = 1e-3;
  double quiet = 0.99;
  for (int halving = 0; halving < 60; ++halving) {
    servo.damping = 0.5 * (hunting + quiet);
    (growth_at_rest(servo_dynamics(servo)) > 1.0 ? hunting : quiet) = servo.damping;
  }
  const double side = draws.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  servo.damping = hunting * (1.0 + side * draws.log_uniform(1e-12, 0.1));
  return servo;
}

template <class Draw>
std::vector<NormalizedServo> drawn(std::size_t count, std::uint64_t seed, const Draw& draw) {
  SeededDraws draws(seed);
  std::vector<NormalizedServo> servos;
  for (std::size_t i = 0; i < count; ++i) servos.push_back(draw(draws));
  return servos;
}

class OracleCycleBatch : public testing::TestWithParam<VectorUnit> {};

TEST_P(OracleCycleBatch, AgreesWithOneByOne) {
  struct Kind {
    NormalizedServo (*draw)(SeededDraws&);
    std::uint64_t seed;
    double least_side_by_side;  // of all: the kernel does the work, not its fallback
  };
  for (const Kind& kind :
       {Kind{any_servo, 801, 0.5}, Kind{drive_servo, 802, 0.99},
        Kind{light_friction_at_the_motor, 804, 0.99}, Kind{borderline_servo, 803, 0.1}}) {
    SCOPED_TRACE(kind.seed);
    const std::vector<NormalizedServo> servos = drawn(10'000, kind.seed, kind.draw);
    Table table = table_of(servos.size());
    const BatchCount count = find_limit_cycles(servos, columns_of(table), GetParam());
    EXPECT_EQ(count.side_by_side + count.one_by_one, servos.size());
    EXPECT_GT(static_cast<double>(count.side_by_side),
              kind.least_side_by_side * static_cast<double>(servos.size()));
    expect_near(table, one_by_one(servos), servos);
  }
}

/// Half the backlash: the motor goes from face to face, however small the load's swing.
TEST(TableLimits, TheMotorsAmplitudeIsHalfTheBacklashWhereHuntingEnds) {
  const auto servo_at = [](double damping) {
    return NormalizedServo{
        .damping = damping, .inertia_ratio = 2.0, .friction_ratio = 0.3, .backlash = 0.2};
  };
  const double end = hunting_end(servo_at, 0.1, 0.9);
  const NormalizedServo servo = servo_at(end * (1.0 - 1e-6));
  Table table = table_of(1);
  find_limit_cycles({&servo, 1}, columns_of(table));
  const auto limit = [&](Quantity quantity) {
    return limit_where_hunting_ends(quantity, servo.backlash).value();
  };
  EXPECT_NEAR(table[Quantity::motor_amplitude][0], limit(Quantity::motor_amplitude), 1e-3);
  EXPECT_NEAR(table[Quantity::multiplier][0], limit(Quantity::multiplier), 0.1);
  EXPECT_NEAR(table[Quantity::amplitude][0], limit(Quantity::amplitude), 0.01);
  EXPECT_NEAR(table[Quantity::impact_loss][0], limit(Quantity::impact_loss), 1e-4);
}

TEST_P(OracleCycleBatch, AnswersDoNotDependOnNeighbours) {
  constexpr std::uint64_t seed = 804;
  SCOPED_TRACE(seed);
  const std::vector<NormalizedServo> servos = drawn(517, seed, any_servo);
  Table together = table_of(servos.size());
  find_limit_cycles(servos, columns_of(together), GetParam());

  std::vector<std::size_t> order(servos.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = 100 * i % order.size();  // 517 is 11·47
  std::vector<NormalizedServo> shuffled;
  for (const std::size_t i : order) shuffled.push_back(servos[i]);
  Table apart = table_of(servos.size());
  find_limit_cycles(shuffled, columns_of(apart), GetParam());
  for (std::size_t row = 0; row < order.size(); ++row) {
    ASSERT_TRUE(same_bits(apart, together, row, order[row])) << described(shuffled[row]);
  }
  for (std::size_t row = 0; row < servos.size(); row += 37) {
    Table alone = table_of(1);
    find_limit_cycles({&servos[row], 1}, columns_of(alone), GetParam());
    ASSERT_TRUE(same_bits(alone, together, 0, row)) << described(servos[row]);
  }
}

TEST_P(OracleCycleBatch, GivesTheBaselinesBits) {
  constexpr std::uint64_t seed = 805;
  SCOPED_TRACE(seed);
  std::vector<NormalizedServo> servos = drawn(5'000, seed, any_servo);
  const std::vector<NormalizedServo> drives = drawn(5'000, seed + 1, drive_servo);
  servos.insert(servos.end(), drives.begin(), drives.end());
  Table wide = table_of(servos.size());
  Table narrow = table_of(servos.size());
  find_limit_cycles(servos, columns_of(wide), GetParam());
  find_limit_cycles(servos, columns_of(narrow), VectorUnit::baseline);
  for (std::size_t row = 0; row < servos.size(); ++row) {
    ASSERT_TRUE(same_bits(wide, narrow, row, row)) << described(servos[row]);
  }
}

INSTANTIATE_TEST_SUITE_P(EachVectorUnit, OracleCycleBatch,
                         testing::ValuesIn(available_vector_units()),
                         [](const testing::TestParamInfo<VectorUnit>& unit) {
                           return std::string(name_of(unit.param));
                         });

TEST(EdgeCycleBatch, ServosOutsideTheKernelAreSolvedOneByOne) {
  const std::vector<NormalizedServo> servos = {
      {.damping = 0.0, .inertia_ratio = 1.0, .friction_ratio = 0.5, .backlash = 0.3},
      {.damping = 1.0, .inertia_ratio = 1.0, .friction_ratio = 0.5, .backlash = 0.3},
      {.damping = 2.0, .inertia_ratio = 9.0, .friction_ratio = 0.5, .backlash = 0.3},
      {.damping = 0.1, .inertia_ratio = 0.0, .friction_ratio = 0.5, .backlash = 0.3},
      {.damping = 0.1, .inertia_ratio = infinity, .friction_ratio = 0.5, .backlash = 0.3},
      {.damping = 0.1, .inertia_ratio = 1e-9, .friction_ratio = 0.5, .backlash = 0.3},
      {.damping = 0.1, .inertia_ratio = 1.0, .friction_ratio = 0.0, .backlash = 0.3},
      {.damping = 0.1, .inertia_ratio = 1.0, .friction_ratio = 1.0, .backlash = 0.3},
      {.damping = 0.1, .inertia_ratio = 1.0, .friction_ratio = 0.5, .backlash = 0.0},
      {.damping = 0.1,
       .inertia_ratio = 1.0,
       .friction_ratio = 0.5,
       .backlash = 0.3,
       .restitution = 0.4}};
  Table table = table_of(servos.size());
  const BatchCount count = find_limit_cycles(servos, columns_of(table));
  EXPECT_EQ(count.side_by_side, 0U);
  EXPECT_EQ(count.one_by_one, servos.size());
  const Table single = one_by_one(servos);
  for (std::size_t row = 0; row < servos.size(); ++row) {
    EXPECT_TRUE(same_bits(table, single, row, row)) << described(servos[row]);
  }
}

TEST(EdgeCycleBatch, NoServosAtAll) {
  Table table = table_of(0);
  const BatchCount count = find_limit_cycles({}, columns_of(table));
  EXPECT_EQ(count.side_by_side + count.one_by_one, 0U);
}

TEST(EdgeCycleBatch, RefusesWhatItCannotDo) {
  std::vector<NormalizedServo> servos(70, {.damping = 0.1, .backlash = 0.3});
  servos[65].damping = not_known;
  servos[65].friction_ratio = 1.5;
  Table table = table_of(servos.size());
  EXPECT_THAT([&] { find_limit_cycles(servos, columns_of(table)); },
              testing::ThrowsMessage<InvalidInput>(
                  testing::AllOf(testing::HasSubstr("servo 65: damping = nan: must be"),
                                 testing::HasSubstr("servo 65: friction_ratio = 1.5: must be"))));
  servos[65] = servos[64];
  CycleColumns columns = columns_of(table);
  columns[Quantity::impact_loss] = columns[Quantity::impact_loss].first(69);
  EXPECT_THAT([&] { find_limit_cycles(servos, columns); },
              testing::ThrowsMessage<std::invalid_argument>(
                  testing::HasSubstr("column impact_loss: 69 rows; must be 70")));
}

/// Version 0.1 crashed: an empty column was taken to have as many rows as the others.
TEST(EdgeCycleBatch, ColumnsMayBeLeftOut) {
  SeededDraws draws(806);
  std::vector<NormalizedServo> servos;
  for (int i = 0; i < 100; ++i) servos.push_back(any_servo(draws));
  Table all = table_of(servos.size());
  find_limit_cycles(servos, columns_of(all));
  for (const Quantity quantity : solved_quantities) {
    std::vector<double> alone(servos.size());
    CycleColumns columns;
    columns[quantity] = alone;
    find_limit_cycles(servos, columns);
    for (std::size_t row = 0; row < servos.size(); ++row) {
      EXPECT_TRUE(alone[row] == all[quantity][row] ||
                  (std::isnan(alone[row]) && std::isnan(all[quantity][row])))
          << name_of(quantity) << " " << row;
    }
  }
  EXPECT_EQ(find_limit_cycles(servos, {}).one_by_one,
            find_limit_cycles(servos, columns_of(all)).one_by_one);
}

TEST(EdgeCycleBatch, UnitsAreNamedFromNarrowToWide) {
  const std::vector<VectorUnit> units = available_vector_units();
  ASSERT_FALSE(units.empty());
  EXPECT_EQ(units.front(), VectorUnit::baseline);
  EXPECT_TRUE(std::is_sorted(units.begin(), units.end()));
  EXPECT_EQ(units.back(), widest_vector_unit());
  EXPECT_STREQ(name_of(units.front()), "baseline");
}

}  // namespace
}  // namespace gearlash::cycle_batch_test
