#include "output/writing_process.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "output/file_safety.hpp"
#include "output/output_file.hpp"

namespace gearlash {
namespace {

/// For signal handlers, which neither allocate nor lock. 0: no process.
std::array<std::atomic<pid_t>, 8> writing_processes;

void replace_process(pid_t old_one, pid_t new_one) {
  for (std::atomic<pid_t>& process : writing_processes) {
    pid_t expected = old_one;
    if (process.compare_exchange_strong(expected, new_one)) return;
  }
}

/// The status of waitpid().
int status_at_end(pid_t process) noexcept {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string shown_end(int status) {
  if (!WIFSIGNALED(status)) return "with status " + std::to_string(WEXITSTATUS(status));
  return std::string("by a signal, ") + strsignal(WTERMSIG(status));
}

enum class ReplyKind : std::size_t { done, refused, no_memory, fault };

/// Followed by a text of this length.
struct Reply {
  ReplyKind kind;
  std::size_t length;
};

void send_reply(Connection& parent, ReplyKind kind, std::string_view text) {
  parent.send_one(Reply{kind, text.size()});
  parent.send_all(std::span(text));
}

[[noreturn]] void no_process() {
  if (errno == ENOMEM) throw std::bad_alloc();
  throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
}

/// A library that ends its program must not run the parent's destructors, which await threads that
/// the child does not have.
void end_at_exit() { _exit(EXIT_FAILURE); }

/// The child begins with the handlers and the descriptors of its parent. Signals stay held.
void leave_to_parent(pid_t parent) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (getppid() != parent) _exit(EXIT_FAILURE);
  for (std::atomic<pid_t>& process : writing_processes) process = 0;
  std::set_terminate(std::abort);
  std::atexit(end_at_exit);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere < 0) return;
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, standard);
}

void serve_requests(Connection& parent, const std::function<Server()>& begin) {
  try {
    const Server serve = begin();
    report_done(parent);
    while (true) serve(parent);
  } catch (const OutputError& error) {
    send_reply(parent, ReplyKind::refused, error.what());
  } catch (const std::bad_alloc&) {
    send_reply(parent, ReplyKind::no_memory, "");
  } catch (const std::exception& error) {
    send_reply(parent, ReplyKind::fault, error.what());
  }
  // The parent sends the rest of its request before it reads the reply.
  while (true) parent.receive_one<std::byte>();
}

[[noreturn]] void run_child(int descriptor, pid_t parent, const std::function<Server()>& begin) {
  leave_to_parent(parent);
  Connection connection(descriptor);
  try {
    serve_requests(connection, begin);
  } catch (const ConnectionLost&) {
  }
  _exit(EXIT_SUCCESS);
}

}  // namespace

Connection::~Connection() {
  if (descriptor_ >= 0) close(descriptor_);
}

void Connection::send(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) throw ConnectionLost();
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

void Connection::receive(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t received = recv(descriptor_, bytes.data(), bytes.size(), MSG_WAITALL);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) throw ConnectionLost();
    bytes = bytes.subspan(static_cast<std::size_t>(received));
  }
}

void report_done(Connection& parent) { send_reply(parent, ReplyKind::done, ""); }

WritingProcess::WritingProcess(std::string shown_name, const std::function<Server()>& begin)
    : shown_name_(std::move(shown_name)) {
  try {
    start(begin);
    ask([](Connection&) {});
  } catch (...) {  // the destructor will not run
    end();
    throw;
  }
}

void WritingProcess::start(const std::function<Server()>& begin) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) no_process();
  child_ = Connection(ends[0]);
  Connection parent(ends[1]);  // closed here once the child has it
  const SignalsHeld held;
  const pid_t this_process = getpid();
  process_ = fork();
  if (process_ < 0) no_process();
  if (process_ > 0) return replace_process(0, process_);
  child_ = Connection();
  run_child(ends[1], this_process, begin);
}

void WritingProcess::ask(const std::function<void(Connection&)>& send,
                         const std::function<void(Connection&)>& receive) {
  try {
    send(child_);
    await();
    receive(child_);
  } catch (const ConnectionLost&) {
    report_end();
  }
}

void WritingProcess::await() {
  const auto reply = child_.receive_one<Reply>();
  std::string text(reply.length, '\0');
  child_.receive_all(std::span(text));
  if (reply.kind == ReplyKind::refused) throw OutputError(text);
  if (reply.kind == ReplyKind::no_memory) throw std::bad_alloc();
  if (reply.kind == ReplyKind::fault) throw std::runtime_error(text);
}

void WritingProcess::report_end() {
  replace_process(process_, 0);
  const int status = status_at_end(std::exchange(process_, 0));
  throw OutputError(shown_name_ + ": cannot be written: the process that writes it ended " +
                    shown_end(status));
}

void WritingProcess::end() noexcept {
  if (process_ <= 0) return;
  replace_process(process_, 0);
  kill(process_, SIGKILL);
  status_at_end(std::exchange(process_, 0));
}

void end_writing_processes() noexcept {
  for (std::atomic<pid_t>& entry : writing_processes) {
    const pid_t process = entry.exchange(0);
    if (process <= 0) continue;
    kill(process, SIGKILL);
    status_at_end(process);
  }
}

}  // namespace gearlash
