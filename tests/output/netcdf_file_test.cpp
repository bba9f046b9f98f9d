// Files in NetCDF's classic format, as Python's netCDF4 reads them and as they are gone on with.
#include "output/netcdf_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "cli/tool.hpp"
#include "gearlash/output.hpp"
#include "output/grid_netcdf.hpp"

namespace gearlash::netcdf_file_test {
namespace {

using test::file_text;
using test::Scratch;
using testing::HasSubstr;

bool has_no_room_to_claim = false;

}  // namespace
}  // namespace gearlash::netcdf_file_test

// In place of the system's own.
extern "C" int fallocate(int descriptor, int mode, off_t offset, off_t size) {
  if (!gearlash::netcdf_file_test::has_no_room_to_claim) {
    return static_cast<int>(syscall(SYS_fallocate, descriptor, mode, offset, size));
  }
  errno = EOPNOTSUPP;
  return -1;
}

namespace gearlash::netcdf_file_test {
namespace {

/// A file, open as long as it lives.
class Opened {
 public:
  explicit Opened(const std::filesystem::path& path, int flags = O_RDWR | O_CREAT)
      : descriptor_(open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  explicit Opened(int descriptor) : descriptor_(descriptor) {}
  ~Opened() { close(descriptor_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  operator int() const { return descriptor_; }  // NOLINT(google-explicit-constructor)

 private:
  int descriptor_;
};

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "";
}

/// Two axes, of 3 and 5 values.
GridContents small_contents() {
  return {.grid = {.drive = normal_form(0.2, 1.0, 0.1, 1.0),
                   .axes = {spaced_axis("y", "servo.damping", 0.1, 0.3, 3, Spacing::linear),
                            spaced_axis("x", "servo.inertia_ratio", 0.5, 2.0, 5,
                                        Spacing::logarithmic)}},
          .quantities = {Quantity::growth_at_rest, Quantity::amplitude},
          .provenance = {"gearlash map", "1.0.0"}};
}

/// Rows from `first` on of an answer that has an infinity, a NaN and a subnormal number.
Table answers(std::size_t first, std::size_t rows) {
  const std::vector<Quantity> quantities = small_contents().quantities;
  Table table(rows, quantities);
  for (std::size_t row = 0; row < rows; ++row) {
    const auto number = static_cast<double>(first + row);
    table.column_of_verdicts()[row] = static_cast<Verdict>((first + row) % 5);
    table.column(quantities[0])[row] = first + row == 3 ? HUGE_VAL : 1.0 / (1.0 + number);
    table.column(quantities[1])[row] = first + row == 4 ? std::nan("") : -5e-324 * number;
  }
  return table;
}

void write_rows(GridNetcdf& file, std::size_t first, std::size_t rows) {
  file.write({first, answers(first, rows), {}});
}

/// The whole file with its target and its boundary, in pieces of `rows`.
std::string written_in(std::size_t rows) {
  const Scratch scratch;
  const Opened opened(scratch / "a.nc");
  GridNetcdf file = GridNetcdf::create(opened, "a.nc", small_contents());
  for (std::size_t first = 0; first < 15; first += rows) write_rows(file, first, rows);
  file.write_target(std::vector<PlaceKind>(15, PlaceKind::met));
  file.write_boundary({{{1.0, 0.1}, {2.0, 0.2}}, {{1.5, 0.3}}});
  return file_text(scratch / "a.nc");
}

TEST(NetcdfFile, IsTheSameHoweverItIsDivided) {
  const std::string whole = written_in(15);
  EXPECT_EQ(written_in(5), whole);
  EXPECT_EQ(written_in(1), whole);
  has_no_room_to_claim = true;  // by a file system that cannot claim any
  EXPECT_EQ(written_in(3), whole);
  has_no_room_to_claim = false;
}

/// The model of a.nc, an attribute of it and, of each variable `one`, what Python makes of `shown`.
test::Outcome read_by_python(const Scratch& scratch, const std::string& attribute,
                             const std::string& shown) {
  return test::run_shell(
      "/usr/bin/python3 -W ignore -c 'import netCDF4\n"
      "data = netCDF4.Dataset(\"" +
      (scratch / "a.nc").string() +
      "\")\n"
      "data.set_auto_mask(False)\n"
      "print(data.data_model, data." +
      attribute +
      ")\n"
      "for name, one in data.variables.items():\n"
      "  print(name, " +
      shown + ")'");
}

TEST(NetcdfFile, IsReadBackAndByPython) {
  const Scratch scratch;
  std::ofstream(scratch / "a.nc") << written_in(5);
  const test::Outcome run = read_by_python(scratch, "history", "one.dimensions, one[...].tolist()");
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("NETCDF3_64BIT_OFFSET gearlash map\n"));
  EXPECT_THAT(run.out, HasSubstr("damping ('damping',) [0.1, 0.2, 0.3]\n"));
  EXPECT_THAT(run.out, HasSubstr("\nbacklash () 1.0\n"));
  EXPECT_THAT(run.out, HasSubstr("\nverdict ('damping', 'inertia_ratio') [[0, 1, 2, 3, 4], "));
  EXPECT_THAT(run.out, HasSubstr("\ngrowth_at_rest ('damping', 'inertia_ratio') [[1.0, 0.5, "
                                 "0.3333333333333333, inf, 0.2], "));
  EXPECT_THAT(run.out, HasSubstr("\namplitude ('damping', 'inertia_ratio') [[-0.0, -5e-324, "
                                 "-1e-323, -1.5e-323, nan], "));
  EXPECT_THAT(run.out, HasSubstr("\ntarget ('damping', 'inertia_ratio') [[2, 2, 2, 2, 2], "));
  EXPECT_THAT(run.out, HasSubstr("\nhunting_boundary_damping ('hunting_boundary_point',) "
                                 "[0.1, 0.2, nan, 0.3]\n"));
  EXPECT_THAT(run.out, HasSubstr("\nhunting_boundary_inertia_ratio ('hunting_boundary_point',) "
                                 "[1.0, 2.0, nan, 1.5]\n"));
}

/// Beyond 4 GiB lengths have 64 bits. The limit is lower here.
TEST(NetcdfFile, OfVersion5IsReadByPython) {
  const Scratch scratch;
  const NetcdfDescription description{
      .dimensions = {{"x", 3}},
      .attributes = {{"title", "five"}},
      .variables = {
          {.name = "x",
           .type = NetcdfType::numbers,
           .dimensions = {0},
           .attributes = {{"valid_min", -1.5}},
           .values = {1.0, 2.0, 4.0}},
          {.name = "kinds",
           .type = NetcdfType::flags,
           .dimensions = {0},
           .attributes = {{"flag_values", std::vector<signed char>{0, 1, 2}}}},
          {.name = "one", .type = NetcdfType::numbers, .dimensions = {}, .attributes = {}}}};
  const Opened opened(scratch / "a.nc");
  NetcdfFile file = NetcdfFile::create(opened, "a.nc", layout_of(description, 1000, 16));
  const std::vector<std::byte> kinds = {std::byte{2}, std::byte{0}, std::byte{1}};
  file.write("kinds", 0, kinds);
  file.write("one", 0, std::vector{0.125});
  const test::Outcome run =
      read_by_python(scratch, "title", "one.dtype, one[...].tolist(), one.__dict__");
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("NETCDF3_64BIT_DATA five\n"));
  EXPECT_THAT(run.out, HasSubstr("x float64 [1.0, 2.0, 4.0] {'valid_min': -1.5}\n"));
  EXPECT_THAT(run.out, HasSubstr("kinds int8 [2, 0, 1] {'flag_values': array([0, 1, 2], "));
  EXPECT_THAT(run.out, HasSubstr("one float64 0.125 {}\n"));
}

TEST(NetcdfFile, HasLengthsOf64BitsFrom4GiBOn) {
  const auto version = [](std::size_t length) {
    const NetcdfDescription description{
        .dimensions = {{"x", length}},
        .attributes = {},
        .variables = {
            {.name = "a", .type = NetcdfType::numbers, .dimensions = {0}, .attributes = {}}}};
    return static_cast<int>(layout_of(description, 0).head[3]);
  };
  EXPECT_EQ(version((1ULL << 29U) - 1), 2);
  EXPECT_EQ(version(1ULL << 29U), 5);
}

TEST(NetcdfFile, IsGoneOnWithWhereItWasLeft) {
  const Scratch scratch;
  const Opened opened(scratch / "a.nc");
  {
    GridNetcdf begun = GridNetcdf::create(opened, "a.nc", small_contents());
    write_rows(begun, 0, 7);
  }
  GridNetcdf file = GridNetcdf::reopen(opened, "a.nc", small_contents());
  Table found(7, small_contents().quantities);
  file.read(0, found);
  const Table expected = answers(0, 7);
  EXPECT_TRUE(
      std::equal(found.verdicts().begin(), found.verdicts().end(), expected.verdicts().begin()));
  for (const Quantity quantity : small_contents().quantities) {
    EXPECT_EQ(std::memcmp(found[quantity].data(), expected[quantity].data(), 7 * sizeof(double)),
              0);
  }
  write_rows(file, 7, 8);
  const Scratch at_once;
  const Opened other(at_once / "a.nc");
  GridNetcdf whole = GridNetcdf::create(other, "a.nc", small_contents());
  write_rows(whole, 0, 15);
  EXPECT_EQ(file_text(scratch / "a.nc"), file_text(at_once / "a.nc"));
}

/// Every truncation and every flipped bit of a byte is refused, but for those of answers.
TEST(NetcdfFile, IsNotGoneOnWithIfItIsDamaged) {
  const NetcdfLayout layout = layout_of(description_of(small_contents(), {}), 4096);
  const Opened opened(memfd_create("a.nc", MFD_CLOEXEC));
  NetcdfFile::create(opened, "a.nc", layout);
  std::string text(layout.end, '\0');
  ASSERT_EQ(pread(opened, text.data(), text.size(), 0), static_cast<ssize_t>(text.size()));
  const auto error_with = [&](const std::string& damaged) {
    EXPECT_EQ(ftruncate(opened, 0), 0);
    EXPECT_EQ(pwrite(opened, damaged.data(), damaged.size(), 0),
              static_cast<ssize_t>(damaged.size()));
    return error_of([&] { NetcdfFile::reopen(opened, "a.nc", layout); });
  };
  const std::string expected =
      "a.nc: is damaged, or describes another grid than the one to go on with";
  ASSERT_EQ(error_with(text), "");
  for (std::size_t length = 0; length < text.size(); ++length) {
    ASSERT_EQ(error_with(text.substr(0, length)), expected) << length;
  }
  ASSERT_EQ(error_with(text + '\0'), expected);
  for (std::size_t place = 0; place < text.size(); ++place) {
    std::string damaged = text;
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << place % 8));
    ASSERT_EQ(error_with(damaged), place < layout.head.size() ? expected : "") << place;
  }
  EXPECT_EQ(error_with("\x89HDF\r\n\x1a\n" + std::string(text.size() - 8, '\0')), expected);
}

TEST(NetcdfFile, IsOfOneGridAlone) {
  const Scratch scratch;
  const Opened opened(scratch / "a.nc");
  GridNetcdf::create(opened, "a.nc", small_contents());
  GridContents other = small_contents();
  other.grid.axes[0].values[1] = 0.2000001;
  EXPECT_NE(error_of([&] { GridNetcdf::reopen(opened, "a.nc", other); }), "");
  other = small_contents();
  other.grid.drive = normal_form(0.2, 1.0, 0.1, 2.0);
  EXPECT_NE(error_of([&] { GridNetcdf::reopen(opened, "a.nc", other); }), "");
  other = small_contents();
  other.quantities.pop_back();
  EXPECT_NE(error_of([&] { GridNetcdf::reopen(opened, "a.nc", other); }), "");
}

TEST(NetcdfFile, ReportsTheReasonOfTheSystem) {
  const Scratch scratch;
  {
    const Opened opened(scratch / "a.nc");
    GridNetcdf::create(opened, "a.nc", small_contents());
  }
  const Opened to_read(scratch / "a.nc", O_RDONLY);
  EXPECT_EQ(error_of([&] { GridNetcdf::create(to_read, "b.nc", small_contents()); }),
            "b.nc: cannot be written: Invalid argument");
  GridNetcdf file = GridNetcdf::reopen(to_read, "b.nc", small_contents());
  EXPECT_EQ(error_of([&] { write_rows(file, 0, 1); }),
            "b.nc: cannot be written: Bad file descriptor");
  const Opened to_write(scratch / "a.nc", O_WRONLY);
  EXPECT_EQ(error_of([&] { GridNetcdf::reopen(to_write, "b.nc", small_contents()); }),
            "b.nc: cannot be read: Bad file descriptor");
  std::filesystem::resize_file(scratch / "a.nc", 100);
  Table table(1, small_contents().quantities);
  EXPECT_EQ(error_of([&] { file.read(0, table); }), "b.nc: cannot be read: No data available");
}

}  // namespace
}  // namespace gearlash::netcdf_file_test
