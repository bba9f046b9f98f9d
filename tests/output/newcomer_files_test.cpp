// The drives that new users typed in: each reads, and `show` reads back as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "gearlash/fault.hpp"
#include "gearlash/input.hpp"
#include "output/drive_text.hpp"
#include "question/faults_of.hpp"

namespace gearlash::newcomer_files_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path folder = fs::path(GEARLASH_SOURCE_DIRECTORY) / "tests/input/data/newcomers";

WrittenDrive read(const fs::path& file) {
  return parse_drive(read_text_file(file, largest_drive_file), file.string(), {}, {});
}

TEST(NewcomerFiles, ReadAndShowAndReadBack) {
  std::set<std::string> read_ones;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().stem() == "arm") continue;
    const WrittenDrive written = read(entry.path());
    const std::string shown = show_text(written.drive);
    const Drive again = parse_drive(shown, "shown.toml", {}, {}).drive;
    EXPECT_EQ(show_text(again), shown) << entry.path();
    EXPECT_EQ(parameter_values(again), parameter_values(written.drive)) << entry.path();
    const std::string toleranced = to_toml(TolerancedDrive{written.drive, written.tolerances});
    const WrittenDrive back = parse_drive(toleranced, "written.toml", {}, {});
    EXPECT_EQ(back.tolerances, written.tolerances) << entry.path();
    read_ones.insert(entry.path().stem().string());
  }
  EXPECT_EQ(read_ones, (std::set<std::string>{"faul", "jt", "moteus", "nema23", "nema23f", "odrive",
                                              "series"}));
}

/// It has a servo's name and none of its motor's numbers.
TEST(NewcomerFiles, AreToldAllThatLacks) {
  const std::vector<std::string> faults = test::faults_of([] { read(folder / "arm.toml"); });
  EXPECT_THAT(
      faults,
      ::testing::ElementsAre(
          HasSubstr("motor.inertia is missing: must be a moment of inertia, such as 0.3 kg cm2"),
          HasSubstr("motor.friction is missing"), HasSubstr("motor.torque_constant is missing"),
          HasSubstr("motor.back_emf_constant is missing"), HasSubstr("motor.resistance is missing"),
          HasSubstr("load.friction is missing")));
}

/// The gear's ratio and the firmware's multiply; never in silence.
TEST(NewcomerFiles, TwoRatiosAreNoted) {
  const auto note = [](const char* ratio) {
    const fs::path file = folder / "moteus.toml";
    return show_text(parse_drive(read_text_file(file, largest_drive_file), file.string(), {},
                                 {{"controller.rotor_to_output_ratio", ratio}})
                         .drive);
  };
  EXPECT_THAT(note("1"), HasSubstr("One turn of the load is 8 of those that moteus counts"));
  EXPECT_THAT(note("0.125"), HasSubstr("One turn of the load is 1 of those that moteus counts"));
  EXPECT_THAT(note("0.25"), HasSubstr("One turn of the load is 2 of those that moteus counts"));
}

}  // namespace
}  // namespace gearlash::newcomer_files_test
