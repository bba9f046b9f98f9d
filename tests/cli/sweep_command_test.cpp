// gearlash sweep as a user calls it: whole or not at all, and to be gone on with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tool.hpp"

namespace gearlash::sweep_command_test {
namespace {

using test::file_text;
using test::Outcome;
using test::quoted;
using test::run_shell;
using test::run_tool;
using test::Scratch;
using testing::HasSubstr;

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

/// Bouncing servos, so that it takes some seconds in several pieces.
constexpr char long_sweep[] =
    "[sweep]\n"
    "axes = [\"restitution=0.1:0.3:5\", \"friction-ratio=0.1:0.9:40\", \"damping=0.1,0.2\"]\n"
    "[servo]\ninertia_ratio = 1\n";

/// Starts the sweep, and once pieces are recorded, ends it with `signal`. Prints what is recorded.
std::string interrupted(const std::string& signal) {
  return "set +m\n\"$GEARLASH\" sweep sweep.toml --output a.nc & tool=$!\n"
         "until grep -q '\"points_done\": [1-9]' a.nc.part.json 2>/dev/null || ! kill -0 $tool; "
         "do\n"
         "  sleep 0.01\ndone\n"
         "kill -" +
         signal + " $tool; wait $tool; echo status $?; grep points_done a.nc.part.json\n";
}

std::string in_folder(const Scratch& scratch, const std::string& script) {
  return "cd " + quoted((scratch / "").string()) + "\n" + script;
}

/// What `gearlash sweep sweep.toml --output a.nc` and the options says, and with which status.
Outcome sweep_in(const Scratch& scratch, const std::string& options = "") {
  return run_shell(in_folder(scratch, "\"$GEARLASH\" sweep sweep.toml --output a.nc " + options));
}

/// The sweep of its file, killed in its midst.
void leave_unfinished(const Scratch& scratch, const std::string& text = long_sweep) {
  write(scratch / "sweep.toml", text);
  run_shell(in_folder(scratch, interrupted("KILL")));
}

TEST(SweepCommand, KilledAndGoneOnWithItGivesTheSameFile) {
  const Scratch whole;
  write(whole / "sweep.toml", long_sweep);
  const Outcome run = sweep_in(whole);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "a.nc: 400 servos, 0 solved side by side, 400 one by one\n");
  EXPECT_EQ(whole.file_count(), 2U);  // the sweep and its file: nothing is left of the parts

  const Scratch killed;
  write(killed / "sweep.toml", long_sweep);
  const Outcome kill = run_shell(in_folder(killed, interrupted("KILL")));
  EXPECT_THAT(kill.out, HasSubstr("status 137\n")) << kill.err;
  EXPECT_FALSE(std::filesystem::exists(killed / "a.nc"));
  const Outcome anew = sweep_in(killed);
  EXPECT_EQ(anew.status, 2);
  EXPECT_THAT(anew.err, HasSubstr("--output = a.nc: must have no unfinished sweep beside it"));
  const Outcome resumed = sweep_in(killed, "--resume");
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_EQ(resumed.out, run.out);
  EXPECT_EQ(killed.file_count(), 2U);
  EXPECT_TRUE(file_text(killed / "a.nc") == file_text(whole / "a.nc"));
}

TEST(SweepCommand, CtrlCKeepsWhatIsDone) {
  const Scratch scratch;
  write(scratch / "sweep.toml", long_sweep);
  // In the background a shell has SIGINT ignored.
  const Outcome run = run_shell(in_folder(scratch, interrupted("TERM")));
  EXPECT_THAT(run.out, HasSubstr("status 143\n")) << run.err;
  EXPECT_THAT(run.err, HasSubstr(" of 400 points, saved in a.nc.part; --resume continues\n"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.nc"));
  const auto record = nlohmann::json::parse(file_text(scratch / "a.nc.part.json"));
  EXPECT_GT(record["points_done"], 0);
  EXPECT_LT(record["points_done"], 400);
}

/// Stopped at once, as a rule before its first piece is done.
TEST(SweepCommand, WhatItSaysOfItsFilesIsTrueWheneverItIsStopped) {
  const Scratch scratch;
  write(scratch / "sweep.toml", long_sweep);
  const Outcome run =
      run_shell(in_folder(scratch,
                          "\"$GEARLASH\" sweep sweep.toml --output a.nc & tool=$!\n"
                          "until [ -e a.nc.part.json ] || ! kill -0 $tool; do :; done\n"
                          "kill -TERM $tool; wait $tool; echo status $?; ls\n"));
  EXPECT_THAT(run.out, HasSubstr("status 143\n")) << run.err;
  const bool has_files = std::filesystem::exists(scratch / "a.nc.part");
  EXPECT_EQ(std::filesystem::exists(scratch / "a.nc.part.json"), has_files);
  EXPECT_THAT(run.err,
              HasSubstr(has_files ? " of 400 points, saved in a.nc.part; --resume"
                                  : "stopped before the first of 400 points: there is nothing "
                                    "to resume\n"));
}

TEST(SweepCommand, ResumesOnlyTheSameSweep) {
  const Scratch scratch;
  leave_unfinished(scratch);
  write(scratch / "sweep.toml", std::string(long_sweep) + "backlash = 2\n");
  EXPECT_EQ(sweep_in(scratch, "--resume").err,
            "gearlash: --resume = a.nc.part and a.nc.part.json: must be of the same sweep file; "
            "remove both to start again\n");
}

TEST(SweepCommand, FilesOfOthersAreRefusedAndLeftAlone) {
  for (const std::string name : {"a.nc.part", "a.nc.part.json"}) {
    for (const std::string contents : {"not ours", "{}", "{\"kind\": 1}"}) {
      const Scratch scratch;
      write(scratch / "sweep.toml", long_sweep);
      write(scratch / name, contents);
      for (const char* options : {"", "--resume"}) {
        const Outcome run = sweep_in(scratch, options);
        EXPECT_EQ(run.status, 2);
        EXPECT_EQ(run.err,
                  "gearlash: --output = a.nc: must have no foreign file beside it: " + name +
                      " does not come from a sweep and is not touched; rename or remove it\n");
        EXPECT_EQ(file_text(scratch / name), contents);
        EXPECT_EQ(scratch.file_count(), 2U);
      }
    }
  }
}

TEST(SweepCommand, ASymbolicLinkIsNotFollowed) {
  for (const char* name : {"a.nc.part", "a.nc.part.json"}) {
    const Scratch scratch;
    write(scratch / "sweep.toml", long_sweep);
    write(scratch / "precious", "precious");
    std::filesystem::create_symlink("precious", scratch / name);
    EXPECT_EQ(sweep_in(scratch).status, 2);
    EXPECT_EQ(sweep_in(scratch, "--resume").status, 2);
    EXPECT_EQ(file_text(scratch / "precious"), "precious");
    EXPECT_TRUE(std::filesystem::is_symlink(scratch / name));
    EXPECT_EQ(scratch.file_count(), 3U);
  }
}

TEST(SweepCommand, ItsInputIsNoUnfinishedFile) {
  const Scratch scratch;
  for (const std::string name : {"a.nc.part", "a.nc.part.json"}) {
    write(scratch / name, long_sweep);
    const Outcome run =
        run_shell(in_folder(scratch, "\"$GEARLASH\" sweep " + name + " --output ./a.nc"));
    EXPECT_EQ(run.status, 2);
    EXPECT_THAT(run.err, HasSubstr("--output, while unfinished = "));
    EXPECT_THAT(run.err, HasSubstr(": must not be the file of SWEEP.toml, " + name + "\n"));
    EXPECT_EQ(file_text(scratch / name), long_sweep);
    std::filesystem::remove(scratch / name);
  }
}

/// Restitution from 0.3 on in place of 0.1: values of the same kind, all others.
TEST(SweepCommand, DataOfAnotherSweepAreNotGoneOnWith) {
  const Scratch scratch;
  const Scratch other;
  leave_unfinished(scratch);
  std::string text = long_sweep;
  text.replace(text.find("0.1:0.3:5"), 9, "0.3:0.5:5");
  leave_unfinished(other, text);
  std::filesystem::copy_file(other / "a.nc.part", scratch / "a.nc.part",
                             std::filesystem::copy_options::overwrite_existing);
  const Outcome run = sweep_in(scratch, "--resume");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "gearlash: --resume = a.nc.part and a.nc.part.json: must be the complete files of an "
            "unfinished sweep; remove both to start again\n");
}

TEST(SweepCommand, AFlippedBitIsSeen) {
  const Scratch scratch;
  leave_unfinished(scratch);
  std::string data = file_text(scratch / "a.nc.part");
  const std::string record = file_text(scratch / "a.nc.part.json");
  // Growth at rest of the first servo, in the last bit: what a resumed run finds for it.
  const Outcome dump = run_shell(
      in_folder(scratch,
                "cp a.nc.part b.nc; /usr/bin/python3 -c \"import xarray; "
                "print(xarray.open_dataset('b.nc')['growth_at_rest'].values.flat[0].hex())\""));
  ASSERT_EQ(dump.status, 0) << dump.err;
  const double growth = std::strtod(dump.out.c_str(), nullptr);
  std::string bytes(sizeof(growth), '\0');
  std::memcpy(bytes.data(), &growth, sizeof(growth));
  std::reverse(bytes.begin(), bytes.end());  // the most significant byte is the first in the file
  const std::size_t first = data.find(bytes);
  ASSERT_NE(first, std::string::npos);
  const std::size_t place = first + sizeof(growth) - 1;
  data[place] = static_cast<char>(data[place] ^ 1);
  write(scratch / "a.nc.part", data);
  const Outcome run = sweep_in(scratch, "--resume");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "gearlash: --resume = a.nc.part and a.nc.part.json: must be unchanged since the sweep "
            "stopped; "
            "remove both to start again\n");
  data[place] = static_cast<char>(data[place] ^ 1);
  write(scratch / "a.nc.part", data);
  EXPECT_EQ(file_text(scratch / "a.nc.part.json"), record);
  EXPECT_EQ(sweep_in(scratch, "--resume").status, 0);
}

TEST(SweepCommand, AnEditedRecordIsRefused) {
  const Scratch scratch;
  leave_unfinished(scratch);
  const std::string written = file_text(scratch / "a.nc.part.json");
  const auto record = nlohmann::ordered_json::parse(written);
  const int done = record["points_done"];
  for (const int points : {-5, 401, done - 2}) {
    auto other = record;
    other["points_done"] = points;
    other["one_by_one"] = points;
    write(scratch / "a.nc.part.json", other.dump());
    const Outcome run = sweep_in(scratch, "--resume");
    EXPECT_EQ(run.status, 2) << points;
    EXPECT_THAT(run.err, HasSubstr("must be unchanged since the sweep stopped; remove both"));
  }
  write(scratch / "a.nc.part.json", written);
  write(scratch / "a.nc.part", "garbage");
  const Outcome run = sweep_in(scratch, "--resume");
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err,
            "gearlash: --resume = a.nc.part and a.nc.part.json: must be the complete files of an "
            "unfinished sweep; remove both to start again\n");
}

/// One is left when the program is killed after the finished file was given its name, or where only
/// the data were removed.
TEST(SweepCommand, TheRecordOfAnEarlierSweepIsNotTakenForThatOfANewOne) {
  const Scratch scratch;
  leave_unfinished(scratch);
  std::filesystem::remove(scratch / "a.nc.part");
  // The new sweep can make its data, and cannot make a record of its own.
  const Outcome run = run_shell(
      in_folder(scratch, "ulimit -f 1; \"$GEARLASH\" sweep sweep.toml --output a.nc --resume"));
  EXPECT_EQ(run.status, 3);
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.nc.part.json"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.nc.part"));
}

TEST(SweepCommand, OnlyOneOfTwoAtTheSameTimeWritesTheFile) {
  const Scratch scratch;
  write(scratch / "sweep.toml", long_sweep);
  const std::string one = "\"$GEARLASH\" sweep sweep.toml --output a.nc --resume >/dev/null & ";
  const Outcome run =
      run_shell(in_folder(scratch, one + "first=$!; " + one +
                                       "second=$!; wait $first; echo $?; wait $second; echo $?; "
                                       "ncdump -h a.nc | head -n 1"));
  EXPECT_THAT(run.out, testing::AnyOf(HasSubstr("0\n2\n"), HasSubstr("2\n0\n"))) << run.err;
  EXPECT_THAT(run.out, HasSubstr("netcdf a {\n"));
  EXPECT_EQ(run.err,
            "gearlash: --output = a.nc: must not be written by another sweep at the same time\n");
  EXPECT_EQ(scratch.file_count(), 2U);
}

TEST(SweepCommand, NeedsARegularFile) {
  const Scratch scratch;
  write(scratch / "sweep.toml", long_sweep);
  std::filesystem::create_directory(scratch / "a.nc");
  const std::string sweep = "\"$GEARLASH\" sweep sweep.toml --output ";
  EXPECT_EQ(run_shell(in_folder(scratch, sweep + "a.nc")).err,
            "gearlash: --output = a.nc: must be a file that can be written (Is a directory)\n");
  EXPECT_EQ(run_shell(in_folder(scratch, "mkfifo b.nc; " + sweep + "b.nc")).err,
            "gearlash: --output = b.nc: must be a regular file, or a new one\n");
  EXPECT_THAT(run_shell(in_folder(scratch, sweep + std::string(255, 'a') + ".nc")).err,
              HasSubstr("must be a file that can be written (File name too long)\n"));
}

TEST(SweepCommand, FaultsOfFileAndOptionsAreToldTogether) {
  const Scratch scratch;
  write(scratch / "sweep.toml", "[sweep]\naxes = [\"damping=0.6:0.1:5\", 3]\n");
  const Outcome run =
      run_shell(in_folder(scratch, "\"$GEARLASH\" sweep sweep.toml --output a.txt"));
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("gearlash: sweep.toml:2:9: sweep.axes[0] = damping=0.6:0.1:5: "));
  EXPECT_THAT(run.err, HasSubstr("--output = a.txt: must end in .nc"));
  EXPECT_EQ(scratch.file_count(), 1U);
}

TEST(SweepCommand, TellsBeforehandThatTheDiskIsTooSmall) {
  const Scratch scratch;
  if (std::filesystem::space(scratch / "").available > 113'000'000'000) {
    GTEST_SKIP() << "the disk has room for the largest sweep of 14 quantities";
  }
  write(scratch / "sweep.toml",
        "[sweep]\naxes = [\"damping=0.1:0.6:1000000\", \"friction-ratio=0:1:1000\"]\n"
        "[servo]\ninertia_ratio = 1\n");
  const Outcome run = sweep_in(scratch);
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("a.nc: cannot be written: needs 113 GB, "));
  EXPECT_EQ(scratch.file_count(), 1U);
}

TEST(SweepCommand, AFullDiskKeepsWhatIsDone) {
  const Scratch scratch;
  write(scratch / "sweep.toml",
        "[sweep]\naxes = [\"damping=0.1:0.6:100\", \"friction-ratio=0.1:0.9:1000\"]\n"
        "[servo]\ninertia_ratio = 1\n");
  const Outcome run =
      run_shell(in_folder(scratch, "ulimit -f 1000; \"$GEARLASH\" sweep sweep.toml --output a.nc"));
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(run.err, "gearlash: a.nc: cannot be written: File too large\n");
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.nc"));
  const Outcome again = sweep_in(scratch, "--resume");
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(scratch.file_count(), 2U);
}

}  // namespace
}  // namespace gearlash::sweep_command_test
