#include "output/netcdf_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/endian/conversion.hpp>
#include <cerrno>
#include <system_error>

#include "base/lists.hpp"
#include "gearlash/output.hpp"

namespace gearlash {
namespace {

constexpr unsigned tag_of_dimensions = 10;
constexpr unsigned tag_of_variables = 11;
constexpr unsigned tag_of_attributes = 12;

/// Everything in a file begins at a multiple of 4 bytes.
std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

std::size_t bytes_of(const NetcdfVariable& variable, const NetcdfDescription& description) {
  std::size_t bytes = variable.type == NetcdfType::numbers ? sizeof(double) : 1;
  for (const std::size_t index : variable.dimensions) bytes *= description.dimensions[index].length;
  return padded(bytes);
}

/// Appends what the format's grammar names.
class HeaderWriter {
 public:
  HeaderWriter(std::string& head, bool is_wide) : bytes_of_count_(is_wide ? 8 : 4), head_(head) {
    head_ += "CDF";
    put(is_wide ? 5 : 2, 1);
    put_count(0);  // of records, which no variable has
  }

  /// The most significant byte first.
  void put(std::uint64_t number, unsigned bytes) {
    while (bytes-- > 0) head_ += static_cast<char>(number >> (8 * bytes));
  }
  void put_count(std::size_t count) { put(count, bytes_of_count_); }
  void put_type(NetcdfType type) { put(static_cast<std::uint64_t>(type), 4); }
  void put_text(std::string_view text) {
    put_count(text.size());
    head_ += text;
    head_.resize(padded(head_.size()), '\0');
  }
  /// `put_one` puts an element.
  template <class List, class PutOne>
  void put_list(unsigned tag, const List& list, const PutOne& put_one) {
    put(list.empty() ? 0 : tag, 4);
    put_count(list.size());
    for (const auto& one : list) put_one(one);
  }
  void put_attributes(const std::vector<NetcdfAttribute>& attributes) {
    put_list(tag_of_attributes, attributes, [&](const NetcdfAttribute& attribute) {
      put_text(attribute.name);
      std::visit([&](const auto& value) { put_value(value); }, attribute.value);
    });
  }
  void put_number(double number) { put(std::bit_cast<std::uint64_t>(number), sizeof number); }

 private:
  void put_value(const std::string& text) {
    put_type(NetcdfType::text);
    put_text(text);
  }
  void put_value(double number) {
    put_type(NetcdfType::numbers);
    put_count(1);
    put_number(number);
  }
  void put_value(const std::vector<signed char>& flags) {
    put_type(NetcdfType::flags);
    put_text(std::string(flags.begin(), flags.end()));
  }

  unsigned bytes_of_count_;
  std::string& head_;
};

/// What a system call returns that no signal interrupts.
template <class Call>
auto uninterrupted(const Call& call) {
  while (true) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

/// Makes the file so long. Its room on the disk is claimed too if the file system can do that, so
/// that a disk that is too full is reported before the work. 0 if it is done.
int claim(int descriptor, off_t bytes) {
#ifdef __linux__
  const int claimed = uninterrupted([&] { return fallocate(descriptor, 0, 0, bytes); });
  if (claimed == 0 || (errno != EOPNOTSUPP && errno != ENOSYS)) return claimed;
#endif
  return uninterrupted([&] { return ftruncate(descriptor, bytes); });
}

/// Calls `transfer`, pwrite or pread, until all bytes are through. False if it fails.
template <class Transfer, class Byte>
bool transfer_all(Transfer transfer, int descriptor, std::span<Byte> bytes, std::size_t place) {
  while (!bytes.empty()) {
    const ssize_t done = uninterrupted([&] {
      return transfer(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(place));
    });
    if (done == 0) errno = ENODATA;  // the file ends
    if (done <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    place += static_cast<std::size_t>(done);
  }
  return true;
}

}  // namespace

NetcdfLayout layout_of(const NetcdfDescription& description, std::size_t begin,
                       std::size_t largest) {
  NetcdfLayout layout{.head = {}, .header_bytes = 0, .places = {}, .end = begin};
  const bool is_wide = any_of(description.variables, [&](const NetcdfVariable& variable) {
    return bytes_of(variable, description) > largest;
  });
  HeaderWriter header(layout.head, is_wide);
  header.put_list(tag_of_dimensions, description.dimensions, [&](const NetcdfDimension& dimension) {
    header.put_text(dimension.name);
    header.put_count(dimension.length);
  });
  header.put_attributes(description.attributes);
  header.put_list(tag_of_variables, description.variables, [&](const NetcdfVariable& variable) {
    const std::size_t bytes = bytes_of(variable, description);
    header.put_text(variable.name);
    header.put_count(variable.dimensions.size());
    for (const std::size_t index : variable.dimensions) header.put_count(index);
    header.put_attributes(variable.attributes);
    header.put_type(variable.type);
    header.put_count(bytes);
    header.put(layout.end, 8);
    layout.places.emplace_back(variable.name, layout.end);
    layout.end += bytes;
  });
  layout.header_bytes = layout.head.size();
  layout.head.resize(std::max(layout.header_bytes, begin), '\0');
  for (const NetcdfVariable& variable : description.variables) {
    for (const double value : variable.values) header.put_number(value);
  }
  return layout;
}

NetcdfFile NetcdfFile::create(int descriptor, std::string shown_name, NetcdfLayout layout) {
  NetcdfFile file(descriptor, std::move(shown_name), std::move(layout));
  if (uninterrupted([&] { return ftruncate(descriptor, 0); }) != 0) file.refuse("written");
  file.begin();
  return file;
}

NetcdfFile NetcdfFile::reopen(int descriptor, std::string shown_name, NetcdfLayout layout) {
  NetcdfFile file(descriptor, std::move(shown_name), std::move(layout));
  const std::string& expected = file.layout_.head;
  std::string head(expected.size(), '\0');
  const bool has_length = lseek(descriptor, 0, SEEK_END) == static_cast<off_t>(file.layout_.end);
  if (has_length) file.get(std::as_writable_bytes(std::span(head)), 0);
  if (head != expected) {
    throw OutputError(file.shown_name_ +
                      ": is damaged, or describes another grid than the one to go on with");
  }
  return file;
}

void NetcdfFile::extend(NetcdfLayout layout) {
  layout_ = std::move(layout);
  begin();
}

/// The room first: a header never names values beyond the file's end.
void NetcdfFile::begin() {
  if (claim(descriptor_, static_cast<off_t>(layout_.end)) != 0) refuse("written");
  put(std::as_bytes(std::span(layout_.head)), 0);
}

void NetcdfFile::write(std::string_view variable, std::size_t first,
                       std::span<const double> numbers) {
  std::array<std::uint64_t, 8192> words;  // 64 kB, which caches hold
  std::size_t place = place_of(variable) + first * sizeof(double);
  while (!numbers.empty()) {
    const auto part = numbers.first(std::min(numbers.size(), words.size()));
    std::transform(part.begin(), part.end(), words.begin(), [](double number) {
      return boost::endian::native_to_big(std::bit_cast<std::uint64_t>(number));
    });
    put(std::as_bytes(std::span(words).first(part.size())), place);
    numbers = numbers.subspan(part.size());
    place += part.size_bytes();
  }
}

void NetcdfFile::write(std::string_view variable, std::size_t first,
                       std::span<const std::byte> flags) {
  put(flags, place_of(variable) + first);
}

void NetcdfFile::read(std::string_view variable, std::size_t first,
                      std::span<double> numbers) const {
  get(std::as_writable_bytes(numbers), place_of(variable) + first * sizeof(double));
  for (double& number : numbers) {
    const auto word = std::bit_cast<std::uint64_t>(number);
    number = std::bit_cast<double>(boost::endian::big_to_native(word));
  }
}

void NetcdfFile::read(std::string_view variable, std::size_t first,
                      std::span<std::byte> flags) const {
  get(flags, place_of(variable) + first);
}

void NetcdfFile::flush() {
  if (uninterrupted([&] { return fsync(descriptor_); }) != 0) refuse("written");
}

void NetcdfFile::put(std::span<const std::byte> bytes, std::size_t place) {
  if (!transfer_all(pwrite, descriptor_, bytes, place)) refuse("written");
}

void NetcdfFile::get(std::span<std::byte> bytes, std::size_t place) const {
  if (!transfer_all(pread, descriptor_, bytes, place)) refuse("read");
}

std::size_t NetcdfFile::place_of(std::string_view variable) const {
  return first_of(layout_.places, [&](const auto& place) { return place.first == variable; })
      ->second;
}

void NetcdfFile::refuse(const char* action) const {
  throw OutputError(shown_name_ + ": cannot be " + action + ": " +
                    std::generic_category().message(errno));
}

}  // namespace gearlash
