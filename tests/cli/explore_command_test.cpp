// gearlash explore: the drive goes into the page that is installed beside the tool. What the page
// then does in a browser is tested by tests/web.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tool.hpp"

namespace gearlash::explore_command_test {
namespace {

namespace fs = std::filesystem;
using test::file_text;
using test::Outcome;
using test::run_shell;
using test::Scratch;
using test::tool_path;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr char page[] = "<script type=\"application/json\" id=\"user-drive\"></script>";

/// The tool in a folder of its own, as it is installed.
class ExploreCommand : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "bin");
    fs::create_directories(folder_ / "share/gearlash");
    fs::copy_file(tool_path(), folder_ / "bin/gearlash");
    std::ofstream(folder_ / "share/gearlash/explorer.html") << page;
  }
  Outcome explore(const std::string& arguments) {
    return run_shell((folder_ / "bin/gearlash").string() + " explore " + arguments + " --output " +
                     output_);
  }
  nlohmann::json drive() const {
    std::string text = file_text(output_);
    text.erase(0, text.find('>') + 1);
    return nlohmann::json::parse(text.substr(0, text.find("</script>")));
  }

  Scratch folder_;
  std::string output_ = (folder_ / "drive.html").string();
};

TEST_F(ExploreCommand, TheFileGoesAsItIsWithItsSettings) {
  const Outcome run = explore("examples/robot-joint.toml --set 'gearbox.backlash=1 deg'");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(drive()["toml"],
            file_text(fs::path(GEARLASH_SOURCE_DIRECTORY) / "examples/robot-joint.toml"));
  EXPECT_EQ(drive()["name"], "robot-joint.toml");
  EXPECT_EQ(drive()["settings"], nlohmann::json::parse(R"([["gearbox.backlash", "1 deg"]])"));
}

TEST_F(ExploreCommand, OptionsAndStandardInputGiveAWholeDrive) {
  const Outcome form =
      explore("--damping .19 --inertia-ratio 2 --friction-ratio .1 --backlash '3 deg'");
  ASSERT_EQ(form.status, 0) << form.err;
  EXPECT_THAT(drive()["toml"].get<std::string>(), HasSubstr("damping = 0.19"));
  const Outcome piped = explore("- --backlash '3 deg' < examples/elinco-fd162.toml");
  ASSERT_EQ(piped.status, 0) << piped.err;
  EXPECT_THAT(drive()["toml"].get<std::string>(), HasSubstr("[gearbox]"));
}

TEST_F(ExploreCommand, NamedTablesGoAlong) {
  std::ofstream(folder_ / "steps.csv") << "time (s), position (rad)\n0, 0\n1, 0.2\n";
  std::ofstream(folder_ / "joint.toml")
      << file_text(fs::path(GEARLASH_SOURCE_DIRECTORY) / "examples/first-servo.toml")
      << "\n[reference]\nkind = \"table\"\nfile = \"steps.csv\"\n";
  const Outcome run = explore((folder_ / "joint.toml").string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(drive()["files"]["steps.csv"], "time (s), position (rad)\n0, 0\n1, 0.2\n");
}

TEST_F(ExploreCommand, BytesThatAreNotUtf8AreReadAsLatin1) {
  std::ofstream(folder_ / "steps.csv") << "# 20 \xB0\ntime (s), position (rad)\n0, 0\n1, 0.2\n";
  std::ofstream(folder_ / "caf\xE9.toml")
      << file_text(fs::path(GEARLASH_SOURCE_DIRECTORY) / "examples/first-servo.toml")
      << "\n[reference]\nkind = \"table\"\nfile = \"steps.csv\"\n";
  const Outcome run = explore((folder_ / "caf\xE9.toml").string());
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(drive()["files"]["steps.csv"], "# 20 °\ntime (s), position (rad)\n0, 0\n1, 0.2\n");
  EXPECT_EQ(drive()["name"], "café.toml");
}

TEST_F(ExploreCommand, TablesOfSettingsAreFoundByTheirNamesOnThePage) {
  fs::create_directory(folder_ / "sub");
  const std::string sheet = (fs::path(GEARLASH_SOURCE_DIRECTORY) / "examples/first-servo.toml");
  for (const char* name : {"sub/steps.csv", "sub/caf\xE9.csv", "caf\xE9.csv"}) {
    const std::string table = (folder_ / name).string();
    std::ofstream(table) << "time (s), position (rad)\n0, 0\n1, 0.2\n";
    const std::string set =
        " --set reference.kind=table --set " + test::quoted("reference.file=" + table);
    const std::string base = fs::path(name).filename() == "steps.csv" ? "steps.csv" : "café.csv";
    for (const std::string& file : {sheet + set, "- <" + sheet + set}) {
      const Outcome run = explore(file);
      ASSERT_EQ(run.status, 0) << run.err;
      EXPECT_EQ(drive()["files"].size(), 1U);
      ASSERT_TRUE(drive()["files"].contains(base)) << drive().dump();
      const nlohmann::json last = drive()["settings"].back();
      EXPECT_EQ(last, (nlohmann::json{"reference.file", base}));
    }
    EXPECT_THAT(drive()["toml"].get<std::string>(), HasSubstr("file = \"" + base + "\""));
  }
}

TEST_F(ExploreCommand, TextOfTheDriveCannotEndItsElement) {
  std::ofstream(folder_ / "sly.toml")
      << "# </script><b>\n"
      << file_text(fs::path(GEARLASH_SOURCE_DIRECTORY) / "examples/normalized.toml");
  ASSERT_EQ(explore((folder_ / "sly.toml").string()).status, 0);
  EXPECT_THAT(file_text(output_), Not(HasSubstr("<b>")));
  EXPECT_THAT(drive()["toml"].get<std::string>(), HasSubstr("</script><b>"));
}

TEST_F(ExploreCommand, BadInputIsRefusedAllAtOnce) {
  output_ = (folder_ / "drive.txt").string();
  const Outcome run = explore("examples/normalized.toml --set servo.damping=-1");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, AllOf(HasSubstr("must end in .html"), HasSubstr("servo.damping")));
  EXPECT_FALSE(fs::exists(output_));
}

TEST_F(ExploreCommand, AMissingPageIsAFaultOfTheMachine) {
  fs::remove(folder_ / "share/gearlash/explorer.html");
  const Outcome run = explore("examples/normalized.toml");
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("explorer.html"), HasSubstr("make web")));
  EXPECT_FALSE(fs::exists(output_));
}

}  // namespace
}  // namespace gearlash::explore_command_test
