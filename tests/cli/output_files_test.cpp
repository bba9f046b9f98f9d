// Output files appear whole or not at all, whatever goes wrong.
#include <gmock/gmock.h>

#include "tool.hpp"

namespace gearlash::output_files_test {
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

std::vector<std::string> simulate_into(const std::filesystem::path& path) {
  return {"simulate", "examples/elinco-fd162.toml", "--output", path.string()};
}

TEST(OutputFiles, HoldWhatStandardOutputWould) {
  const Scratch scratch;
  const Outcome to_file = run_tool(simulate_into(scratch / "table.csv"));
  EXPECT_EQ(to_file.status, 0) << to_file.err;
  EXPECT_EQ(to_file.out, "");
  const Outcome to_output = run_tool(simulate_into("-"));
  EXPECT_EQ(file_text(scratch / "table.csv"), to_output.out);
  EXPECT_EQ(scratch.file_count(), 1U);
}

TEST(OutputFiles, FullDisk) {
  const Outcome table = run_tool(simulate_into("/dev/full"));
  EXPECT_EQ(table.status, 3);
  EXPECT_EQ(table.err, "gearlash: /dev/full: cannot be written: No space left on device\n");
  for (const char* arguments :
       {"limit-cycle examples/elinco-fd162.toml", "motor examples/elinco-fd162.toml",
        "simulate examples/elinco-fd162.toml", "--help", "--version"}) {
    const Outcome run = run_shell(std::string("\"$GEARLASH\" ") + arguments + " > /dev/full");
    EXPECT_EQ(run.status, 3) << arguments;
    EXPECT_EQ(run.err, "gearlash: standard output: cannot be written: No space left on device\n");
  }
}

TEST(OutputFiles, AFailureLeavesTheOldFileAndNothingElse) {
  const Scratch scratch;
  std::ofstream(scratch / "table.csv") << "old";
  // No file may grow beyond a kilobyte: the table fails when it is half written.
  const Outcome run = run_shell(
      "ulimit -f 1; \"$GEARLASH\" simulate examples/elinco-fd162.toml "
      "--output " +
      quoted((scratch / "table.csv").string()));
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("table.csv: cannot be written: File too large"));
  EXPECT_EQ(file_text(scratch / "table.csv"), "old");
  EXPECT_EQ(scratch.file_count(), 1U);
}

/// A line for bash that sends the command a signal as soon as `is_under_way` succeeds.
std::string ended_by(const std::string& signal, const std::string& command,
                     const std::string& is_under_way) {
  return "set -m; " + command + " & tool=$!\nuntil " + is_under_way +
         " || ! kill -0 $tool; do :; done\nkill -" + signal + " $tool; wait $tool";
}

TEST(OutputFiles, BeingKilledLeavesNothingThatTheNextRunDoesNotRemove) {
  for (const std::string signal : {"TERM", "INT", "HUP", "KILL"}) {
    const Scratch scratch;
    // The table takes many seconds; it is killed as soon as its hidden file is there.
    const Outcome run = run_shell(ended_by(
        signal,
        "\"$GEARLASH\" simulate examples/elinco-fd162.toml --until 1 --every 1.1e-7 --output " +
            quoted((scratch / "table.csv").string()),
        "ls -A " + quoted((scratch / "").string()) + " | grep -q ."));
    EXPECT_GT(run.status, 128) << signal;
    EXPECT_EQ(scratch.file_count(), signal == "KILL" ? 1U : 0U) << signal;
    if (signal != "KILL") continue;
    EXPECT_EQ(run_tool(simulate_into(scratch / "table.csv")).status, 0);
    EXPECT_EQ(scratch.file_count(), 1U);
    EXPECT_THAT(file_text(scratch / "table.csv"), StartsWith("time_s,"));
  }
}

/// A map or a chart that takes hours, or one whose table takes seconds to write.
std::string long_work(const std::string& command, const std::filesystem::path& file) {
  const std::string axes =
      command == "map" ? " --y damping=0.05:0.8:1000" : " --curves damping=0.1,0.2";
  const bool is_table = file.extension() == ".json";
  return "\"$GEARLASH\" " + command + " --x friction-ratio=0.05:0.95:5000" + axes +
         " --inertia-ratio 2 " + (is_table ? "" : "--restitution 0.3 ") + "--output " +
         quoted(file.string());
}

TEST(OutputFiles, InterruptedMapsAndChartsLeaveNothing) {
  for (const char* command : {"map", "chart"}) {
    const Scratch scratch;
    std::ofstream(scratch / "map.svg") << "old";
    // In the middle of the work: it has taken some hundredths of a second.
    const Outcome run = run_shell(ended_by("INT", long_work(command, scratch / "map.svg"),
                                           "awk '{ exit !($14 > 20) }' /proc/$tool/stat"));
    EXPECT_EQ(run.status, 130) << command << run.err;
    EXPECT_EQ(file_text(scratch / "map.svg"), "old");
    EXPECT_EQ(scratch.file_count(), 1U);
  }
}

TEST(OutputFiles, AMapInterruptedWhileItIsWrittenLeavesNothing) {
  const Scratch scratch;
  // As soon as there is something in the hidden file, of some gigabyte.
  const Outcome run = run_shell(
      ended_by("INT", long_work("map", scratch / "map.json"),
               "find " + quoted((scratch / "").string()) + " -size +0 -name '.map*' | grep -q ."));
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_EQ(scratch.file_count(), 0U);
}

TEST(OutputFiles, LongWorkTellsATerminalHowFarItIsAndEndsWithControlC) {
  const Scratch scratch;
  const std::string terminal = quoted((scratch / "terminal").string());
  std::ofstream(scratch / "work") << "GEARLASH=" << quoted(tool_path()) << "\n"
                                  << long_work("map", scratch / "map.svg")
                                  << "\nstatus=$?; echo not left; exit $status\n";
  // `script` gives it a terminal, at which Ctrl-C is typed as soon as it has told something. Where
  // there are no terminals to give it never tells, and the wait has an end.
  const Outcome run =
      run_shell("{ for turn in {1..1200}; do grep -qs left " + terminal +
                " && break; sleep 0.05; done; printf '\\003'; } | script -qfec \"bash " +
                (scratch / "work").string() + "\" " + terminal + " >&2");
  EXPECT_THAT(file_text(scratch / "terminal"),
              testing::ContainsRegex("\rMap: +[0-9]+ %, [0-9]+ points/s, [0-9]+ (s|min|h) left"));
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_EQ(scratch.file_count(), 2U);  // those of this test
}

TEST(OutputFiles, AClosedPipeEndsItQuietly) {
  const Outcome run = run_shell(
      "set -o pipefail; \"$GEARLASH\" simulate examples/elinco-fd162.toml --until 1 --every 1e-4 | "
      "head -n 1");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.out, StartsWith("time_s,"));
  EXPECT_EQ(run.err, "");
}

TEST(OutputFiles, AnyFileNameWillDo) {
  const Scratch scratch;
  const std::string name = "a b'c\"d`e$(touch f)\n{g};h.svg";
  const Outcome run = run_tool({"limit-cycle", "examples/elinco-fd162.toml", "--plot",
                                "phase=" + (scratch / name).string()});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(file_text(scratch / name), StartsWith("<?xml"));
  EXPECT_EQ(scratch.file_count(), 1U);
}

TEST(OutputFiles, ASymbolicLinkStaysOneAndPermissionsStay) {
  const Scratch scratch;
  std::ofstream(scratch / "real.csv") << "old";
  std::filesystem::permissions(scratch / "real.csv", std::filesystem::perms(0640));
  std::filesystem::create_symlink(scratch / "real.csv", scratch / "link.csv");
  EXPECT_EQ(run_tool(simulate_into(scratch / "link.csv")).status, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(scratch / "link.csv"));
  EXPECT_THAT(file_text(scratch / "real.csv"), StartsWith("time_s,"));
  EXPECT_EQ(std::filesystem::status(scratch / "real.csv").permissions(),
            std::filesystem::perms(0640));
}

TEST(OutputFiles, ADanglingLinkStaysOneAndItsFileIsMade) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "folder");
  std::filesystem::create_symlink("folder/second.csv", scratch / "link.csv");
  std::filesystem::create_symlink("made.csv", scratch / "folder/second.csv");
  EXPECT_EQ(run_tool(simulate_into(scratch / "link.csv")).status, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(scratch / "link.csv"));
  EXPECT_TRUE(std::filesystem::is_symlink(scratch / "folder/second.csv"));
  EXPECT_THAT(file_text(scratch / "folder/made.csv"), StartsWith("time_s,"));
  std::filesystem::create_symlink("nowhere/made.csv", scratch / "lost.csv");
  const Outcome run = run_tool(simulate_into(scratch / "lost.csv"));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("must be a file that can be written (No such file or directory)"));
  EXPECT_TRUE(std::filesystem::is_symlink(scratch / "lost.csv"));
}

TEST(OutputFiles, NoneMayTakeThePlaceOfAnother) {
  const Scratch scratch;
  const std::string sheet = (scratch / "own.toml").string();
  std::ofstream(sheet) << file_text(GEARLASH_SOURCE_DIRECTORY "/examples/elinco-fd162.toml");
  const std::string picture = (scratch / "y.svg").string();
  const Outcome run = run_tool({"simulate", sheet, "--output", sheet, "--plot", "time=" + picture,
                                "--plot", "phase=" + picture});
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("--output = " + sheet + ": must not be the file of DRIVE.toml"));
  EXPECT_THAT(run.err,
              HasSubstr("--plot = " + picture + ": must not be the file of another --plot"));
  EXPECT_EQ(file_text(sheet), file_text(GEARLASH_SOURCE_DIRECTORY "/examples/elinco-fd162.toml"));
  EXPECT_EQ(scratch.file_count(), 1U);
}

/// A drive that follows the table move.csv beside it.
void write_drive_with_table(const Scratch& scratch) {
  std::ofstream(scratch / "drive.toml")
      << file_text(GEARLASH_SOURCE_DIRECTORY "/examples/elinco-fd162.toml")
      << "\n[reference]\nkind = \"table\"\nfile = \"move.csv\"\n";
  std::ofstream(scratch / "move.csv") << "time (s),position (deg)\n0,0\n1,20\n";
}

TEST(OutputFiles, NoneMayTakeThePlaceOfATableThatTheDriveNames) {
  const Scratch scratch;
  write_drive_with_table(scratch);
  const std::string table = file_text(scratch / "move.csv");
  std::filesystem::create_symlink("move.csv", scratch / "link.csv");
  std::filesystem::create_hard_link(scratch / "move.csv", scratch / "hard.csv");
  for (const char* spelling : {"move.csv", "./move.csv", "link.csv", "hard.csv"}) {
    const Outcome run = run_shell("cd " + quoted((scratch / "").string()) +
                                  "; \"$GEARLASH\" simulate drive.toml --output " + spelling);
    EXPECT_EQ(run.status, 2) << spelling;
    EXPECT_EQ(run.err, std::string("gearlash: --output = ") + spelling +
                           ": must not be the file of reference.file, move.csv\n");
    EXPECT_EQ(file_text(scratch / "move.csv"), table);
  }
}

TEST(OutputFiles, NoneMayTakeThePlaceOfATableThatIsNamedBesideTheFile) {
  const Scratch scratch;
  write_drive_with_table(scratch);
  const std::string sheet = GEARLASH_SOURCE_DIRECTORY "/examples/elinco-fd162.toml";
  std::ofstream(scratch / "plain.toml") << file_text(sheet);
  std::ofstream(scratch / "sweep.toml")
      << file_text(scratch / "drive.toml") << "[sweep]\naxes = [\"contact.restitution=0,0.1\"]\n";
  const std::string table = file_text(scratch / "move.csv");
  const std::string set = " --set reference.kind=table --set reference.file=move.csv ";
  std::filesystem::create_symlink("move.csv", scratch / "move.nc");
  std::filesystem::create_symlink("move.csv", scratch / "move.svg");
  std::filesystem::create_hard_link(scratch / "move.csv", scratch / "move.html");
  std::filesystem::create_hard_link(scratch / "move.csv", scratch / "move.toml");
  for (const std::string& command : std::vector<std::string>{
           "simulate plain.toml" + set + "--output ./move.csv",
           "simulate - --output move.csv <drive.toml",
           "cat drive.toml | simulate - --plot time=move.svg",
           "simulate --damping 0.2 --inertia-ratio 2 --friction-ratio 0.1 --backlash 0.3" + set +
               "--output move.csv",
           "explore plain.toml" + set + "--output move.html",
           "explore - --output move.html <drive.toml",
           "limit-cycle plain.toml" + set + "--plot phase=move.svg",
           "describe plain.toml" + set + "--plot nyquist=move.svg",
           "compare plain.toml" + set + "--plot time=move.svg",
           "tune plain.toml" + set + "--write move.toml",
           "tolerance plain.toml" + set + "--plot yield=move.svg",
           "design plain.toml" + set + "--target no-hunting --plot region=move.svg",
           "chart plain.toml" + set + "--x gearbox.ratio=100,200 --output move.csv",
           "map plain.toml" + set +
               "--x gearbox.ratio=100,200 --y gearbox.backlash=0.1,0.2 --output move.nc",
           "sweep sweep.toml --output move.nc"}) {
    SCOPED_TRACE(command);
    const std::size_t bar = command.find("| ");
    const std::string piped = bar == std::string::npos ? "" : command.substr(0, bar + 2);
    const Outcome run = run_shell("cd " + quoted((scratch / "").string()) + "; " + piped +
                                  "\"$GEARLASH\" " + command.substr(piped.size()));
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr(": must not be the file of reference.file, move.csv\n"));
    EXPECT_EQ(file_text(scratch / "move.csv"), table);
  }
}

TEST(OutputFiles, NoneMayTakeThePlaceOfStandardInput) {
  const Scratch scratch;
  const std::string sheet = file_text(GEARLASH_SOURCE_DIRECTORY "/examples/elinco-fd162.toml");
  std::ofstream(scratch / "own.toml") << sheet;
  const Outcome run = run_shell("cd " + quoted((scratch / "").string()) +
                                "; \"$GEARLASH\" simulate - --output own.toml <own.toml");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "gearlash: --output = own.toml: must not be the file of standard input, /dev/stdin\n");
  EXPECT_EQ(file_text(scratch / "own.toml"), sheet);
}

TEST(OutputFiles, TwoSpellingsOfANewFileAreOneFile) {
  const Scratch scratch;
  const Outcome run =
      run_shell("sheet=$PWD/examples/elinco-fd162.toml; cd " + quoted((scratch / "").string()) +
                "; \"$GEARLASH\" simulate \"$sheet\" --plot time=new.svg --plot phase=./new.svg");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "gearlash: --plot = ./new.svg: must not be the file of another --plot, new.svg\n");
  EXPECT_EQ(scratch.file_count(), 0U);
}

/// A chart whose NetCDF file has a thousand numbers of each quantity.
std::string small_netcdf_file(const Scratch& scratch) {
  return "\"$GEARLASH\" chart --x backlash=0.1:0.2:1000 --damping 0.2 --inertia-ratio 2 "
         "--friction-ratio 0.1 --output " +
         quoted((scratch / "a.nc").string());
}

TEST(OutputFiles, ANetcdfFileThatGrowsTooLargeLeavesNothing) {
  const Scratch scratch;
  // Each limit in kB up to the first that suffices. The message goes into a pipe, which has none.
  const Outcome run =
      run_shell("for size in {0..200}; do (ulimit -f $size; " + small_netcdf_file(scratch) +
                ") 2>&1 | cat; status=${PIPESTATUS[0]}; [ $status = 0 ] && exit 0; "
                "echo $status; ls -A " +
                quoted((scratch / "").string()) + "; done; exit 1");
  EXPECT_EQ(run.status, 0);
  const std::vector<std::string> lines = test::lines_of(run.out);
  EXPECT_GT(lines.size(), 20U);
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
    EXPECT_THAT(lines[i], testing::EndsWith("a.nc: cannot be written: File too large"));
    EXPECT_EQ(lines[i + 1], "3");
  }
  EXPECT_THAT(lines.back(), HasSubstr("a.nc: 1000 servos, "));
}

TEST(OutputFiles, ATableThatFailsWithholdsNeitherPictureNorAnswer) {
  const Scratch scratch;
  const Outcome run =
      run_shell("cd " + quoted((scratch / "").string()) +
                "; ulimit -f 200; \"$GEARLASH\" chart --x backlash=0.1:0.2:3000 --damping 0.2 "
                "--inertia-ratio 2 --friction-ratio 0.1 --output a.nc --plot curves=a.svg");
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.err, "gearlash: a.nc: cannot be written: File too large\n");
  EXPECT_THAT(run.out, StartsWith("a.svg: 3000 servos, "));
  EXPECT_THAT(file_text(scratch / "a.svg"), StartsWith("<?xml"));
  EXPECT_EQ(scratch.file_count(), 1U);
}

/// A line for bash in which the folder `full` of `scratch` is a disk without room.
std::string on_a_full_disk(const Scratch& scratch, const std::string& line) {
  std::ofstream(scratch / "line") << "mount -t tmpfs -o size=8k none \"$FULL\" || exit 99\n"
                                     "dd if=/dev/zero of=\"$FULL/filling\" bs=1k count=8 2>&-\n"
                                  << line << "\n";
  std::filesystem::create_directory(scratch / "full");
  return "export GEARLASH; export FULL=" + quoted((scratch / "full").string()) +
         "; unshare --user --map-root-user --mount bash " + quoted((scratch / "line").string()) +
         " || exit";
}

TEST(OutputFiles, AFullFolderForTemporaryFilesKeepsTheOldPicture) {
  const Scratch scratch;
  if (run_shell(on_a_full_disk(scratch, "true")).status != 0) {
    GTEST_SKIP() << "no disk of one's own can be mounted here";
  }
  const Scratch own;
  std::ofstream(own / "a.svg") << "old";
  const Outcome run = run_shell(on_a_full_disk(
      own, "TMPDIR=$FULL \"$GEARLASH\" limit-cycle examples/elinco-fd162.toml --plot phase=" +
               quoted((own / "a.svg").string())));
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.err, "gearlash: gnuplot: its script cannot be written: No space left on device\n");
  EXPECT_THAT(run.out, StartsWith("hunts: "));
  EXPECT_EQ(file_text(own / "a.svg"), "old");
}

TEST(OutputFiles, ADeviceIsWrittenTo) {
  EXPECT_EQ(run_tool(simulate_into("/dev/null")).status, 0);
  EXPECT_THAT(run_tool(simulate_into("/dev/stdout")).out, StartsWith("time_s,"));
}

TEST(OutputFiles, TheirCommandStaysOnOneLine) {
  const Scratch scratch;
  const Outcome run = run_tool({"simulate", "examples/elinco-fd162.toml", "--until", "1",
                                "--format", "json", "--output", (scratch / "a\nb.json").string()});
  EXPECT_EQ(run.status, 0) << run.err;
  const auto lines = test::lines_of(file_text(scratch / "a\nb.json"));
  EXPECT_THAT(lines, testing::Contains(testing::AllOf(testing::StartsWith("  \"command\": "),
                                                      testing::EndsWith("a\\\\nb.json'\","))));
}

}  // namespace
}  // namespace gearlash::output_files_test
