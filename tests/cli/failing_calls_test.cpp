// Each call that a verb makes on its output file fails in turn, and so do allocations of the tool:
// no crash, nothing left behind, nothing cut, the right status, and the answer is printed.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <spawn.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include "tool.hpp"

namespace gearlash::failing_calls_test {
namespace {

namespace fs = std::filesystem;
using test::file_text;
using test::Scratch;
using testing::IsEmpty;

/// Those of preloaded/failing_call.cpp, in its order.
constexpr std::array kinds = {"open", "claim", "write", "fsync", "rename", "close", "allocate"};
constexpr std::size_t claiming = 1;
constexpr std::size_t allocating = 6;
using Counts = std::array<std::uint64_t, kinds.size()>;

struct Verb {
  std::vector<std::string> arguments;  ///< without the output, whose name follows the last one
  std::string output;
  bool has_answer = false;   ///< on standard output, besides what names the file
  std::string unfinished{};  ///< beginning of what may be left to be resumed
};

constexpr char joint[] = "examples/robot-joint.toml";
constexpr char servo[] = "examples/elinco-fd162.toml";

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {
      {{"simulate", servo, "--until", "0.5", "--output", ""}, "a.csv"},
      {{"simulate", servo, "--until", "0.5", "--format", "json", "--output", ""}, "a.json"},
      {{"limit-cycle", servo, "--plot", "phase="}, "a.svg", true},
      {{"describe", servo, "--plot", "nyquist="}, "a.svg", true},
      {{"compare", servo, "--sensor", "load", "--plot", "time="}, "a.svg", true},
      // No face of a side without inertia bounces.
      {{"design", servo, "--set", "load.inertia=0", "--target", "no-hunting", "--vary",
        "gearbox.ratio,load.friction", "--plot", "region="},
       "a.svg",
       true},
      {{"tune", joint, "--time-limit", "1 us", "--write", ""}, "a.toml", true},
      {{"tolerance", servo, "--set", "gearbox.backlash={ min = '0.05 rad', max = '0.15 rad' }",
        "--samples", "32", "--plot", "yield="},
       "a.svg",
       true},
      {{"chart", servo, "--x", "gearbox.ratio=1,2", "--output", ""}, "a.nc"},
      {{"map", servo, "--x", "gearbox.ratio=1,2", "--y", "gearbox.backlash=0.1,0.2", "--output",
        ""},
       "a.csv"},
      {{"map", servo, "--x", "gearbox.ratio=1,2", "--y", "gearbox.backlash=0.1,0.2", "--output",
        ""},
       "a.nc"},
      {{"sweep", "SWEEP", "--output", ""}, "a.nc", false, "a.nc.part"},
      {{"explore", servo, "--output", ""}, "a.html"},
      {{"thesis", "figure", "9", "--output", ""}, "a.svg"}};
  return all;
}

struct Run {
  int status = -1;  ///< 128 + the signal that ended it
  std::string out;
  std::string err;
  std::string file;              ///< the output's text
  std::set<std::string> others;  ///< other files beside it
  Counts counts{};
};

enum class Plotter : bool { real, stub };

/// The tool as it is installed, and a gnuplot that draws nothing. Made before there are threads: a
/// program that another one holds open cannot be run.
class Installation {
 public:
  Installation() {
    for (const char* folder : {"bin", "stub", "share/gearlash"}) {
      fs::create_directories(folder_ / folder);
    }
    fs::copy_file(test::tool_path(), folder_ / "bin/gearlash");
    std::ofstream(folder_ / "share/gearlash/explorer.html")
        << "<script id=\"user-drive\"></script>";
    std::ofstream(folder_ / "stub/gnuplot") << "#!/bin/sh\nread line\necho '<?xml picture</svg>'\n";
    fs::permissions(folder_ / "stub/gnuplot", fs::perms(0755));
    std::ofstream(folder_ / "sweep.toml") << "[sweep]\naxes = [\"damping=0.1:0.6:3\"]\n[servo]\n"
                                             "inertia_ratio = 2\nfriction_ratio = 0.1\n";
  }

  std::string in(const char* name) const { return (folder_ / name).string(); }

 private:
  Scratch folder_;
};

/// A program that runs one verb as often as it is asked to, in a folder of its own. It is started
/// once.
class Runner {
 public:
  Runner(const Verb& verb, const Installation& installation, Plotter plotter)
      : verb_(verb), installation_(installation) {
    std::ofstream(folder_ / "counts") << std::string(sizeof(Counts), '\0');
    std::array<int, 2> asking{};
    std::array<int, 2> answering{};
    if (pipe2(asking.data(), O_CLOEXEC) != 0 || pipe2(answering.data(), O_CLOEXEC) != 0) return;
    start(asking[0], answering[1], plotter);
    close(asking[0]);
    close(answering[1]);
    requests_ = asking[1];
    statuses_ = answering[0];
  }
  ~Runner() {
    close(requests_);  // at which the program ends
    close(statuses_);
    if (process_ > 0) waitpid(process_, nullptr, 0);
  }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// Call `number` of `kind` fails; none does if it is 0.
  Run operator()(std::uint64_t kind, std::uint64_t number) const {
    fs::remove_all(folder_ / "out");
    fs::create_directory(folder_ / "out");
    for (const char* file : {"printed", "messages"}) fs::resize_file(folder_ / file, 0);
    Run run;
    run.status = status_of(kind, number);
    run.out = file_text(folder_ / "printed");
    run.err = file_text(folder_ / "messages");
    run.file = file_text(folder_ / "out" / verb_.output);
    for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
      const std::string name = entry.path().filename().string();
      if (name != verb_.output) run.others.insert(name);
    }
    std::ifstream(folder_ / "counts", std::ios::binary)
        .read(reinterpret_cast<char*>(run.counts.data()), sizeof(Counts));
    return run;
  }

 private:
  void start(int requests, int statuses, Plotter plotter) {
    std::vector<std::string> arguments = {installation_.in("bin/gearlash")};
    for (const std::string& one : verb_.arguments) {
      arguments.push_back(one == "SWEEP" ? installation_.in("sweep.toml") : one);
    }
    arguments.back() += (folder_ / "out" / verb_.output).string();
    const std::string path = std::getenv("PATH");
    std::vector<std::string> environment = {
        "LC_ALL=C.UTF-8", "LD_PRELOAD=" GEARLASH_FAILING_CALL,
        "CALL_COUNTS=" + (folder_ / "counts").string(),
        "PATH=" + (plotter == Plotter::stub ? installation_.in("stub") + ":" + path : path)};
    std::vector<char*> argv;
    std::vector<char*> envp;
    for (std::string& one : arguments) argv.push_back(one.data());
    for (std::string& one : environment) envp.push_back(one.data());
    argv.push_back(nullptr);
    envp.push_back(nullptr);
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    const std::string printed = (folder_ / "printed").string();
    const std::string messages = (folder_ / "messages").string();
    constexpr int flags = O_WRONLY | O_CREAT | O_APPEND;
    posix_spawn_file_actions_adddup2(&files, requests, 0);
    posix_spawn_file_actions_adddup2(&files, statuses, 3);
    posix_spawn_file_actions_addopen(&files, 1, printed.c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&files, 2, messages.c_str(), flags, 0600);
    posix_spawn_file_actions_addchdir_np(&files, GEARLASH_SOURCE_DIRECTORY);
    posix_spawn(&process_, argv[0], &files, nullptr, argv.data(), envp.data());
    posix_spawn_file_actions_destroy(&files);
  }

  int status_of(std::uint64_t kind, std::uint64_t number) const {
    const std::array request = {kind, number};
    int status = -1;
    if (write(requests_, request.data(), sizeof request) != sizeof request) return -1;
    if (read(statuses_, &status, sizeof status) != sizeof status) return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  Scratch folder_;
  const Verb& verb_;
  const Installation& installation_;
  int requests_ = -1;
  int statuses_ = -1;
  pid_t process_ = 0;
};

/// The answer without the last line, which names the file, and which a file that failed lacks.
bool has_answer_of(const std::string& out, const std::string& whole) {
  return out.substr(0, 40) == whole.substr(0, 40);
}

/// What a run after a failed call did wrong; empty if nothing.
std::string wrong(const Verb& verb, const Run& run, const Run& whole, std::size_t kind,
                  bool must_answer) {
  const bool is_done = run.status == whole.status;
  const bool is_refused = kind == 0 && run.status == 2;  // found unwritable before the work
  if (!is_done && !is_refused && run.status != 3) return "status " + std::to_string(run.status);
  const std::string reason = kind == allocating ? "gearlash: " : "No space left on device\n";
  if (run.status == 3 && run.err.find(reason) == std::string::npos) return "no message";
  if (run.err.find("gearlash itself") != std::string::npos) return "a fault of gearlash itself";
  const bool is_whole = run.file == whole.file;
  if (is_done && !is_whole) return "another file, though it is said to be done";
  // Where memory did not suffice to print the answer, the picture is made all the same.
  const bool may_be_made = kind == allocating && is_whole && run.out.empty();
  if (!is_done && !run.file.empty() && !may_be_made) {
    return "a file, though it is said to have failed";
  }
  for (const std::string& other : run.others) {
    const bool is_resumed = !verb.unfinished.empty() && other.starts_with(verb.unfinished);
    if (!is_resumed || other[0] == '.') return other + " is left behind";
  }
  if (must_answer && !is_refused && !has_answer_of(run.out, whole.out)) return "no answer";
  return "";
}

class Tries {
 public:
  void of(const Verb& verb) {
    {
      const Runner runner(verb, installation_, Plotter::real);
      try_calls(verb, runner);
    }
    const Runner runner(verb, installation_, Plotter::stub);
    const Run whole = runner(0, 0);
    if (whole.status > 1 || whole.file.empty())
      return note(verb, 0, 0, "undisturbed: " + whole.err);
    try_allocations(verb, runner, whole);
  }

  const std::vector<std::string>& faults() const { return faults_; }
  const Counts& tried() const { return tried_; }

 private:
  void try_calls(const Verb& verb, const Runner& runner) {
    const Run whole = runner(0, 0);
    if (whole.status > 1 || whole.file.empty() || !whole.others.empty()) {
      return note(verb, 0, 0, "undisturbed: " + std::to_string(whole.status) + whole.err);
    }
    for (std::size_t kind = 0; kind < allocating; ++kind) {
      for (std::uint64_t number = 1; number <= whole.counts[kind]; ++number) {
        const Run run = runner(kind, number);
        note(verb, kind, number, wrong(verb, run, whole, kind, verb.has_answer));
      }
    }
  }

  void try_allocations(const Verb& verb, const Runner& runner, const Run& whole) {
    constexpr std::uint64_t first = 200;
    constexpr std::uint64_t sampled = first;
    std::minstd_rand draw(1);
    const std::uint64_t rest = whole.counts[allocating] - first;
    for (std::uint64_t i = 1; i <= first + sampled; ++i) {
      const std::uint64_t stratum = i > first ? (i - first - 1) * rest / sampled : 0;
      const std::uint64_t number =
          i <= first ? i
                     : first + 1 + stratum + draw() % std::max<std::uint64_t>(rest / sampled, 1);
      const Run run = runner(allocating, number);
      note(verb, allocating, number, wrong(verb, run, whole, allocating, false));
    }
  }

  void note(const Verb& verb, std::size_t kind, std::uint64_t number, const std::string& fault) {
    const std::lock_guard held(mutex_);
    ++tried_[kind];
    if (fault.empty()) return;
    faults_.push_back(verb.arguments[0] + " into " + verb.output + ", " + kinds[kind] + " " +
                      std::to_string(number) + ": " + fault);
  }

  Installation installation_;
  std::mutex mutex_;
  std::vector<std::string> faults_;
  Counts tried_{};
};

TEST(FailingCalls, OfAnyVerbThatWritesAreTold) {
  if (!test::may_limit_memory) GTEST_SKIP() << "sanitizers are not preloaded first";
  Tries tries;
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> threads(std::max(std::thread::hardware_concurrency(), 1U));
  for (std::thread& thread : threads) {
    thread = std::thread([&] {
      for (std::size_t i = next++; i < verbs().size(); i = next++) tries.of(verbs()[i]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(tries.faults(), IsEmpty());
  const auto writing_netcdf = static_cast<std::size_t>(std::count_if(
      verbs().begin(), verbs().end(), [](const Verb& verb) { return verb.output == "a.nc"; }));
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    RecordProperty(kinds[kind], static_cast<int>(tries.tried()[kind]));
    EXPECT_GE(tries.tried()[kind], kind == claiming ? writing_netcdf : verbs().size())
        << kinds[kind];
  }
}

}  // namespace
}  // namespace gearlash::failing_calls_test
