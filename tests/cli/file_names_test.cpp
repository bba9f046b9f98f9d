// Names of files are bytes: a table whose name is not UTF-8 is read, and outputs stay UTF-8.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tool.hpp"

namespace gearlash::file_names_test {
namespace {

namespace fs = std::filesystem;
using test::file_text;
using test::Outcome;
using test::quoted;
using test::run_shell;
using test::Scratch;
using testing::HasSubstr;

/// A folder with a table, whose name is Latin-1.
class FileNames : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / table) << "time (s), position (rad)\n0, 0\n0.1, 0.2\n";
    fs::copy_file(GEARLASH_SOURCE_DIRECTORY "/examples/first-servo.toml", folder_ / "servo.toml");
  }
  /// `command` has ARGUMENTS where the drive stands.
  Outcome run(std::string command) const {
    const std::string arguments = "servo.toml --set reference.kind=table --set " +
                                  quoted(std::string("reference.file=") + table);
    command.replace(command.find("ARGUMENTS"), 9, arguments);
    return run_shell("cd " + quoted((folder_ / "").string()) + "; \"$GEARLASH\" " + command);
  }

  static constexpr char table[] = "caf\xE9.csv";
  Scratch folder_;
};

TEST_F(FileNames, EveryVerbTakesATable) {
  for (const char* command :
       {"show ARGUMENTS --format json", "limit-cycle ARGUMENTS --format json",
        "simulate ARGUMENTS --until 1 --format json", "describe ARGUMENTS --format json",
        "compare ARGUMENTS --sensor motor --until 1 --format json"}) {
    const Outcome outcome = run(command);
    ASSERT_LE(outcome.status, 1) << command << ": " << outcome.err;
    const nlohmann::json json = nlohmann::json::parse(outcome.out);
    if (!json.contains("drive")) continue;  // of compare
    EXPECT_EQ(json["drive"]["reference.file"], "café.csv") << command;
  }
  const Outcome map =
      run("map ARGUMENTS --x gearbox.ratio=50,100 --y load.inertia='1 kg m2,2 kg m2' "
          "--output map.json");
  ASSERT_LE(map.status, 1) << map.err;
  EXPECT_TRUE(nlohmann::json::accept(file_text(folder_ / "map.json")));
}

// TOML is UTF-8 and cannot name the file.
TEST_F(FileNames, ShowWritesThePoints) {
  const Outcome shown = run("show ARGUMENTS");
  ASSERT_EQ(shown.status, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("times = [0, 0.1]\nvalues = [0, 0.2]\n"));
  std::ofstream(folder_ / "shown.toml") << shown.out;
  const Outcome again = run_shell("\"$GEARLASH\" show " + quoted(folder_ / "shown.toml"));
  EXPECT_EQ(again.out, shown.out) << again.err;
}

TEST_F(FileNames, FaultsStayOnOneLineOfText) {
  std::ofstream(folder_ / table) << "time (s), position (rad)\n0, 0\n0, 0.2\n";
  const Outcome outcome = run("show ARGUMENTS");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("caf\\xe9.csv:3: time = 0: must be later"));
  std::ofstream(folder_ / table) << "time (s), position (rad)\n0, 0\n0.1, 0.2\n";
  const Outcome own = run("simulate ARGUMENTS --output $'caf\\xE9.csv'");
  EXPECT_EQ(own.status, 2);
  EXPECT_THAT(own.err, HasSubstr("must not be the file of reference.file, caf\\xe9.csv"));
}

}  // namespace
}  // namespace gearlash::file_names_test
