// A decimal that no double's shortest text is stays known as such, however it comes in.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gearlash/input.hpp"
#include "gearlash/parameter.hpp"
#include "input/parameter_text.hpp"
#include "model/proportional_servo.hpp"
#include "model/reduced_drive.hpp"

namespace gearlash::long_decimal_test {
namespace {

std::string servo_with(const std::string& damping) {
  return "[servo]\ndamping = " + damping +
         "\ninertia_ratio = 2\nfriction_ratio = 0.1\nbacklash = '0.3 rad'\n";
}

std::string sheet_with(const std::string& direct, const std::string& ratio = "43") {
  return "[motor]\nkind = 'torque-controlled'\ninertia = '2 g cm2'\nfriction = '1e-6 N m "
         "s/rad'\n[gearbox]\nratio = " +
         ratio +
         "\nbacklash = '2 mrad'\n[load]\ninertia = '0.01 kg m2'\nfriction = '0.1 N m s/rad'\n"
         "[controller]\nkind = 'state-space'\ngain = '1 N m/rad'\nA = [[-100]]\n"
         "B = [[1, -1, 0]]\nC = [1]\nD = " +
         direct + "\n";
}

bool is_rounded(const std::string& damping) { return parse_drive(servo_with(damping)).is_rounded; }

TEST(LongDecimals, AreSeenInFiles) {
  for (const char* text :
       {"0.19", "0.190", "1.9e-1", "+0.19", "'0.19'", "0.1_9", "1", "0.5", "'1/4'", "'3:2'",
        "0.30000000000000004", "{ value = 0.19, tolerance = '10 %' }", "'0.19 ± 0.01'", "0"}) {
    EXPECT_FALSE(is_rounded(text)) << text;
  }
  for (const char* text :
       {"0.19000000000000000000001", "0.18999999999999999999", "1.9000000000000000000001e-1",
        "'0.19000000000000000000001'", "0.19_000_000_000_000_000_000_001",
        "0.5000000000000000000001", "0.30000000000000001", "'1/3'", "'0.1/3'",
        "{ value = 0.19000000000000000000001, tolerance = '10 %' }",
        "{ min = 0.1, max = 0.2000000000000000000001 }", "'0.19000000000000000000001 ± 0.01'",
        "0.190000000000000002220446049250313080847263336181640625"}) {  // exactly the double
    EXPECT_TRUE(is_rounded(text)) << text;
  }
}

TEST(LongDecimals, ANumberBelowAllDoublesIsNotZero) {
  for (const char* text :
       {"1e-400", "-1e-400", "'1e-400'", "{ value = 1e-400, tolerance = 0.1 }"}) {
    EXPECT_THROW(static_cast<void>(parse_drive(servo_with(text))), InvalidInput) << text;
  }
  for (const char* text : {"0.0", "0e-400", "0.00"}) {
    EXPECT_EQ(parse_drive(servo_with(text)).servo->damping, 0.0);
  }
  EXPECT_NO_THROW(parse_drive(sheet_with("[20.5, -20.5, 0]"), "s.toml", {}, {}));
  EXPECT_THROW(parse_drive(sheet_with("[20.5, -20.5, 1e-400]"), "s.toml", {}, {}), InvalidInput);
  EXPECT_THROW(parse_drive(sheet_with("[20.5, -20.5, 0]"), "s.toml", {},
                           {{"controller.D", "[20.5, -20.5, 1e-400]"}}),
               InvalidInput);
}

// What is proved of every restitution up to 1 would be said of one above it.
TEST(LongDecimals, ANumberAboveOneIsNotOne) {
  const auto with = [](const std::string& friction, const std::string& restitution) {
    return parse_drive("[servo]\ndamping = 0.5\ninertia_ratio = 2\nfriction_ratio = " + friction +
                       "\nbacklash = '0.3 rad'\n[contact]\nrestitution = " + restitution + "\n");
  };
  for (const char* above :
       {"1.00000000000000000001", "'1.00000000000000000001'", "+1.000_000_1",
        "'1.00000000000000000001/1'", "'3:2.9999999999999999999999'",
        "100000000000000000000001e-23", "{ value = 0.5, min = 0, max = 1.00000000000000000001 }"}) {
    EXPECT_THROW(with("0.1", above), InvalidInput) << above;
    EXPECT_THROW(with(above, "0"), InvalidInput) << above;
  }
  EXPECT_THROW(with("0.1", "'100.00000000000000000001 %'"), InvalidInput);
  for (const char* one : {"1", "1.0", "1.00000000000000000000000", "'100 %'", "'100.0 %'", "'3/3'",
                          "0.99999999999999999999", "'2.9999999999999999999999:3'"}) {
    const Drive drive = with("0.1", one);
    EXPECT_EQ(std::get<RigidContact>(drive.contact).restitution, 1.0) << one;
  }
  EXPECT_EQ(with("1.000000000000000000000", "0").servo->friction_ratio, 1.0);
  const auto set_to = [](const char* path, const std::string& text) {
    Drive drive = normal_form(0.5, 2.0, 0.1);
    set(drive, path, std::string_view(text));
    return faults(drive);
  };
  for (const char* path : {"contact.restitution", "servo.friction_ratio"}) {
    EXPECT_FALSE(set_to(path, "1.00000000000000000001").empty());
    EXPECT_TRUE(set_to(path, "1.000").empty());
    EXPECT_THROW(read_axis({"--x", path, "0.5,1.00000000000000000001"}, normal_form(0.5, 2.0, 0.1)),
                 InvalidInput);
  }
}

TEST(LongDecimals, AreSeenInSettings) {
  const auto with = [](const std::string& path, const std::string& value) {
    return parse_drive(servo_with("0.19"), "s.toml", {}, {{path, value}}).drive.is_rounded;
  };
  EXPECT_FALSE(with("servo.damping", "0.2"));
  EXPECT_TRUE(with("servo.damping", "0.20000000000000000000001"));
  EXPECT_TRUE(with("servo.damping", "{ value = 0.20000000000000000000001, tolerance = 0.1 }"));
  // A short one in place of a long one.
  EXPECT_FALSE(
      parse_drive(servo_with("0.19000000000000000000001"), "s.toml", {}, {{"servo.damping", "0.2"}})
          .drive.is_rounded);
  Drive drive = normal_form(0.19, 2.0, 0.1);
  set(drive, "servo.damping", std::string_view("0.2"));
  EXPECT_FALSE(drive.is_rounded);
  set(drive, "servo.damping", std::string_view("0.20000000000000000000001"));
  EXPECT_TRUE(drive.is_rounded);
}

TEST(LongDecimals, AreSeenOnAxes) {
  const auto with = [](const std::string& values) {
    return drive_of_axes(normal_form(0.19, 2.0, 0.1), {{"--x", "damping", values}}).is_rounded;
  };
  EXPECT_FALSE(with("0.1:0.6:6"));
  EXPECT_FALSE(with("0.1,0.25,1/4"));
  EXPECT_TRUE(with("0.1:0.60000000000000000000001:6"));
  EXPECT_TRUE(with("0.1,0.60000000000000000000001"));
  EXPECT_TRUE(with("1/3,1/2"));
  const auto sweep = [](const std::string& end) {
    return parse_sweep("[sweep]\naxes = ['damping=0.1:" + end +
                           ":6']\n[servo]\ninertia_ratio = 2\nfriction_ratio = 0.1\n",
                       "s.toml")
        .grid.drive.is_rounded;
  };
  EXPECT_FALSE(sweep("0.6"));
  EXPECT_TRUE(sweep("0.60000000000000000000001"));
}

TEST(LongDecimals, MatterInListsOfControllersAlone) {
  const auto rounded = [](const std::string& direct, const std::string& ratio = "43") {
    return parse_drive(sheet_with(direct, ratio)).is_rounded;
  };
  EXPECT_FALSE(rounded("[20.5, -20.5, 0]"));
  EXPECT_FALSE(rounded("[20.5, -20.5, 0]", "'113/12'"));
  EXPECT_FALSE(rounded("[20.5, -20.5, 0]", "43.000000000000000000001"));
  EXPECT_TRUE(rounded("[20.5, -20.500000000000000000001, 0]"));
  const Drive drive = parse_drive(sheet_with("[20.5, -20.500000000000000000001, 0]"));
  EXPECT_TRUE(reduce(drive).has_rounded_lists);
  // Nor is that the controller acts on the error alone.
  const auto with_dead_band = [](const std::string& direct) {
    return parse_drive(sheet_with(direct) + "dead_band = '1 mrad'\n");
  };
  EXPECT_NO_THROW(with_dead_band("[20.5, -20.5, 0]"));
  EXPECT_THROW(with_dead_band("[20.5, -20.500000000000000000001, 0]"), InvalidInput);
  // No state is seen: it would be proportional, were k and −k known to be equal.
  const auto is_servo = [](const std::string& direct) {
    std::string text = sheet_with(direct);
    text.replace(text.find("C = [1]"), 7, "C = [0]");
    return proportional_servo(parse_drive(text)).has_value();
  };
  EXPECT_TRUE(is_servo("[20.5, -20.5, 0]"));
  EXPECT_FALSE(is_servo("[20.5, -20.500000000000000000001, 0]"));
}

TEST(LongDecimals, ANormalFormOfADataSheetIsComputed) {
  const Drive sheet = parse_drive(
      "[motor]\nkind = 'torque-controlled'\ninertia = '2 g cm2'\nfriction = '1e-6 N m "
      "s/rad'\n[gearbox]\nratio = 43\n"
      "backlash = '2 mrad'\n[load]\ninertia = '0.01 kg m2'\nfriction = '0.1 N m s/rad'\n"
      "[controller]\nkind = 'P'\nproportional = '1 N m/rad'\n");
  EXPECT_FALSE(sheet.is_rounded);
  const std::optional<Drive> form = normal_form_of(sheet);
  ASSERT_TRUE(form);
  EXPECT_TRUE(form->is_rounded);
  EXPECT_FALSE(normal_form_of(normal_form(0.2, 1.0, 0.2))->is_rounded);
}

}  // namespace
}  // namespace gearlash::long_decimal_test
