// Exit status 3: what the machine could not do withholds nothing that it could.
#include <gmock/gmock.h>

#include "tool.hpp"

namespace gearlash::exit_status_test {
namespace {

using test::file_text;
using test::Outcome;
using test::quoted;
using test::run_shell;
using test::run_tool;
using test::Scratch;
using test::tool_path;
using testing::HasSubstr;
using testing::StartsWith;

/// A line for bash in which there is no gnuplot.
std::string without_gnuplot(const Scratch& scratch, const std::string& line) {
  return "PATH=" + quoted((scratch / "").string()) + "\n" + line;
}

constexpr char no_gnuplot[] =
    "gearlash: gnuplot: not found; pictures need it: apt-get install gnuplot-nox\n";

TEST(ExitStatus, ThreeForAPictureThatFailsWhoseAnswerIsPrinted) {
  const Scratch scratch;
  const std::string sheet = " examples/elinco-fd162.toml";
  const std::string plot = quoted((scratch / "a.svg").string());
  std::ofstream(scratch / "a.svg") << "old";
  for (const auto& [command, answer] :
       {std::pair("limit-cycle" + sheet + " --plot phase=" + plot, "hunts: "),
        std::pair("limit-cycle examples/robot-joint.toml --plot phase=" + plot, "hunts: the motor"),
        std::pair("describe" + sheet + " --plot nyquist=" + plot, "hunts: "),
        std::pair("compare" + sheet + " --sensor load --plot time=" + plot, "  load  hunts: "),
        std::pair("simulate" + sheet + " --plot phase=" + plot, "time_s,"),
        std::pair("simulate examples/robot-joint.toml --plot time=" + plot, "time_s,"),
        std::pair(
            "design" + sheet +
                " --target no-hunting --vary controller.proportional,load.friction --plot region=" +
                plot,
            "target: ")}) {
    const Outcome run = run_shell(without_gnuplot(scratch, "\"$GEARLASH\" " + command));
    EXPECT_EQ(run.status, 3) << command;
    EXPECT_THAT(run.out, StartsWith(answer)) << command;
    EXPECT_EQ(run.err, no_gnuplot) << command;
  }
  EXPECT_EQ(file_text(scratch / "a.svg"), "old");
  EXPECT_EQ(scratch.file_count(), 1U);
}

TEST(ExitStatus, TwoForAFileThatCannotBeWrittenBeforeTheWork) {
  const Scratch scratch;
  const std::string missing = (scratch / "missing" / "a").string();
  for (const auto& [command, option, ending] :
       {std::tuple("limit-cycle examples/robot-joint.toml --plot phase=", "--plot", ".svg"),
        std::tuple("simulate examples/robot-joint.toml --output ", "--output", ".csv"),
        std::tuple("simulate examples/robot-joint.toml --plot time=", "--plot", ".svg"),
        std::tuple("tune examples/toleranced-joint.toml --write ", "--write", ".toml"),
        std::tuple("tolerance examples/toleranced-joint.toml --plot yield=", "--plot", ".svg"),
        std::tuple("compare examples/robot-joint.toml --plot time=", "--plot", ".svg"),
        std::tuple("describe examples/robot-joint.toml --plot nyquist=", "--plot", ".svg"),
        std::tuple("chart examples/robot-joint.toml --x gearbox.ratio=10:20:3 --output ",
                   "--output", ".csv"),
        std::tuple("explore examples/robot-joint.toml --output ", "--output", ".html"),
        std::tuple("sweep examples/sweep.toml --output ", "--output", ".nc"),
        std::tuple("thesis extension 4 --output ", "--output", ".svg"),
        std::tuple("thesis figure 7 --output ", "--output", ".svg"),
        std::tuple("thesis run --all --plot errors=", "--plot", ".svg")}) {
    const std::string file = missing + ending;
    const Outcome run = run_shell("\"$GEARLASH\" " + std::string(command) + quoted(file));
    EXPECT_EQ(run.status, 2) << command;
    EXPECT_EQ(run.out, "") << command;
    EXPECT_EQ(run.err, "gearlash: " + std::string(option) + " = " + file +
                           ": must be a file that can be written (No such file or directory)\n");
  }
  const Outcome folder =
      run_tool({"simulate", "examples/elinco-fd162.toml", "--output", (scratch / "").string()});
  EXPECT_EQ(folder.status, 2);
  EXPECT_THAT(folder.err, HasSubstr("can be written (Is a directory)"));
}

TEST(ExitStatus, ThreeForAFileThatFailsAfterTheWorkWhoseAnswerIsPrinted) {
  const Outcome run = run_tool({"tune", "examples/elinco-fd162.toml", "--write", "/dev/full"});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.out, StartsWith("target: "));
  EXPECT_EQ(run.err, "gearlash: /dev/full: cannot be written: No space left on device\n");
}

TEST(ExitStatus, TwoForAPictureThatTheDriveDoesNotHaveWhoseAnswerIsPrinted) {
  const Scratch scratch;
  const Outcome run = run_tool({"limit-cycle", "examples/dynamixel-joint.toml", "--plot",
                                "tornado=" + (scratch / "a.svg").string()});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.out, StartsWith("comes to rest"));
  EXPECT_THAT(run.err, HasSubstr("picture = tornado: must be left out"));
}

TEST(ExitStatus, ThreeStandsOverOne) {
  const Scratch scratch;
  const std::string undecided =
      "\"$GEARLASH\" describe --damping 1e-12 --inertia-ratio 1 --friction-ratio 1/2 --backlash "
      "0.3 "
      "--restitution 1 --plot nyquist=" +
      quoted((scratch / "a.svg").string());
  const Outcome one = run_shell(undecided);
  EXPECT_EQ(one.status, 1);
  EXPECT_EQ(one.err, "gearlash: the exact answer is undecided\n");
  EXPECT_THAT(one.out, StartsWith("undecided: "));
  const Outcome three = run_shell(without_gnuplot(scratch, undecided));
  EXPECT_EQ(three.status, 3);
  EXPECT_EQ(three.out, one.out);
  EXPECT_THAT(three.err, HasSubstr(no_gnuplot));
  EXPECT_THAT(three.err, HasSubstr("gearlash: the exact answer is undecided\n"));
}

TEST(ExitStatus, ThreeForMemory) {
  if (!test::may_limit_memory) GTEST_SKIP() << "sanitizers reserve more addresses than permitted";
  const Scratch scratch;
  const Outcome run = run_shell(
      "ulimit -v 700000; \"$GEARLASH\" map --x friction-ratio=0:1:3000 --y damping=0.1:0.2:3000 "
      "--inertia-ratio 1 --output " +
      quoted((scratch / "a.csv").string()));
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.err, "gearlash: not enough memory\n");
  EXPECT_EQ(scratch.file_count(), 0U);
}

/// The limit on threads is one on a user's; root has none.
TEST(ExitStatus, WithoutThreadsTheWorkIsDoneInOne) {
  const Scratch scratch;
  std::filesystem::permissions(scratch / "", std::filesystem::perms(0755));
  std::filesystem::copy_file(tool_path(), scratch / "gearlash");
  std::filesystem::copy_file(GEARLASH_SOURCE_DIRECTORY "/examples/toleranced.toml",
                             scratch / "sheet.toml");
  std::filesystem::create_directory(scratch / "out");
  std::filesystem::permissions(scratch / "out", std::filesystem::perms(0777));
  const std::string as_another =
      getuid() == 0 ? "setpriv --reuid 65534 --regid 65534 --clear-groups " : "";
  // LeakSanitizer, where the tool has it, needs a thread of its own.
  const std::string limited = as_another +
                              "env ASAN_OPTIONS=detect_leaks=0 bash -c 'ulimit -u 1; cd " +
                              (scratch / "").string() + "; exec \"$@\"' - ";
  const std::string can_start =
      "/usr/bin/python3 -c 'import threading; threading.Thread(target=int).start()'";
  if (run_shell(as_another + can_start).status != 0 || run_shell(limited + can_start).status == 0) {
    GTEST_SKIP() << "threads cannot be limited here";
  }
  for (const auto& [command, answer] :
       {std::pair("limit-cycle sheet.toml", "hunts: "),
        std::pair("tolerance sheet.toml --samples 32", "of "),
        std::pair("map --x friction-ratio=0.1:0.9:50 --y damping=0.1:0.6:50 --inertia-ratio 1 "
                  "--output out/a.csv",
                  "out/a.csv: 2500 servos"),
        std::pair("chart --x friction-ratio=0.1,0.9 --damping 0.1 --inertia-ratio 1 "
                  "--output out/b.nc",
                  "out/b.nc: 2 servos")}) {
    const Outcome run = run_shell(limited + "./gearlash " + command);
    EXPECT_EQ(run.status, 0) << command << "\n" << run.err;
    EXPECT_EQ(run.err, "") << command;
    EXPECT_THAT(run.out, HasSubstr(answer)) << command;
  }
}

}  // namespace
}  // namespace gearlash::exit_status_test
