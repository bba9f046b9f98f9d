#include "output/grid_netcdf.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/lists.hpp"
#include "output/netcdf_file.hpp"
#include "output/output_file.hpp"
#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

enum class GridTask { write, read, write_boundary, write_target, flush, close };

constexpr char verdict_name[] = "verdict";

/// Consecutive points as a box.
NetcdfBox box_of(const Grid& grid, std::size_t first, std::size_t count) {
  NetcdfBox box{std::vector<std::size_t>(grid.axes.size(), 0),
                std::vector<std::size_t>(grid.axes.size(), 1)};
  for (std::size_t i = grid.axes.size(); i-- > 0;) {
    const std::size_t values = grid.axes[i].values.size();
    box.start[i] = first % values;
    box.extent[i] = std::min(count, values);
    first /= values;
    count = (count + values - 1) / values;
  }
  return box;
}

/// The coordinates by axis: y, x.
std::array<std::vector<double>, 2> columns_of(const std::vector<MapCurve>& curves) {
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  std::array<std::vector<double>, 2> columns;
  for (const MapCurve& curve : curves) {
    if (&curve != &curves.front()) {
      for (std::vector<double>& column : columns) column.push_back(gap);
    }
    for (const MapPoint& point : curve) {
      columns[0].push_back(point.y);
      columns[1].push_back(point.x);
    }
  }
  return columns;
}

/// In the child: the file, and what is asked of it. Values come and go by columns. Those of the
/// verdicts are first, as their numbers.
class GridFile {
 public:
  static GridFile create(const std::filesystem::path& path, const std::string& shown_name,
                         const GridContents& contents) {
    GridFile grid(NetcdfFile::create(path, shown_name), contents);
    grid.describe(contents);
    return grid;
  }

  static GridFile reopen(const std::filesystem::path& path, const std::string& shown_name,
                         const GridContents& contents) {
    GridFile grid(NetcdfFile::reopen(path, shown_name), contents);
    grid.find_variables();
    if (!grid.describes(contents)) {
      throw OutputError(shown_name + ": describes another grid than the one to go on with");
    }
    return grid;
  }

  void serve(Connection& parent) {
    switch (parent.receive_one<GridTask>()) {
      case GridTask::write:
        write(parent);
        break;
      case GridTask::read:
        return read_and_send(parent);
      case GridTask::write_boundary:
        write_boundary(parent);
        break;
      case GridTask::write_target:
        write_target(parent);
        break;
      case GridTask::flush:
        file_.flush();
        break;
      case GridTask::close:
        file_.close();
        break;
    }
    report_done(parent);
  }

 private:
  GridFile(NetcdfFile file, const GridContents& contents)
      : file_(std::move(file)), grid_(contents.grid), quantities_(contents.quantities) {}

  void describe(const GridContents& contents) {
    for (const auto& [name, text] : attributes_of_file(contents)) {
      file_.set_attribute_of_file(name, text);
    }
    dimensions_ = describe_axes(file_, grid_);
    const std::string fixed = describe_fixed_numbers(file_, grid_);
    const NetcdfVariable verdict =
        file_.add_flags(verdict_name, dimensions_, "verdict on the drive", verdict_words());
    if (!fixed.empty()) file_.set_attribute(verdict, "coordinates", fixed);
    for (const Quantity quantity : quantities_) {
      const QuantityInfo& info = info_of(quantity);
      const NetcdfVariable variable = file_.add_numbers(
          std::string(info.name), dimensions_, std::string(info.meaning), std::string(info.unit));
      file_.declare_nan_missing(variable);
      if (!fixed.empty()) file_.set_attribute(variable, "coordinates", fixed);
    }
    file_.end_description();
    write_parameters(file_, grid_);
    claim_places();
  }

  bool describes(const GridContents& contents) const {
    for (const auto& [name, text] : attributes_of_file(contents)) {
      const bool is_free = name == "history";  // the command may spell its file names differently
      if (!is_free && file_.attribute_of_file(name) != text) return false;
    }
    return all_of(grid_.axes, [&](const Axis& axis) {
      std::vector<double> values(axis.values.size());
      file_.read(file_.variable(column_name(axis.path)), {{0}, {values.size()}}, values);
      return values == axis.values;
    });
  }

  void find_variables() {
    verdict_ = file_.variable(verdict_name);
    for (const Quantity quantity : quantities_) {
      variables_.push_back(file_.variable(std::string(name_of(quantity))));
    }
  }

  /// Writes one value of each variable. The library then allocates the whole variable, and later
  /// writes do not change the file's structure, so that the file stays readable if the program is
  /// killed.
  void claim_places() {
    find_variables();
    const NetcdfBox first_point = box_of(grid_, 0, 1);
    const signed char flag = 0;
    const double number = 0.0;
    file_.write(verdict_, first_point, std::span(&flag, 1));
    for (const NetcdfVariable variable : variables_) {
      file_.write(variable, first_point, std::span(&number, 1));
    }
  }

  void write(Connection& parent) {
    const auto first = parent.receive_one<std::size_t>();
    const auto count = parent.receive_one<std::size_t>();
    const NetcdfBox box = box_of(grid_, first, count);
    flags_.resize(count);
    numbers_.resize(count);
    parent.receive_all(std::span(flags_));
    file_.write(verdict_, box, flags_);
    for (const NetcdfVariable variable : variables_) {
      parent.receive_all(std::span(numbers_));
      file_.write(variable, box, numbers_);
    }
    begin_flush_now_and_then(first + count);
  }

  /// Keeps the disk busy while the next points are computed. The interval is long enough to write
  /// long stretches of each variable.
  void begin_flush_now_and_then(std::size_t written) {
    constexpr std::size_t often_enough = std::size_t{1} << 18U;
    if (written - flushed_ < often_enough && written < grid_.size()) return;
    file_.begin_flush();
    flushed_ = written;
  }

  void read_and_send(Connection& parent) {
    const auto first = parent.receive_one<std::size_t>();
    const auto count = parent.receive_one<std::size_t>();
    const NetcdfBox box = box_of(grid_, first, count);
    std::vector<signed char> flags(count);
    file_.read(verdict_, box, flags);
    std::vector<std::vector<double>> columns(variables_.size(), std::vector<double>(count));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      file_.read(variables_[i], box, columns[i]);
    }
    report_done(parent);
    parent.send_all(std::span<const signed char>(flags));
    for (const std::vector<double>& column : columns) parent.send_all(std::span(column));
  }

  /// A list of points for each axis.
  void write_boundary(Connection& parent) {
    std::array<std::vector<double>, 2> boundary;
    for (std::vector<double>& column : boundary) column = parent.receive_list<double>();
    file_.resume_description();
    const NetcdfDimension dimension =
        file_.add_dimension("hunting_boundary_point", boundary.front().size());
    std::vector<NetcdfVariable> variables;
    for (const Axis& axis : grid_.axes) {
      variables.push_back(
          file_.add_numbers("hunting_boundary_" + column_name(axis.path), {dimension},
                            named_parameter(axis, grid_.drive).meaning +
                                ", where hunting ends (growth at rest 1); NaN between curves",
                            unit_of(axis, grid_.drive)));
    }
    file_.end_description();
    for (std::size_t i = 0; i < boundary.size(); ++i) {
      file_.write(variables[i], {{0}, {boundary[i].size()}}, boundary[i]);
    }
  }

  void write_target(Connection& parent) {
    constexpr std::array words = {PlaceKind::not_known, PlaceKind::missed, PlaceKind::met};
    const auto meanings = of_each(words, [](PlaceKind word) { return one_word(name_of(word)); });
    file_.resume_description();
    const NetcdfVariable variable =
        file_.add_flags("target", dimensions_, "whether the drive meets the target", meanings);
    file_.end_description();
    const auto flags = of_each(parent.receive_list<PlaceKind>(), [&](PlaceKind kind) {
      return static_cast<signed char>(std::find(words.begin(), words.end(), kind) - words.begin());
    });
    const NetcdfBox box = box_of(grid_, 0, grid_.size());
    file_.write(variable, box, flags);
  }

  NetcdfFile file_;
  Grid grid_;
  std::vector<Quantity> quantities_;
  std::vector<NetcdfDimension> dimensions_;  ///< of the axes, where it was created
  NetcdfVariable verdict_ = 0;
  std::vector<NetcdfVariable> variables_;  ///< of the quantities
  std::vector<signed char> flags_;         ///< kept, because new memory costs as much as writing
  std::vector<double> numbers_;            ///< likewise
  std::size_t flushed_ = 0;                ///< points written before the last begin_flush()
};

Server serving(GridFile file) {
  const auto shared = std::make_shared<GridFile>(std::move(file));
  return [shared](Connection& parent) { shared->serve(parent); };
}

}  // namespace

GridNetcdf::GridNetcdf(const std::string& shown_name, const GridContents& contents,
                       const std::function<Server()>& begin)
    : grid_(contents.grid),
      quantities_(contents.quantities),
      process_(std::make_unique<WritingProcess>(shown_name, begin)) {}

GridNetcdf GridNetcdf::create(const std::filesystem::path& path, const std::string& shown_name,
                              const GridContents& contents) {
  return {shown_name, contents,
          [&] { return serving(GridFile::create(path, shown_name, contents)); }};
}

GridNetcdf GridNetcdf::reopen(const std::filesystem::path& path, const std::string& shown_name,
                              const GridContents& contents) {
  return {shown_name, contents,
          [&] { return serving(GridFile::reopen(path, shown_name, contents)); }};
}

void GridNetcdf::write(const GridPiece& piece) {
  constexpr std::size_t most_points = std::size_t{1} << 15U;  // 3 MB
  const Table& table = piece.table;
  for (std::size_t done = 0, count = 0; done < table.rows(); done += count) {
    const std::size_t first = piece.first + done;
    count = box_length(grid_, first, std::min(table.rows() - done, most_points));
    process_->ask([&](Connection& child) {
      child.send_one(GridTask::write);
      child.send_one(first);
      child.send_one(count);
      child.send_all(table.verdicts().subspan(done, count));
      for (const Quantity quantity : quantities_) {
        child.send_all(table[quantity].subspan(done, count));
      }
    });
  }
}

void GridNetcdf::read(std::size_t first, Table& table) const {
  process_->ask(
      [&](Connection& child) {
        child.send_one(GridTask::read);
        child.send_one(first);
        child.send_one(table.rows());
      },
      [&](Connection& child) {
        child.receive_all(table.column_of_verdicts());
        for (const Quantity quantity : quantities_) child.receive_all(table.column(quantity));
      });
}

void GridNetcdf::write_boundary(const std::vector<MapCurve>& boundary) {
  if (boundary.empty()) return;
  process_->ask([&](Connection& child) {
    child.send_one(GridTask::write_boundary);
    for (const std::vector<double>& column : columns_of(boundary)) {
      child.send_list(std::span(column));
    }
  });
}

void GridNetcdf::write_target(std::span<const PlaceKind> kinds) {
  process_->ask([&](Connection& child) {
    child.send_one(GridTask::write_target);
    child.send_list(kinds);
  });
}

void GridNetcdf::flush() {
  process_->ask([](Connection& child) { child.send_one(GridTask::flush); });
}

void GridNetcdf::close() {
  process_->ask([](Connection& child) { child.send_one(GridTask::close); });
}

std::size_t netcdf_bytes(const GridContents& contents) {
  return contents.grid.size() * (1 + sizeof(double) * contents.quantities.size());
}

}  // namespace gearlash
