// Files that appear whole or not at all.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "gearlash/output.hpp"

namespace gearlash::output_file_test {
namespace {

using testing::HasSubstr;

bool refuses_permissions = false;
std::vector<std::string> synced;  ///< what fsync was asked for

}  // namespace
}  // namespace gearlash::output_file_test

// In place of the system's own.
extern "C" int fchmod(int descriptor, mode_t mode) noexcept {
  if (!gearlash::output_file_test::refuses_permissions) {
    return static_cast<int>(syscall(SYS_fchmod, descriptor, mode));
  }
  errno = EPERM;
  return -1;
}

extern "C" int fsync(int descriptor) {
  struct stat file {};
  fstat(descriptor, &file);
  const bool has_a = faccessat(descriptor, "a", F_OK, 0) == 0;
  gearlash::output_file_test::synced.emplace_back(!S_ISDIR(file.st_mode) ? "file"
                                                  : has_a                ? "folder with a"
                                                                         : "folder");
  return static_cast<int>(syscall(SYS_fsync, descriptor));
}

namespace gearlash::output_file_test {
namespace {

class OutputFiles : public testing::Test {
 protected:
  OutputFiles() {
    std::string name = (std::filesystem::temp_directory_path() / "gearlash-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~OutputFiles() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string text(const std::string& name) const {
    std::ifstream stream(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  long count() const {
    return std::distance(std::filesystem::directory_iterator(folder_),
                         std::filesystem::directory_iterator());
  }

  std::filesystem::path folder_;
};

TEST_F(OutputFiles, NothingIsSeenUnderTheNameBeforeCommit) {
  OutputFile file(folder_ / "a");
  file.write(std::string(1'000'000, 'x'));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a"));
  file.write("y");
  file.commit();
  EXPECT_EQ(text("a"), std::string(1'000'000, 'x') + "y");
  EXPECT_EQ(count(), 1);
}

TEST_F(OutputFiles, WithoutCommitTheOldFileStays) {
  write_file(folder_ / "a", "old");
  {
    OutputFile file(folder_ / "a");
    file.write(std::string(1'000'000, 'x'));
    EXPECT_EQ(count(), 2);
  }
  EXPECT_EQ(text("a"), "old");
  EXPECT_EQ(count(), 1);
}

TEST_F(OutputFiles, UnfinishedOnesAreRemovedOnDemand) {
  OutputFile first(folder_ / "a");
  OutputFile second(folder_ / "b");
  EXPECT_EQ(count(), 2);
  remove_unfinished_outputs();
  EXPECT_EQ(count(), 0);
}

/// As SIGKILL leaves them: no process has them open.
TEST_F(OutputFiles, WhatAKilledProgramLeftIsRemovedByTheNext) {
  const auto make = [&](const char* name) { std::ofstream(folder_ / name) << "x"; };
  make(".a.gearlash-Abc123");
  make(".b.gearlash-Abc123");  // of another file
  make(".a.gearlash-notes");   // the user's own
  make(".a.backup");
  OutputFile under_way(folder_ / "a");
  EXPECT_EQ(count(), 4);
  write_file(folder_ / "a", "new");
  EXPECT_EQ(count(), 5) << "the file under way must stay";
  EXPECT_FALSE(std::filesystem::exists(folder_ / ".a.gearlash-Abc123"));
  under_way.write("newer");
  under_way.commit();
  EXPECT_EQ(text("a"), "newer");
  EXPECT_EQ(count(), 4);
}

TEST_F(OutputFiles, RefusedPermissionsLeaveNothing) {
  refuses_permissions = true;
  std::string refusal;
  for (int i = 0; i < 20; ++i) {  // nor is a place in the list of unfinished files lost
    try {
      write_file(folder_ / "a", "x");
    } catch (const OutputError& error) {
      refusal = error.what();
    }
  }
  refuses_permissions = false;
  EXPECT_THAT(refusal, HasSubstr("cannot be given its permissions: Operation not permitted"));
  EXPECT_EQ(count(), 0);
}

TEST_F(OutputFiles, TheFolderIsBroughtToTheDiskAfterTheFile) {
  synced.clear();
  write_file(folder_ / "a", "x");
  EXPECT_THAT(synced, testing::ElementsAre("file", "folder with a"));
}

TEST_F(OutputFiles, ManyInTurn) {
  for (int i = 0; i < 100; ++i) write_file(folder_ / "a", std::to_string(i));
  EXPECT_EQ(text("a"), "99");
}

TEST_F(OutputFiles, ANewFileHasTheUsersUsualPermissions) {
  const mode_t before = umask(027);
  write_file(folder_ / "a", "x");
  umask(before);
  EXPECT_EQ(std::filesystem::status(folder_ / "a").permissions(), std::filesystem::perms(0640));
}

TEST_F(OutputFiles, RefusalsNameFileAndReason) {
  const auto refusal = [](const std::filesystem::path& path) -> std::string {
    try {
      write_file(path, "x");
    } catch (const OutputError& error) {
      return error.what();
    }
    return "written";
  };
  EXPECT_THAT(refusal(folder_ / "no" / "a"), HasSubstr("no/a: cannot be written: No such file"));
  EXPECT_THAT(refusal(folder_), HasSubstr("Is a directory"));
  EXPECT_THAT(refusal("/dev/full"), HasSubstr("/dev/full: cannot be written: No space left"));
  EXPECT_THAT(refusal(folder_ / std::string(300, 'a')), HasSubstr("File name too long"));
  EXPECT_NE(refusal(""), "written");
}

TEST_F(OutputFiles, AClosedPipeIsToldFromAFault) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  int ends[2] = {};
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  EXPECT_THROW(write_file("/dev/fd/" + std::to_string(ends[1]), "x"), ReaderGone);
  close(ends[1]);
  std::signal(SIGPIPE, before);
}

}  // namespace
}  // namespace gearlash::output_file_test
