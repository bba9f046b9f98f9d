// Runs the built program as a user's shell does.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace gearlash::test {

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline std::string quoted(const std::string& argument) {
  std::string text = "'";
  for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// An empty folder of its own for each test, gone afterwards.
class Scratch {
 public:
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "gearlash-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t file_count() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      static_cast<void>(entry);
      ++count;
    }
    return count;
  }

 private:
  std::filesystem::path path_;
};

struct Outcome {
  int status = -1;  ///< exit status; 128 + the signal that ended it
  std::string out;
  std::string err;
};

/// The built program, or another one for the seeded faults.
inline std::string tool_path() {
  const char* const other = std::getenv("GEARLASH_TOOL");
  return other != nullptr ? other : GEARLASH_TOOL;
}

/// A line for bash, in which $GEARLASH is the program. The tests' own locale and terminal have no
/// influence.
inline Outcome run_shell(const std::string& line) {
  const Scratch scratch;
  std::ofstream(scratch / "line") << "GEARLASH=" << quoted(tool_path()) << "\n" << line << "\n";
  const std::string command = "cd " + quoted(GEARLASH_SOURCE_DIRECTORY) +
                              " && LC_ALL=C.UTF-8 TERM=dumb env -u COLUMNS bash " +
                              quoted((scratch / "line").string()) + " >" +
                              quoted((scratch / "out").string()) + " 2>" +
                              quoted((scratch / "err").string()) + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          file_text(scratch / "out"), file_text(scratch / "err")};
}

inline Outcome run_tool(const std::vector<std::string>& arguments) {
  std::string line = "exec \"$GEARLASH\"";
  for (const std::string& argument : arguments) line += " " + quoted(argument);
  return run_shell(line);
}

/// Sanitizers reserve terabytes of addresses, so that `ulimit -v` ends the program at its start.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool may_limit_memory = false;
#elif defined(__has_feature)
inline constexpr bool may_limit_memory =
    !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
inline constexpr bool may_limit_memory = true;
#endif

/// The options of the thesis's sample problem as its charts are entered.
inline std::vector<std::string> with_sample_servo(std::vector<std::string> arguments) {
  for (const char* option : {"--damping", "0.19", "--inertia-ratio", "2", "--friction-ratio",
                             "1/10", "--backlash", "0.3"}) {
    arguments.emplace_back(option);
  }
  return arguments;
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace gearlash::test
