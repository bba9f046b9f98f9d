// gnuplot's exit status is 0 whatever became of its picture: only whole ones are taken.
#include "picture/gnuplot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include "gearlash/output.hpp"

namespace gearlash::gnuplot_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// An environment variable with another value until this ends.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

class Gnuplot : public testing::Test {
 protected:
  Gnuplot() {
    std::string name = (std::filesystem::temp_directory_path() / "gearlash-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Gnuplot() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  /// What run_gnuplot() says where a shell script stands for the program.
  std::string refusal_of(const std::string& script) const {
    std::ofstream(folder_ / "gnuplot") << "#!/bin/sh\n" << script;
    std::filesystem::permissions(folder_ / "gnuplot", std::filesystem::perms(0755));
    const Variable path("PATH", folder_.string() + ":" + std::getenv("PATH"));
    try {
      run_gnuplot("plot x\n", "title");
    } catch (const OutputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(Gnuplot, PartOfAPictureIsRefused) {
  for (const char* part : {R"('<?xml version="1.0"?>\n<svg><g></g>')", R"('%%PDF-1.5\n1 0 obj\n')",
                           R"('\211PNG\r\n\032\n\000\000')", "'no picture at all'"}) {
    EXPECT_THAT(refusal_of(std::string("printf ") + part),
                StartsWith("gnuplot: drew part of the picture alone"))
        << part;
  }
  EXPECT_EQ(refusal_of(R"(printf '<?xml version="1.0"?>\n<svg></svg>\n\n')"), "");
  EXPECT_EQ(refusal_of(R"(printf '%%PDF-1.5\n%%%%EOF\n')"), "");
}

TEST_F(Gnuplot, WhatItSaysIsTheReason) {
  EXPECT_EQ(refusal_of("echo no such font >&2; exit 1"), "gnuplot: drew nothing: no such font\\n");
  EXPECT_EQ(refusal_of("printf '<?xml'; echo disk full >&2"),
            "gnuplot: drew part of the picture alone: disk full\\n");
}

TEST_F(Gnuplot, ItsFilesAreInTheFolderForTemporaryOnes) {
  if (!std::filesystem::exists("/proc/self/fd")) GTEST_SKIP() << "needs /proc";
  const std::filesystem::path place = folder_ / "place";
  const Variable temporary("TMPDIR", folder_.string());
  EXPECT_THAT(refusal_of("readlink /proc/self/fd/0 > '" + place.string() + "'"),
              StartsWith("gnuplot: drew nothing"));
  std::ostringstream text;
  text << std::ifstream(place).rdbuf();
  EXPECT_THAT(text.str(), StartsWith(folder_.string() + "/"));
}

TEST_F(Gnuplot, AFolderThatIsNoneIsNamed) {
  const Variable temporary("TMPDIR", (folder_ / "missing").string());
  EXPECT_THAT(refusal_of("true"),
              StartsWith("gnuplot: no folder for temporary files, see TMPDIR: "));
}

TEST_F(Gnuplot, APdfHasNoTimeOfDay) {
  const std::string pdf =
      run_gnuplot("set terminal pdfcairo size 5cm,5cm\nset samples 2\nplot x\n", "title");
  EXPECT_THAT(pdf, StartsWith("%PDF-"));
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
  EXPECT_THAT(pdf, HasSubstr("/Producer"));
}

}  // namespace
}  // namespace gearlash::gnuplot_test
