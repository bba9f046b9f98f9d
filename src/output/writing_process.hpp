// A file that a child process writes, so that a library that crashes ends the child alone.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gearlash {

/// One end of the connection between two processes. Its members throw ConnectionLost if the other
/// process has gone.
class Connection {
 public:
  explicit Connection(int descriptor = -1) : descriptor_(descriptor) {}
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  Connection& operator=(Connection&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  /// The receiver knows the number of the values.
  template <class Value>
  void send_all(std::span<const Value> values) {
    send(std::as_bytes(values));
  }
  template <class Value>
  void receive_all(std::span<Value> values) {
    receive(std::as_writable_bytes(values));
  }
  template <class Value>
  void send_one(const Value& value) {
    send_all(std::span(&value, 1));
  }
  template <class Value>
  Value receive_one() {
    Value value{};
    receive_all(std::span(&value, 1));
    return value;
  }
  /// With its length.
  template <class Value>
  void send_list(std::span<const Value> values) {
    send_one(values.size());
    send_all(values);
  }
  template <class Value>
  std::vector<Value> receive_list() {
    std::vector<Value> values(receive_one<std::size_t>());
    receive_all(std::span(values));
    return values;
  }

 private:
  void send(std::span<const std::byte> bytes);
  void receive(std::span<std::byte> bytes);

  int descriptor_;
};

class ConnectionLost {};

/// What a child does with one request: it receives it, serves it, calls report_done(), and then
/// sends the answer if there is one.
using Server = std::function<void(Connection&)>;
void report_done(Connection& parent);

/// A child process that serves requests to write one file. It has the memory of this process as it
/// was at the beginning, none of its other threads, and neither its standard output nor its
/// standard error. SIGINT, SIGTERM and SIGHUP are for this process: the child takes none of them.
/// It ends with the thread that began it.
class WritingProcess {
 public:
  /// The child calls `begin`, whose result serves all requests. Throws what `begin` throws,
  /// OutputError or std::bad_alloc. Throws std::bad_alloc or std::system_error
  /// (resource_unavailable_try_again) if the machine cannot start a process, and OutputError if the
  /// child crashes. `shown_name` is the file's name in messages.
  WritingProcess(std::string shown_name, const std::function<Server()>& begin);
  /// Ends the child wherever it is.
  ~WritingProcess() { end(); }
  WritingProcess(const WritingProcess&) = delete;
  WritingProcess& operator=(const WritingProcess&) = delete;

  /// Sends a request, waits until it is served, and receives the answer. Throws what the server
  /// throws, OutputError or std::bad_alloc, and OutputError if the child crashes.
  void ask(
      const std::function<void(Connection&)>& send,
      const std::function<void(Connection&)>& receive = [](Connection&) {});

 private:
  void start(const std::function<Server()>& begin);
  void await();
  [[noreturn]] void report_end();
  void end() noexcept;

  std::string shown_name_;
  Connection child_;
  pid_t process_ = 0;  ///< 0: ended
};

/// Ends all children of this kind: none makes a file again that this process removes as it ends. It
/// is safe in a signal handler.
void end_writing_processes() noexcept;

}  // namespace gearlash
