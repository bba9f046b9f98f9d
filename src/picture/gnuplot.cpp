#include "picture/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
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
using File = std::unique_ptr<std::FILE, FileCloser>;

std::string system_message() { return std::generic_category().message(errno); }

/// Opens a nameless file in `folder`, so that nothing is left behind.
int open_nameless(const std::filesystem::path& folder) {
#ifdef O_TMPFILE
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (descriptor >= 0) return descriptor;
#endif
  std::string name = (folder / "gearlash-XXXXXX").string();
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) unlink(name.c_str());
  return named;
}

File nameless_file() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) refuse("no folder for temporary files, see TMPDIR: " + error.message());
  const int descriptor = open_nameless(folder);
  File file(descriptor < 0 ? nullptr : fdopen(descriptor, "w+"));
  if (!file) refuse("no temporary file in " + shown(folder.string()) + ": " + system_message());
  return file;
}

void fill(std::FILE* file, const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file) != text.size() || std::fflush(file) != 0) {
    refuse("its script cannot be written: " + system_message());
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
  if (std::ferror(file) != 0) refuse("its picture cannot be read: " + system_message());
  return text;
}

// ---- the program --------------------------------------------------------------------------------

/// This program's environment without the variables that change gnuplot's pictures or messages.
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

/// Redirections and signals of the child. A closed pipe must end the child as usual.
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
    if (errno != EINTR) refuse("lost: " + system_message());
  }
  return status;
}

pid_t spawn(std::FILE* in, std::FILE* out, std::FILE* messages) {
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
  return process;
}

// ---- the picture --------------------------------------------------------------------------------

/// Checks the picture's end, because gnuplot's exit status is 0 even if its output was lost.
bool is_whole(std::string_view picture) {
  while (picture.ends_with('\n')) picture.remove_suffix(1);
  if (picture.starts_with("<?xml")) return picture.ends_with("</svg>");
  if (picture.starts_with("%PDF-")) return picture.ends_with("%%EOF");
  return picture.starts_with("\x89PNG") && picture.ends_with("IEND\xAE\x42\x60\x82");
}

/// Overwrites the time of day, so that the same picture has the same bytes. Blanks keep the other
/// parts of a PDF at their offsets.
void blank_time_of_day(std::string& picture) {
  if (!picture.starts_with("%PDF-")) return;
  const std::size_t begin = picture.rfind("/CreationDate (D:");
  const std::size_t end = begin == std::string::npos ? begin : picture.find(')', begin);
  if (end != std::string::npos) picture.replace(begin, end + 1 - begin, end + 1 - begin, ' ');
}

std::string escaped_for_xml(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (static_cast<unsigned char>(c) >= 0x20) {
      safe += c;
    }
  }
  return safe;
}

void set_title(std::string& picture, const std::string& title) {
  constexpr std::string_view usual = "<title>Gnuplot</title>";
  const std::size_t place = picture.starts_with("<?xml") ? picture.find(usual) : std::string::npos;
  if (place == std::string::npos) return;
  picture.replace(place, usual.size(), "<title>" + escaped_for_xml(title) + "</title>");
}

}  // namespace

std::string run_gnuplot(const std::string& script, const std::string& title) {
  const File in = nameless_file();
  const File out = nameless_file();
  const File messages = nameless_file();
  fill(in.get(), script);
  const int status = exit_status_of(spawn(in.get(), out.get(), messages.get()));
  std::string picture = contents(out.get());
  const auto with_reason = [&](const std::string& fault) {
    const std::string said = contents(messages.get());
    return said.empty() ? fault : fault + ": " + shown(said, 200);
  };
  if (status != 0 || picture.empty()) refuse(with_reason("drew nothing"));
  if (!is_whole(picture)) refuse(with_reason("drew part of the picture alone"));
  blank_time_of_day(picture);
  set_title(picture, title);
  return picture;
}

}  // namespace gearlash
