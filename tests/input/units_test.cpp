// Quantities with units: every spelling against a factor written out independently of UDUNITS-2.
#include "gearlash/units.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "question/faults_of.hpp"

namespace gearlash::units_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double inch = 0.0254;
constexpr double foot = 0.3048;
constexpr double pound = 0.45359237;
constexpr double gravity = 9.80665;
constexpr double ounce = pound / 16;
constexpr double pound_force = pound * gravity;
constexpr double ounce_force = pound_force / 16;
constexpr double slug = pound_force / foot;
constexpr double rpm = 2 * pi / 60;
constexpr double degree = pi / 180;

// A factor is a product of at most six rounded ones, each within half an epsilon, on either side.
constexpr double tolerance = 8 * std::numeric_limits<double>::epsilon();

struct Spelling {
  const char* text;
  Dimension dimension;
  double si;
};

std::string refusal(const std::string& text, const Dimension& dimension) {
  try {
    const double value = to_si("key", text, dimension);
    return "accepted as " + std::to_string(value);
  } catch (const InvalidInput& problem) {
    EXPECT_EQ(problem.faults().size(), 1U);
    return problem.what();
  }
}

class UnitSpelling : public ::testing::TestWithParam<Spelling> {};

TEST_P(UnitSpelling, ConvertsByItsFactor) {
  const Spelling& spelling = GetParam();
  const double si = to_si("key", spelling.text, spelling.dimension);
  EXPECT_NEAR(si, spelling.si, tolerance * std::abs(spelling.si)) << spelling.text;
}

using namespace dimensions;

INSTANTIATE_TEST_SUITE_P(
    Inertia, UnitSpelling,
    ::testing::Values(Spelling{"0.61 oz in2", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"0.61 oz-in2", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"0.61 oz in^2", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"0.61 oz*in^2", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"0.61 oz*in**2", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"0.61 oz·in²", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"0.61oz.in2", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"0.61 ozin2", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"0.61 ounce-inches^2", inertia, 0.61 * ounce* inch* inch},
                      Spelling{"2 lb in2", inertia, 2 * pound* inch* inch},
                      Spelling{"2 lbm ft2", inertia, 2 * pound* foot* foot},
                      Spelling{"2 lbs ft2", inertia, 2 * pound* foot* foot},
                      Spelling{"16.4e-6 slug ft2", inertia, 16.4e-6 * slug* foot* foot},
                      Spelling{"1 ozf in s2", inertia, ounce_force* inch},
                      Spelling{"1 lbf-ft-sec^2", inertia, pound_force* foot},
                      Spelling{"1 N m s2", inertia, 1.0}, Spelling{"3 g cm2", inertia, 3e-7},
                      Spelling{"3 gcm2", inertia, 3e-7}, Spelling{"3 gcm²", inertia, 3e-7},
                      Spelling{"3 g.cm^2", inertia, 3e-7}, Spelling{"3 kgcm2", inertia, 3e-4},
                      Spelling{"3 kgm2", inertia, 3.0}, Spelling{"3 gmm2", inertia, 3e-9},
                      Spelling{"3 kg m2", inertia, 3.0},
                      Spelling{"3 kg\u00A0m\u00B2", inertia, 3.0},
                      Spelling{"-3 kg m2", inertia, -3.0}));

INSTANTIATE_TEST_SUITE_P(
    TorquePerCurrent, UnitSpelling,
    ::testing::Values(
        Spelling{"28.2 ozf in/A", torque_per_current, 28.2 * ounce_force* inch},
        Spelling{"28.2 ozf-in/amp", torque_per_current, 28.2 * ounce_force* inch},
        Spelling{"28.2 ozfin/A", torque_per_current, 28.2 * ounce_force* inch},
        Spelling{"28.2 inch ounce_force per ampere", torque_per_current, 28.2 * ounce_force* inch},
        Spelling{"2 in-lbf/A", torque_per_current, 2 * pound_force* inch},
        Spelling{"2 lbf ft/A", torque_per_current, 2 * pound_force* foot},
        Spelling{"2 ftlbf/A", torque_per_current, 2 * pound_force* foot},
        Spelling{"100 gf cm/A", torque_per_current, 0.1 * gravity * 0.01},
        Spelling{"100 gfcm/A", torque_per_current, 0.1 * gravity * 0.01},
        Spelling{"1 kgf cm/A", torque_per_current, gravity * 0.01},
        Spelling{"1 kp cm/A", torque_per_current, gravity * 0.01},
        Spelling{"1 kgfm/A", torque_per_current, gravity},
        Spelling{"3 dyn cm/A", torque_per_current, 3e-7},
        Spelling{"3 N m/A", torque_per_current, 3.0}, Spelling{"3 N·m/A", torque_per_current, 3.0},
        Spelling{"3 N\u22C5m\u22C5A\u207B\u00B9", torque_per_current, 3.0},
        Spelling{"3 N-m/A", torque_per_current, 3.0}, Spelling{"3 Nm/A", torque_per_current, 3.0},
        Spelling{"3 mN m/A", torque_per_current, 3e-3},
        Spelling{"3 mNm/A", torque_per_current, 3e-3},
        Spelling{"3 µNm/A", torque_per_current, 3e-6},
        Spelling{"3 uNm/A", torque_per_current, 3e-6},
        Spelling{"3 Ncm/A", torque_per_current, 3e-2},
        Spelling{"3 cNm/A", torque_per_current, 3e-2},
        Spelling{"3 Nmm/A", torque_per_current, 3e-3},
        Spelling{"3 Nm/mA", torque_per_current, 3e3}));

INSTANTIATE_TEST_SUITE_P(
    TorquePerSpeed, UnitSpelling,
    ::testing::Values(
        Spelling{"0.00064 ozf in/(rad/s)", torque_per_speed, 0.00064 * ounce_force* inch},
        Spelling{"0.00064 ozf in s/rad", torque_per_speed, 0.00064 * ounce_force* inch},
        Spelling{"0.00064 ozf in s", torque_per_speed, 0.00064 * ounce_force* inch},
        Spelling{"2 ozf in/krpm", torque_per_speed, 2 * ounce_force* inch / (1000 * rpm)},
        Spelling{"2 ozf in/(1000 rpm)", torque_per_speed, 2 * ounce_force* inch / (1000 * rpm)},
        Spelling{"2 mN m/rpm", torque_per_speed, 2e-3 / rpm},
        Spelling{"2 Nms", torque_per_speed, 2.0}, Spelling{"2 mNms/rad", torque_per_speed, 2e-3},
        Spelling{"2 N m/(deg/s)", torque_per_speed, 2 / degree},
        Spelling{"0 N m s", torque_per_speed, 0.0}));

INSTANTIATE_TEST_SUITE_P(
    VoltagePerSpeed, UnitSpelling,
    ::testing::Values(Spelling{"0.233 V s/rad", voltage_per_speed, 0.233},
                      Spelling{"0.233 V/(rad/s)", voltage_per_speed, 0.233},
                      Spelling{"0.233 volts/(radian/second)", voltage_per_speed, 0.233},
                      Spelling{"0.233 Vs/rad", voltage_per_speed, 0.233},
                      Spelling{"0.233 V s", voltage_per_speed, 0.233},
                      Spelling{"24 V/krpm", voltage_per_speed, 24 / (1000 * rpm)},
                      Spelling{"24 V/kRPM", voltage_per_speed, 24 / (1000 * rpm)},
                      Spelling{"24 mV/rpm", voltage_per_speed, 0.024 / rpm},
                      Spelling{"24 mV/(rev/min)", voltage_per_speed, 0.024 / rpm},
                      Spelling{"24 V/Hz", voltage_per_speed, 24 / (2 * pi)},
                      Spelling{"24 N m/A", voltage_per_speed, 24.0}));

INSTANTIATE_TEST_SUITE_P(
    AngleAndFrequency, UnitSpelling,
    ::testing::Values(
        Spelling{"0.1 rad", angle, 0.1}, Spelling{"5 mrad", angle, 5e-3},
        Spelling{"12 arcmin", angle, 12 * degree / 60}, Spelling{"12'", angle, 12 * degree / 60},
        Spelling{"12 \u2032", angle, 12 * degree / 60},
        Spelling{"12 arcsec", angle, 12 * degree / 3600},
        Spelling{"12\"", angle, 12 * degree / 3600}, Spelling{"3 deg", angle, 3 * degree},
        Spelling{"3 degrees", angle, 3 * degree}, Spelling{"3°", angle, 3 * degree},
        Spelling{"0.25 rev", angle, pi / 2}, Spelling{"0.25 turn", angle, pi / 2},
        Spelling{"14.5 rad/s", angular_frequency, 14.5},
        Spelling{"2 Hz", angular_frequency, 4 * pi}, Spelling{"2 hertz", angular_frequency, 4 * pi},
        Spelling{"2 kHz", angular_frequency, 4e3 * pi},
        Spelling{"2 rev/s", angular_frequency, 4 * pi},
        Spelling{"2 rps", angular_frequency, 4 * pi},
        Spelling{"4000 rpm", angular_frequency, 4000 * rpm},
        Spelling{"4 krpm", angular_frequency, 4000 * rpm},
        Spelling{"30 deg/s", angular_frequency, 30 * degree}));

INSTANTIATE_TEST_SUITE_P(
    Electrical, UnitSpelling,
    ::testing::Values(Spelling{"282 ohm", resistance, 282}, Spelling{"282 ohms", resistance, 282},
                      Spelling{"282 \u03A9", resistance, 282},
                      Spelling{"282 \u2126", resistance, 282},
                      Spelling{"1.2 k\u03A9", resistance, 1200},
                      Spelling{"1.2 kohm", resistance, 1200}, Spelling{"3 V/A", resistance, 3},
                      Spelling{"10 V/rad", voltage_per_angle, 10},
                      Spelling{"10 V/deg", voltage_per_angle, 10 / degree},
                      Spelling{"10 mV/arcmin", voltage_per_angle, 0.6 / degree},
                      Spelling{"10 V/rev", voltage_per_angle, 10 / (2 * pi)},
                      Spelling{"2 N m/V", torque_per_voltage, 2},
                      Spelling{"2 ozf in/V", torque_per_voltage, 2 * ounce_force* inch}));

INSTANTIATE_TEST_SUITE_P(
    OtherAliases, UnitSpelling,
    ::testing::Values(Spelling{"1 inoz in", inertia, ounce* inch* inch},
                      Spelling{"1 ounces in2", inertia, ounce* inch* inch},
                      Spelling{"1 lbin in", inertia, pound* inch* inch},
                      Spelling{"1 inlb in", inertia, pound* inch* inch},
                      Spelling{"1 lbft ft", inertia, pound* foot* foot},
                      Spelling{"1 ftlb ft", inertia, pound* foot* foot},
                      Spelling{"2 slugs ft2", inertia, 2 * slug* foot* foot},
                      Spelling{"1 inozf/A", torque_per_current, ounce_force* inch},
                      Spelling{"1 ounces_force in/A", torque_per_current, ounce_force* inch},
                      Spelling{"1 force_ounce in/A", torque_per_current, ounce_force* inch},
                      Spelling{"1 lbfin/A", torque_per_current, pound_force* inch},
                      Spelling{"1 inlbf/A", torque_per_current, pound_force* inch},
                      Spelling{"1 lbfft/A", torque_per_current, pound_force* foot},
                      Spelling{"2 degs", angle, 2 * degree}, Spelling{"2 revs", angle, 4 * pi},
                      Spelling{"2 cycles", angle, 4 * pi},
                      Spelling{"2 \u2033", angle, 2 * degree / 3600},
                      Spelling{"2 RPM", angular_frequency, 2 * rpm}));

TEST(Units, NumberIsDecimalWithAPoint) {
  for (const char* number : {"1", "+1", "1.", "1.0", "01", "1e0", "1E+0", "10e-1", ".1e1"}) {
    EXPECT_EQ(to_si("key", std::string(number) + " rad", angle), 1.0) << number;
  }
  EXPECT_EQ(to_si("key", "0.1 rad", angle), 0.1);
  EXPECT_EQ(to_si("key", "1.7976931348623157e308 rad", angle), 1.7976931348623157e308);
  EXPECT_FALSE(std::signbit(to_si("key", "-0.0 rad", angle)));
}

TEST(Units, RefusesWhatIsNoNumber) {
  for (const char* text : {"rad", "", " ", "nan rad", "inf rad", "- 1 rad", "1,5 rad", "0x10 rad",
                           "1_000 rad", "--1 rad", ". rad", "e5 rad", "1/2 rad", "1"}) {
    EXPECT_TRUE(refusal(text, angle).starts_with("key = ")) << text;
  }
  EXPECT_EQ(refusal("1e999 rad", angle),
            "key = 1e999 rad: must be a number from 1e-308 to 1e308 in SI units, or zero");
  EXPECT_EQ(refusal("1e-999 rad", angle),
            "key = 1e-999 rad: must be a number from 1e-308 to 1e308 in SI units, or zero");
  EXPECT_EQ(refusal("1,5 rad", angle),
            "key = 1,5 rad: must be an angle, such as 12 arcmin; the decimal sign is a point");
}

TEST(Units, RefusesAnotherDimensionAndSaysWhatItExpects) {
  EXPECT_EQ(refusal("3 V", torque_per_current),
            "key = 3 V: must be a torque per current, such as 0.35 N m/A");
  EXPECT_EQ(
      refusal("28.2 oz in/A", torque_per_current),
      "key = 28.2 oz in/A: must be a torque per current, such as 0.35 N m/A; oz, lb, g and kg are "
      "masses, the forces are ozf, lbf, gf and kgf");
  EXPECT_EQ(refusal("1 A/(rad/s)", torque_per_angle),
            "key = 1 A/(rad/s): must be a torque per angle, such as 20 N m/rad");
  EXPECT_EQ(
      refusal("0.233 V/rad/s", voltage_per_speed),
      "key = 0.233 V/rad/s: must be a voltage per angular speed, such as 3.67 mV/rpm; x/rad/s is "
      "x/(rad s), write x/(rad/s)");
  EXPECT_EQ(
      refusal("1 oz-in-s2", inertia),
      "key = 1 oz-in-s2: must be a moment of inertia, such as 0.3 kg cm2; oz, lb, g and kg are "
      "masses, the forces are ozf, lbf, gf and kgf");
}

TEST(Units, AnswersTheCommonMistakes) {
  EXPECT_EQ(refusal("12 minutes", angle),
            "key = 12 minutes: must be an angle, such as 12 arcmin; minutes and seconds of arc are "
            "arcmin "
            "and arcsec");
  EXPECT_EQ(refusal("0.5 mil", angle),
            "key = 0.5 mil: must be an angle, such as 12 arcmin; this is a length, milliradians "
            "are mrad");
  EXPECT_EQ(refusal("1\u00B030'", angle),
            "key = 1\u00B030': must be an angle, such as 12 arcmin; an angle takes one unit: "
            "1.5\u00B0 or "
            "90'");
  for (const char* text : {"5 V/1000 rpm", "5 V per 1000 rpm"}) {
    EXPECT_EQ(
        refusal(text, voltage_per_speed),
        "key = " + std::string(text) +
            ": must be a voltage per angular speed, such as 3.67 mV/rpm; x/1000 rpm is (x/1000) "
            "rpm, write x/(1000 rpm)");
  }
}

TEST(Units, MinutesOfArcInTheirSpellings) {
  for (const char* text : {"30 arcmin", "30 arc-min", "30 arc min", "30 arc-minutes", "30 MOA",
                           "30'", "30 arcminutes", "1800 arc-sec"}) {
    EXPECT_NEAR(to_si("key", text, angle), 0.5 * degree, degree * tolerance) << text;
  }
  EXPECT_NEAR(to_si("key", "100 gon", angle), 90.0 * degree, 90.0 * degree * tolerance);
}

TEST(Units, NeverConvertsByReciprocalOffsetOrLogarithm) {
  for (const char* text : {"10 rad/V", "1 S", "1 degC", "1 K", "1 dB", "1 mol", "1 K/K"}) {
    EXPECT_TRUE(refusal(text, voltage_per_angle).starts_with("key = ")) << text;
    EXPECT_TRUE(refusal(text, resistance).starts_with("key = ")) << text;
  }
  EXPECT_TRUE(refusal("1 rad K/K", angle).starts_with("key = "));
  EXPECT_TRUE(refusal("1 rad degC/degC", angle).starts_with("key = "));
}

TEST(Units, RadianIsWrittenWhereItTellsSpeedsFromFrequencies) {
  EXPECT_EQ(refusal("10 V", voltage_per_angle),
            "key = 10 V: must be a voltage per angle, such as 10 V/rad; the angle must be written");
  EXPECT_EQ(refusal("2 s-1", angular_frequency),
            "key = 2 s-1: must be an angular frequency, such as 20 Hz; the angle must be written");
  EXPECT_EQ(
      refusal("1 kg m2 rad", inertia),
      "key = 1 kg m2 rad: must be a moment of inertia, such as 0.3 kg cm2; it contains no angle");
  EXPECT_TRUE(refusal("0.1 m/m", angle).starts_with("key = "));
  EXPECT_TRUE(refusal("1 N m s rad", torque_per_speed).starts_with("key = "));
  EXPECT_TRUE(refusal("1 rad2", angle).starts_with("key = "));
}

TEST(Units, PerMinuteWithoutAngleIsAmbiguous) {
  EXPECT_EQ(
      refusal("24 mV/min-1", voltage_per_speed),
      "key = 24 mV/min-1: must be a voltage per angular speed, such as 3.67 mV/rpm; per minute may "
      "mean rad or turns, write rpm, rev/min or rad/min");
  EXPECT_NEAR(to_si("key", "1 V min/rad", voltage_per_speed), 60.0, 60 * tolerance);
}

TEST(Units, NamesTheWordOrSignItCannotRead) {
  const std::string expected = "must be a moment of inertia, such as 0.3 kg cm2; ";
  EXPECT_EQ(refusal("1 furlongg", inertia),
            "key = 1 furlongg: " + expected + "\"furlongg\" is no known unit");
  // Grain to UDUNITS-2, gram to others.
  EXPECT_EQ(refusal("1 gr cm2", inertia),
            "key = 1 gr cm2: " + expected + "\"gr\" is no known unit");
  EXPECT_EQ(refusal("1 (kg m2", inertia), "key = 1 (kg m2: " + expected + "a \"(\" has no \")\"");
  EXPECT_EQ(refusal("1 kg m2)", inertia), "key = 1 kg m2): " + expected + "a \")\" has no \"(\"");
  EXPECT_EQ(refusal("1 kg m^", inertia),
            "key = 1 kg m^: " + expected + "\"^\" needs a whole number after it");
  EXPECT_EQ(refusal("1 kg m22", inertia), "key = 1 kg m22: " + expected + "powers go from -9 to 9");
  EXPECT_EQ(refusal("1 kg @ 3", inertia),
            "key = 1 kg @ 3: " + expected + "there is no unit at \"@ 3\"");
  EXPECT_EQ(refusal("1 2 kg m2", inertia),
            "key = 1 2 kg m2: " + expected +
                "within a unit a number may only be a power, a divisor or after *: V/(1000 rpm)");
  EXPECT_TRUE(refusal("1 s since 1970", inertia).starts_with("key = "));
  EXPECT_TRUE(refusal("1 lb(re 1 mW)", inertia).starts_with("key = "));
  EXPECT_TRUE(refusal("1 \xFF", inertia).starts_with("key = 1 \\xff: "));
  EXPECT_TRUE(refusal("1 " + std::string(1000, '('), inertia).size() < 300);
  EXPECT_TRUE(refusal("1 kg m2/0", inertia).starts_with("key = "));
  EXPECT_TRUE(refusal("1 kg m2/(1e999)", inertia).starts_with("key = "));
}

TEST(Units, MultipliesNumbersWithUnits) {
  const auto torque = [](const char* text) { return to_si("key", text, dimensions::torque); };
  EXPECT_NEAR(torque("0.5 kg * 9.81 m/s2 * 0.15 m"), 0.5 * 9.81 * 0.15, 1e-15);
  EXPECT_NEAR(torque("500 g × 9.81 m/s² × 150 mm"), 0.5 * 9.81 * 0.15, 1e-15);
  EXPECT_NEAR(to_si("key", "0.5 kg * (0.15 m)^2", inertia), 0.5 * 0.15 * 0.15, 1e-17);
  EXPECT_TRUE(refusal("0.5 kg * 9.81 m/s2", dimensions::torque).starts_with("key = "));
  EXPECT_TRUE(refusal("0.5 kg * 0 m2", inertia).ends_with("must be positive and finite"));
}

TEST(Units, QuantityKeepsTheUnitAsWritten) {
  const Measured quantity = read_quantity("key", " 12  arcmin ", angle);
  EXPECT_EQ(quantity.unit, "arcmin");
  EXPECT_NEAR(quantity.unit_in_si, degree / 60, tolerance);
  EXPECT_EQ(quantity.si, 12 * quantity.unit_in_si);
}

TEST(Units, NumbersWithoutUnit) {
  EXPECT_EQ(read_number("key", "0.25"), 0.25);
  EXPECT_EQ(read_number("key", "1/9"), 1.0 / 9.0);
  EXPECT_EQ(read_number("key", " 4 / 1 "), 4.0);
  EXPECT_EQ(read_number("key", "inf"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(test::faults_of([] { read_number("key", "2/0"); }),
            std::vector<std::string>{"key = 2/0: must not be divided by 0"});
  for (const char* text :
       {"", "nan", "-inf", "infinity", "1/0", "0/0", "1/2/3", "/2", "1e999", "0x1", "1 m", "5%"}) {
    EXPECT_THROW(read_number("key", text), InvalidInput) << text;
  }
}

TEST(Units, ShownTextFitsOneLine) {
  EXPECT_EQ(shown("a\nb\x07\x7F"), "a\\nb\\x07\\x7f");
  EXPECT_EQ(shown("\xC2\x85\xE2\x80\xAE\xFF"), "\\u0085\\u202e\\xff");
  EXPECT_EQ(shown(""), "\"\"");
  EXPECT_EQ(shown("12 Ω"), "12 Ω");
  EXPECT_EQ(shown(std::string(61, 'x')), std::string(60, 'x') + "…");
  EXPECT_EQ(shown(std::string(60, 'x')), std::string(60, 'x'));
}

TEST(Units, ManyThreadsReadAtOnce) {
  std::vector<std::thread> threads;
  std::vector<double> results(8);
  for (double& result : results) {
    threads.emplace_back([&result] {
      for (int i = 0; i < 200; ++i) result += to_si("key", "1 ozf in/A", torque_per_current);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const double result : results) EXPECT_EQ(result, results[0]);
}

/// Run in a process of its own, whose locale is nobody else's.
int read_under_comma_locale() {
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    const double torque = to_si("key", "28.2 ozf in/A", dimensions::torque_per_current);
    const bool kept = std::string(std::setlocale(LC_ALL, nullptr)) == name;
    const bool right = std::abs(torque - 28.2 * ounce_force * inch) < tolerance &&
                       std::strtod("1,5", nullptr) > 1.2;
    return right && kept ? 0 : 1;
  }
  return 77;
}

TEST(UnitsDeathTest, LocaleWithDecimalCommaChangesNothing) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) {
    GTEST_SKIP() << "this machine has no locale de_DE.UTF-8";
  }
  std::setlocale(LC_ALL, "C");
  EXPECT_EXIT(std::exit(read_under_comma_locale()), ::testing::ExitedWithCode(0), "");
}

TEST(Units, RatesAreReciprocals) {
  EXPECT_DOUBLE_EQ(to_si("gain", "20 1/s", dimensions::rate), 20.0);
  EXPECT_DOUBLE_EQ(to_si("gain", "20 s^-1", dimensions::rate), 20.0);
  EXPECT_DOUBLE_EQ(to_si("gain", "0.02 1/ms", dimensions::rate), 20.0);
  EXPECT_THROW(to_si("gain", "20 2/s", dimensions::rate), InvalidInput);
  EXPECT_THROW(to_si("gain", "20 1", dimensions::rate), InvalidInput);
  EXPECT_THROW(to_si("speed", "20 1/s", dimensions::angular_speed), InvalidInput);
}

}  // namespace
}  // namespace gearlash::units_test
