#include "picture/gnuplot.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "input/units.hpp"
#include "output/output_file.hpp"

extern char** environ;

namespace gearlash {
namespace {

[[noreturn]] void refuse(const std::string& reason) { throw OutputError("gnuplot: " + reason); }

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }  // NOLINT: owned by unique_ptr
};
using NamelessFile = std::unique_ptr<std::FILE, FileCloser>;

NamelessFile nameless_file() {
  NamelessFile file(std::tmpfile());
  if (!file) refuse("no temporary file: " + std::generic_category().message(errno));
  return file;
}

void fill(std::FILE* file, const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fflush(file) != 0) {
    refuse("its script cannot be written: " + std::generic_category().message(errno));
  }
  std::rewind(file);
}

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string text;
  std::vector<char> block(std::size_t{1} << 16U);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file)) {
    text.append(block.data(), count);
  }
  return text;
}

/// This program's environment without what changes gnuplot's pictures or words.
std::vector<std::string> plain_environment() {
  std::vector<std::string> variables = {"LC_ALL=C.UTF-8"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const bool matters = text.starts_with("LC_") || text.starts_with("LANG") ||
                         text.starts_with("GNUTERM") || text.starts_with("GNUPLOT");
    if (!matters) variables.emplace_back(text);
  }
  return variables;
}

/// Redirections and signals of the child; the child must die of a closed pipe as usual.
class SpawnSetup {
 public:
  SpawnSetup(std::FILE* in, std::FILE* out, std::FILE* messages) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, fileno(in), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(out), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, fileno(messages), STDERR_FILENO);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &defaults);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnSetup() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

int exit_status_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) refuse("lost: " + std::generic_category().message(errno));
  }
  return status;
}

int spawn_and_wait(std::FILE* in, std::FILE* out, std::FILE* messages) {
  const SpawnSetup setup(in, out, messages);
  std::vector<std::string> variables = plain_environment();
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  std::string program = "gnuplot";
  std::string ignore_user_settings = "-d";
  std::string from_standard_input = "-";
  char* const arguments[] = {program.data(), ignore_user_settings.data(),
                             from_standard_input.data(), nullptr};
  pid_t process = 0;
  const int error = posix_spawnp(&process, program.c_str(), &setup.actions, &setup.attributes,
                                 arguments, environment.data());
  if (error == ENOENT) {
    refuse("not found; pictures need it: apt-get install gnuplot-nox");
  }
  if (error != 0) refuse("cannot be started: " + std::generic_category().message(error));
  return exit_status_of(process);
}

}  // namespace

std::string run_gnuplot(const std::string& script) {
  const NamelessFile in = nameless_file();
  const NamelessFile out = nameless_file();
  const NamelessFile messages = nameless_file();
  fill(in.get(), script);
  const int status = spawn_and_wait(in.get(), out.get(), messages.get());
  std::string picture = contents(out.get());
  if (status != 0 || picture.empty()) {
    refuse("drew nothing: " + shown(contents(messages.get()), 200));
  }
  return picture;
}

}  // namespace gearlash
