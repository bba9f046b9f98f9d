// A child process that serves requests, and whose end is an error of its parent.
#include "output/writing_process.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>

#include "output/output_file.hpp"

namespace gearlash::writing_process_test {
namespace {

using testing::HasSubstr;

/// What the server does with the number that it is sent.
Server serving(const std::function<void(int)>& work) {
  return [work](Connection& parent) {
    const int number = parent.receive_one<int>();
    work(number);
    report_done(parent);
    parent.send_one(2 * number);
  };
}

int asked(WritingProcess& process, int number) {
  int answer = 0;
  process.ask([&](Connection& child) { child.send_one(number); },
              [&](Connection& child) { answer = child.receive_one<int>(); });
  return answer;
}

std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

TEST(WritingProcess, ServesOneRequestAfterAnother) {
  WritingProcess process("a.nc", [] { return serving([](int) {}); });
  for (int i = 0; i < 100; ++i) EXPECT_EQ(asked(process, i), 2 * i);
}

TEST(WritingProcess, ThrowsWhatTheServerThrows) {
  WritingProcess refusing("a.nc", [] {
    return serving([](int number) {
      if (number == 1) throw OutputError("a.nc: cannot be written: " + std::string(10, 'x'));
    });
  });
  EXPECT_EQ(asked(refusing, 0), 0);
  EXPECT_EQ(error_of([&] { asked(refusing, 1); }), "a.nc: cannot be written: xxxxxxxxxx");
  WritingProcess poor("a.nc", [] { return serving([](int) { throw std::bad_alloc(); }); });
  EXPECT_THROW(asked(poor, 0), std::bad_alloc);
  EXPECT_THROW(WritingProcess("a.nc", []() -> Server { throw OutputError("no"); }), OutputError);
}

TEST(WritingProcess, AnEndOfTheChildIsAnError) {
  const auto ended_by = [](const std::function<void()>& end) {
    return error_of([&] {
      WritingProcess process("a.nc", [&] { return serving([&](int) { end(); }); });
      asked(process, 0);
    });
  };
  const std::string ended = "a.nc: cannot be written: the process that writes it ended ";
  EXPECT_EQ(ended_by([] { std::raise(SIGKILL); }), ended + "by a signal, Killed");
  EXPECT_EQ(ended_by([] { std::exit(255); }), ended + "with status 1");
  EXPECT_THAT(error_of([] { WritingProcess("a.nc", []() -> Server { _exit(7); }); }),
              HasSubstr("with status 7"));
}

TEST(WritingProcess, PrintsNothingAndTakesNoSignalOfItsParent) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    WritingProcess process("a.nc", [] {
      return serving([](int) {
        std::puts("from the library");
        std::fputs("from the library", stderr);
        std::fflush(nullptr);
        std::raise(SIGTERM);
        std::raise(SIGINT);
      });
    });
    EXPECT_EQ(asked(process, 4), 8);
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Whether the writing end of a pipe, which a child has inherited, is closed in the end.
TEST(WritingProcess, EndsWithItsParent) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    const WritingProcess process("a.nc", [] { return serving([](int) {}); });
    std::raise(SIGKILL);
  }
  close(ends[1]);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0);
  close(ends[0]);
  waitpid(parent, nullptr, 0);
}

TEST(WritingProcess, EndsBeforeItsFileIsRemoved) {
  WritingProcess process("a.nc", [] { return serving([](int) {}); });
  remove_unfinished_outputs();
  EXPECT_THAT(error_of([&] { asked(process, 1); }), HasSubstr("the process that writes it ended"));
}

}  // namespace
}  // namespace gearlash::writing_process_test
