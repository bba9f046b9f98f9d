// Every limit on orders, tables and counts: what exceeds it is refused by field, value and what is
// permitted, and docs/reference/command-line.md lists it.
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tool.hpp"

namespace gearlash::limits_test {
namespace {

using test::file_text;
using test::lines_of;
using test::Outcome;
using test::run_tool;
using test::Scratch;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* mechanics = R"([motor]
kind = "torque-controlled"
inertia = "2 kg cm2"
friction = "0.1 mN m s/rad"
[gearbox]
ratio = 50
backlash = "12 arcmin"
[load]
inertia = "0.02 kg m2"
friction = "0.01 N m s/rad"
)";

constexpr const char* proportional = "[controller]\nkind = \"P\"\nproportional = \"1 N m/rad\"\n";

/// "[1.0, 1.0]".
std::string list_of(const std::string& element, int count) {
  std::string text = "[";
  for (int i = 0; i < count; ++i) text += (i > 0 ? ", " : "") + element;
  return text + "]";
}

/// The section "Limits" of the page, without the commas within numbers.
std::string page_of_limits() {
  const std::string page = file_text(GEARLASH_SOURCE_DIRECTORY "/docs/reference/command-line.md");
  const std::size_t begin = page.find("\n## Limits\n");
  EXPECT_NE(begin, std::string::npos);
  std::string text = page.substr(begin, page.find("\n## ", begin + 1) - begin);
  std::erase(text, ',');
  return text;
}

class Limits : public testing::Test {
 protected:
  std::string file(const std::string& text, const std::string& name = "drive.toml") {
    std::ofstream(scratch_ / name) << text;
    return (scratch_ / name).string();
  }
  std::string drive(const std::string& more) { return file(mechanics + more); }
  std::string output(const std::string& name) { return (scratch_ / name).string(); }

  /// One fault, which ends so, and a number that the page has.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& fault,
                      const std::string& limit) {
    SCOPED_TRACE(fault);
    const Outcome run = run_tool(arguments);
    EXPECT_EQ(run.status, 2) << run.out.substr(0, 200);
    EXPECT_THAT(lines_of(run.err), ElementsAre(HasSubstr(fault)));
    EXPECT_THAT(page_, HasSubstr(limit));
  }

  Scratch scratch_;
  const std::string page_ = page_of_limits();
};

TEST_F(Limits, OfFiles) {
  const std::string comments(1'048'577, '#');
  expect_refused({"show", file(comments)}, "must be at most 1048576 bytes long", "1048576 bytes");
  expect_refused({"sweep", file(comments), "--output", output("a.nc")},
                 "must be at most 1048576 bytes long", "1048576 bytes");
  const Outcome piped = test::run_shell("\"$GEARLASH\" show - < " + test::quoted(file(comments)));
  EXPECT_THAT(piped.err, HasSubstr("must be a data sheet of at most 1048576 bytes"));
  expect_refused({"show", file("[servo]\ndamping = " + std::string(300, '['))}, "depth of 256",
                 "256");
  expect_refused(
      {"show", drive(proportional), "--set", "gearbox.backlash=1 " + std::string(101, 'm')},
      "gearbox.backlash = 1 mmm", "100 bytes");
}

TEST_F(Limits, OfTheListOfFaults) {
  std::string text = mechanics + std::string(proportional);
  for (int i = 0; i < 200; ++i) text += "unknown_" + std::to_string(i) + " = 1\n";
  const Outcome run = run_tool({"show", file(text)});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(lines_of(run.err).size(), 101U);
  EXPECT_THAT(lines_of(run.err).back(), HasSubstr("and 100 more"));
  EXPECT_THAT(page_, HasSubstr("| 100 |"));
}

TEST_F(Limits, OfControllers) {
  const std::string permitted = "must be of order at most 64 (order 65)";
  const std::string transfer =
      "[controller]\nkind = \"transfer-function\"\ngain = \"1 N m/rad\"\nnum = [1.0]\nden = ";
  const std::string of_continuous = transfer + list_of("1.0", 66) + "\nvariable = \"s\"\n";
  const std::string of_sampled =
      transfer + list_of("1.0", 66) + "\nvariable = \"z\"\n[sampling]\nperiod = \"1 ms\"\n";
  expect_refused({"show", drive(of_continuous)}, "controller.den = [1.0, 1.0, ", "64");
  expect_refused({"show", drive(of_continuous)}, permitted, "64");
  expect_refused({"show", drive(of_sampled)}, permitted, "64");
  expect_refused({"show", drive("[controller]\nkind = \"state-space\"\ngain = \"1 N m/rad\"\nA = " +
                                list_of(list_of("0.0", 65), 65) + "\nB = " + list_of("[1.0]", 65) +
                                "\nC = " + list_of("1.0", 65) + "\nD = [0.0]\n")},
                 permitted, "64");
  // Read to its end before anything is computed with it.
  expect_refused({"show", drive(transfer + list_of("1.0", 100'000) + "\nvariable = \"s\"\n")},
                 "must be of order at most 64 (order 99999)", "64");
  const std::string sampled = drive(std::string(proportional) + "[sampling]\nperiod = \"1 ms\"\n");
  expect_refused({"show", sampled, "--set", "sampling.delay=101 ms"},
                 "sampling.delay = 101 ms: must be from 0 to 100 periods, 0.1 s", "100 periods");
}

TEST_F(Limits, OfEncoders) {
  const std::string sampled = drive(std::string(proportional) + "[sampling]\nperiod = \"1 ms\"\n");
  for (const std::string key : {"sensor.counts_per_turn", "sensor.speed_counts_per_turn"}) {
    expect_refused({"show", sampled, "--set", key + "=1099511627777"},
                   key + " = 1099511627777: must be at most 1099511627776, 40 bit",
                   "1099511627776");
    EXPECT_EQ(run_tool({"show", sampled, "--set", key + "=1099511627776"}).status, 0);
  }
  for (const std::string key : {"sensor.resolution", "sensor.speed_resolution"}) {
    expect_refused({"show", sampled, "--set", key + "=1e-12 rad"},
                   key + " = 1e-12 rad: must be 0 or at least 5.7", "40 bit");
  }
}

TEST_F(Limits, OfTables) {
  const std::string with_table =
      drive(std::string(proportional) + "[reference]\nkind = \"table\"\nfile = \"move.csv\"\n");
  std::filesystem::resize_file(file("", "move.csv"), 64U * 1024U * 1024U + 1U);
  expect_refused({"show", with_table}, "must be at most 67108864 bytes long", "67108864 bytes");
  std::ostringstream rows;
  rows << "time (s), position (deg)\n";
  for (int i = 0; i <= 1'000'000; ++i) rows << i << ",1\n";
  file(rows.str(), "move.csv");
  expect_refused({"show", with_table}, "must have at most 1000000 rows", "1000000 rows");
}

TEST_F(Limits, OfAxesAndGrids) {
  const std::vector<std::string> chart = {"chart",    "--friction-ratio", "0.2",
                                          "--output", output("a.csv"),    "--x"};
  const auto with = [](std::vector<std::string> all, const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  expect_refused(with(chart, {"damping=0.1:0.6:1000001", "--inertia-ratio", "1"}),
                 "--x = 1000001 values: must be from 1 to 1000000", "1000000");
  expect_refused(
      with(chart, {"damping=0.1:0.6:1000000", "--curves", "inertia-ratio=1:9:11"}),
      "points = 11000000: must be at most 10000000 on both axes together; gearlash sweep has room "
      "for more",
      "10000000");
  expect_refused({"map", "--x", "damping=0.1:0.6:4000", "--y", "friction-ratio=0.1:0.5:4000",
                  "--inertia-ratio", "1", "--output", output("a.csv")},
                 "points = 16000000: must be at most 10000000", "10000000");
  expect_refused({"chart", "--x", "damping=0.1:0.6:10", "--curves", "inertia-ratio=1:9:17",
                  "--friction-ratio", "0.2", "--plot", "curves=" + output("a.svg")},
                 "--curves = 17 values: must be at most 16 in a picture", "16");
  const std::string servo = "[servo]\nfriction_ratio = 0.1\nbacklash = \"1 rad\"\n";
  expect_refused({"sweep",
                  file("[sweep]\naxes = [\"damping=0.1:0.6:1000000\", "
                       "\"inertia-ratio=1:2:1000000\"]\n" +
                       servo),
                  "--output", output("a.nc")},
                 "points = 1e+12: must be at most 1e+09 on all axes together", "1000000000");
  expect_refused(
      {"sweep", file("[sweep]\naxes = " + list_of("\"damping=0.1:0.6:2\"", 7) + "\n" + servo),
       "--output", output("a.nc")},
      "sweep.axes[6] = damping=0.1:0.6:2: must be at most 6 axes", "6");
}

TEST_F(Limits, OfCountsOnTheCommandLine) {
  const std::string sheet = "examples/toleranced.toml";
  expect_refused({"tolerance", sheet, "--samples", "16777217"},
                 "--samples = 16777217: must be a whole number from 32 to 16777216", "16777216");
  expect_refused({"tolerance", sheet, "--samples", "31"}, "must be a whole number from 32", "32");
  expect_refused({"tolerance", sheet, "--seed", "9007199254740993"},
                 "--seed = 9007199254740993: must be a whole number from 0 to 9007199254740992",
                 "9007199254740992");
  expect_refused({"thesis", "machine", "--trace", "1000001"},
                 "--trace = 1000001: must be a whole number from 1 to 1000000", "1000000");
  expect_refused({"simulate", sheet, "--until", "1", "--every", "1e-8"},
                 "--every = 1e-08: must be more than 1e-07 s: at most 1e+07 samples in 1 s",
                 "10000000");
  expect_refused({"simulate", "examples/normalized.toml", "--until", "1e9"},
                 "--until = 1e9: must be at most ", "10⁹");
  expect_refused({"simulate", "examples/normalized.toml", "--until", "1e4", "--plot",
                  "time=" + output("a.svg")},
                 "--until = ", "20000 events");
}

/// What a motion needs grows with its events and steps: it stops, and says so.
TEST_F(Limits, OfMotionsStopThem) {
  const Outcome by_events = run_tool(
      {"simulate", "examples/robot-joint.toml", "--until", "1e9", "--output", output("a.csv")});
  EXPECT_EQ(by_events.status, 1);
  EXPECT_THAT(by_events.err, HasSubstr(" of 1e+09 s: after 1000000 events"));
  EXPECT_THAT(page_, HasSubstr("1000000 events"));
  // Faces that a torque keeps together: nothing ever happens.
  const std::string quiet =
      drive(std::string(proportional) + "[sensor]\nposition = \"motor\"\n" +
            "[load_torque]\nkind = \"sine\"\nmean = \"10 N m\"\namplitude = \"1 N m\"\n"
            "frequency = \"1 Hz\"\n");
  const Outcome by_steps =
      run_tool({"simulate", quiet, "--until", "1e9", "--output", output("b.csv")});
  EXPECT_EQ(by_steps.status, 1);
  EXPECT_THAT(by_steps.err, HasSubstr(" of 1e+09 s: after 4000000 steps"));
  EXPECT_THAT(page_, HasSubstr("4000000 steps"));
}

}  // namespace
}  // namespace gearlash::limits_test
