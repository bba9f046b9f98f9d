#include "output/grid_netcdf_file.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "question/map/hunting_boundary.hpp"

namespace gearlash {
namespace {

constexpr char verdict_name[] = "verdict";

/// Consecutive points as a box: its start and extent on each axis.
struct GridBox {
  std::vector<std::size_t> start;
  std::vector<std::size_t> extent;
};

GridBox box_of(const Grid& grid, std::size_t first, std::size_t count) {
  GridBox box{std::vector<std::size_t>(grid.axes.size(), 0),
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

std::string boundary_name(const Axis& axis) { return "hunting_boundary_" + column_name(axis.path); }

}  // namespace

void GridNetcdfFile::describe(const GridContents& contents) {
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

void GridNetcdfFile::find_variables() {
  verdict_ = file_.variable(verdict_name);
  for (const Quantity quantity : quantities_) {
    variables_.push_back(file_.variable(std::string(name_of(quantity))));
  }
}

bool GridNetcdfFile::describes(const GridContents& contents) const {
  for (const auto& [name, text] : attributes_of_file(contents)) {
    const bool is_free = name == "history";  // the command may spell its file names differently
    if (!is_free && file_.attribute_of_file(name) != text) return false;
  }
  return std::all_of(grid_.axes.begin(), grid_.axes.end(), [&](const Axis& axis) {
    std::vector<double> values(axis.values.size());
    file_.read(file_.variable(column_name(axis.path)), {0}, {values.size()}, values);
    return values == axis.values;
  });
}

/// Writes one value of each variable. The library then allocates the whole variable, and later
/// writes do not change the file's structure, so that the file stays readable if the program is
/// killed.
void GridNetcdfFile::claim_places() {
  find_variables();
  const std::vector<std::size_t> one(grid_.axes.size(), 1);
  const std::vector<std::size_t> origin(grid_.axes.size(), 0);
  const signed char flag = 0;
  const double number = 0.0;
  file_.write(verdict_, origin, one, std::span(&flag, 1));
  for (const NetcdfVariable variable : variables_) {
    file_.write(variable, origin, one, std::span(&number, 1));
  }
}

/// Keeps the disk busy while the next points are computed. The interval is long enough to write
/// long stretches of each variable.
void GridNetcdfFile::begin_flush_now_and_then(const GridPiece& piece) {
  constexpr std::size_t often_enough = std::size_t{1} << 18U;
  const std::size_t written = piece.first + piece.table.rows();
  if (written - flushed_ < often_enough && written < grid_.size()) return;
  file_.begin_flush();
  flushed_ = written;
}

GridNetcdfFile GridNetcdfFile::create(const std::filesystem::path& path,
                                      const std::string& shown_name, const GridContents& contents) {
  GridNetcdfFile grid(NetcdfFile::create(path, shown_name), contents);
  grid.describe(contents);
  return grid;
}

GridNetcdfFile GridNetcdfFile::reopen(const std::filesystem::path& path,
                                      const std::string& shown_name, const GridContents& contents) {
  GridNetcdfFile grid(NetcdfFile::reopen(path, shown_name), contents);
  grid.find_variables();
  if (!grid.describes(contents)) {
    throw OutputError(shown_name + ": describes another grid than the one to go on with");
  }
  return grid;
}

void GridNetcdfFile::read(std::size_t first, Table& table) const {
  const GridBox box = box_of(grid_, first, table.rows());
  std::vector<signed char> flags(table.rows());
  file_.read(verdict_, box.start, box.extent, flags);
  std::transform(flags.begin(), flags.end(), table.column_of_verdicts().begin(),
                 [](signed char flag) { return static_cast<Verdict>(flag); });
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    file_.read(variables_[i], box.start, box.extent, table.column(quantities_[i]));
  }
}

void GridNetcdfFile::write(const GridPiece& piece) {
  const Table& table = piece.table;
  const GridBox box = box_of(grid_, piece.first, table.rows());
  flags_.resize(table.rows());
  std::transform(table.verdicts().begin(), table.verdicts().end(), flags_.begin(),
                 [](Verdict verdict) { return static_cast<signed char>(verdict); });
  file_.write(verdict_, box.start, box.extent, flags_);
  for (std::size_t i = 0; i < quantities_.size(); ++i) {
    file_.write(variables_[i], box.start, box.extent, table[quantities_[i]]);
  }
  begin_flush_now_and_then(piece);
}

void GridNetcdfFile::write_boundary(const std::vector<MapCurve>& curves) {
  if (curves.empty()) return;
  const std::array<std::vector<double>, 2> boundary = columns_of(curves);
  file_.resume_description();
  const NetcdfDimension dimension =
      file_.add_dimension("hunting_boundary_point", boundary.front().size());
  for (const Axis& axis : grid_.axes) {
    file_.add_numbers(boundary_name(axis), {dimension},
                      named_parameter(axis, grid_.drive).meaning +
                          ", where hunting ends (growth at rest 1); NaN between curves",
                      unit_of(axis, grid_.drive));
  }
  file_.end_description();
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    file_.write(file_.variable(boundary_name(grid_.axes[i])), {0}, {boundary[i].size()},
                boundary[i]);
  }
}

void GridNetcdfFile::write_target(std::span<const PlaceKind> kinds) {
  constexpr std::array words = {PlaceKind::not_known, PlaceKind::missed, PlaceKind::met};
  std::vector<std::string> meanings;
  for (const PlaceKind word : words) {
    meanings.emplace_back(name_of(word));
    std::replace(meanings.back().begin(), meanings.back().end(), ' ', '_');
  }
  file_.resume_description();
  const NetcdfVariable variable =
      file_.add_flags("target", dimensions_, "whether the drive meets the target", meanings);
  file_.end_description();
  std::vector<signed char> flags;
  for (const PlaceKind kind : kinds) {
    flags.push_back(
        static_cast<signed char>(std::find(words.begin(), words.end(), kind) - words.begin()));
  }
  const GridBox box = box_of(grid_, 0, grid_.size());
  file_.write(variable, box.start, box.extent, flags);
}

}  // namespace gearlash
