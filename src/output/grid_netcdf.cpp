#include "output/grid_netcdf.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "analysis/grid/hunting_boundary.hpp"
#include "output/grid_words.hpp"
#include "output/netcdf_file.hpp"
#include "output/output_file.hpp"

namespace gearlash {
namespace {

constexpr char verdict_name[] = "verdict";

/// Two pieces of 3 MB, which caches hold.
constexpr std::size_t points_at_a_time = std::size_t{1} << 15U;

/// "cannot_hunt", "hunts", …: by the number of each verdict.
std::vector<std::string> verdict_words() {
  std::vector<std::string> words;
  for (int number = 0; number <= static_cast<int>(Verdict::undecided); ++number) {
    words.emplace_back(name_of(static_cast<Verdict>(number)));
    std::replace(words.back().begin(), words.back().end(), ' ', '_');
  }
  return words;
}

/// What a unit is to UDUNITS, in which K would be the kelvin: time, speed and energy are
/// normalised.
struct NetcdfUnits {
  std::string units;
  std::string remark;  ///< for long_name
};

NetcdfUnits netcdf_units(const std::string& unit) {
  if (unit == "1/omega_n") return {"1", " (times omega_n)"};
  if (unit == "rad omega_n") return {"rad", " (over omega_n)"};
  if (unit == "K rad2") return {"rad2", " (over K)"};
  return {unit, ""};
}

/// Consecutive points as a box: where it starts on each axis, and how far it extends.
struct GridBox {
  std::vector<std::size_t> start;
  std::vector<std::size_t> extent;
};

GridBox box_of(const ServoGrid& grid, std::size_t first, std::size_t count) {
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

bool is_varied(const ServoGrid& grid, Input input) {
  return std::any_of(grid.axes.begin(), grid.axes.end(),
                     [&](const Axis& axis) { return axis.input == input; });
}

}  // namespace

class GridNetcdf::Layout {
 public:
  Layout(NetcdfFile file, const GridContents& contents)
      : file_(std::move(file)), grid_(contents.grid), quantities_(contents.quantities) {}

  void describe(const GridContents& contents) {
    describe_file(contents);
    std::vector<NetcdfDimension> dimensions;
    for (const Axis& axis : grid_.axes) {
      dimensions.push_back(file_.add_dimension(name_of(axis.input), axis.values.size()));
    }
    for (std::size_t i = 0; i < grid_.axes.size(); ++i) describe_axis(grid_.axes[i], dimensions[i]);
    const std::string fixed = describe_fixed_inputs();
    const NetcdfVariable verdict =
        file_.add_flags(verdict_name, dimensions, "verdict on the servo", verdict_words());
    if (!fixed.empty()) file_.set_attribute(verdict, "coordinates", fixed);
    for (const CycleQuantity quantity : quantities_) {
      const NetcdfUnits units = netcdf_units(unit_of(quantity));
      const NetcdfVariable variable =
          file_.add_numbers(name_of(quantity), dimensions,
                            std::string(description_of(quantity)) + units.remark, units.units);
      file_.declare_nan_missing(variable);
      if (!fixed.empty()) file_.set_attribute(variable, "coordinates", fixed);
    }
    file_.end_description();
    write_inputs();
    claim_places();
  }

  void find_variables() {
    verdict_ = file_.variable(verdict_name);
    for (const CycleQuantity quantity : quantities_) {
      variables_.push_back(file_.variable(name_of(quantity)));
    }
  }

  /// Whether the file says of the grid what describe() wrote.
  bool describes(const GridContents& contents) const {
    for (const auto& [name, text] : attributes_of_file(contents)) {
      const bool is_free = name == "history";  // the command may spell its files in another way
      if (!is_free && file_.attribute_of_file(name) != text) return false;
    }
    return std::all_of(grid_.axes.begin(), grid_.axes.end(),
                       [&](const Axis& axis) {
                         std::vector<double> values(axis.values.size());
                         file_.read(file_.variable(name_of(axis.input)), {0}, {values.size()},
                                    values);
                         return values == axis.values;
                       }) &&
           std::all_of(all_inputs.begin(), all_inputs.end(), [&](Input input) {
             if (is_varied(grid_, input)) return true;
             double value = 0.0;
             file_.read(file_.variable(name_of(input)), {}, {}, std::span(&value, 1));
             return value == grid_.servo.*field_of(input);
           });
  }

  void read(std::size_t first, CycleTable& cycles) const {
    const GridBox box = box_of(grid_, first, cycles.rows());
    std::vector<signed char> flags(cycles.rows());
    file_.read(verdict_, box.start, box.extent, flags);
    std::transform(flags.begin(), flags.end(), cycles.verdict.begin(),
                   [](signed char flag) { return static_cast<Verdict>(flag); });
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
      file_.read(variables_[i], box.start, box.extent,
                 cycles.values[static_cast<std::size_t>(quantities_[i])]);
    }
  }

  void write(const GridPiece& piece) {
    const CycleTable& cycles = piece.cycles;
    const GridBox box = box_of(grid_, piece.first, cycles.rows());
    flags_.resize(cycles.rows());
    std::transform(cycles.verdict.begin(), cycles.verdict.end(), flags_.begin(),
                   [](Verdict verdict) { return static_cast<signed char>(verdict); });
    file_.write(verdict_, box.start, box.extent, flags_);
    for (std::size_t i = 0; i < quantities_.size(); ++i) {
      file_.write(variables_[i], box.start, box.extent, cycles[quantities_[i]]);
    }
    begin_flush_now_and_then(piece);
  }

  void write_boundary(const std::vector<MapCurve>& curves) {
    if (curves.empty()) return;
    const std::array<std::vector<double>, 2> boundary = columns_of(curves);
    describe_boundary(boundary.front().size());
    for (std::size_t i = 0; i < boundary.size(); ++i) {
      file_.write(file_.variable(boundary_name(grid_.axes[i])), {0}, {boundary[i].size()},
                  boundary[i]);
    }
  }

  NetcdfFile& file() { return file_; }

 private:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  Attributes attributes_of_file(const GridContents& contents) const {
    Attributes attributes = {
        {"Conventions", "CF-1.8"},
        {"title", "Limit cycles of geared servos with backlash"},
        {"source", "gearlash " + contents.provenance.version},
        {"history", contents.provenance.command},
        {"certainty", certainty_of(grid_)},
        {"sensor", grid_.servo.sensor == ShaftName::load ? "load" : "motor"},
        {"comment",
         "Angles at the load shaft. Times, speeds and energies are normalised: undamped natural "
         "frequency omega_n = 1, loop stiffness K = 1."}};
    if (!contents.source_text.empty()) attributes.emplace_back("sweep", contents.source_text);
    return attributes;
  }

  void describe_file(const GridContents& contents) {
    for (const auto& [name, text] : attributes_of_file(contents)) {
      file_.set_attribute_of_file(name, text);
    }
  }

  void describe_axis(const Axis& axis, NetcdfDimension dimension) {
    const NetcdfVariable variable = file_.add_numbers(
        name_of(axis.input), {dimension}, description_of(axis.input), unit_of(axis.input));
    file_.set_attribute(variable, "spacing", axis.logarithmic ? "logarithmic" : "linear");
  }

  /// Their names, with blanks between.
  std::string describe_fixed_inputs() {
    std::string names;
    for (const Input input : all_inputs) {
      if (is_varied(grid_, input)) continue;
      file_.add_numbers(name_of(input), {}, description_of(input), unit_of(input));
      names += (names.empty() ? "" : " ") + std::string(name_of(input));
    }
    return names;
  }

  void write_inputs() {
    for (const Axis& axis : grid_.axes) {
      file_.write(file_.variable(name_of(axis.input)), {0}, {axis.values.size()}, axis.values);
    }
    for (const Input input : all_inputs) {
      if (is_varied(grid_, input)) continue;
      const double value = grid_.servo.*field_of(input);
      file_.write(file_.variable(name_of(input)), {}, {}, std::span(&value, 1));
    }
  }

  /// By axis: y, x.
  static std::array<std::vector<double>, 2> columns_of(const std::vector<MapCurve>& curves) {
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

  static std::string boundary_name(const Axis& axis) {
    return std::string("hunting_boundary_") + name_of(axis.input);
  }

  void describe_boundary(std::size_t points) {
    file_.resume_description();
    const NetcdfDimension dimension = file_.add_dimension("hunting_boundary_point", points);
    for (const Axis& axis : grid_.axes) {
      file_.add_numbers(boundary_name(axis), {dimension},
                        std::string(description_of(axis.input)) +
                            " where hunting ends (growth at rest 1); NaN between curves",
                        unit_of(axis.input));
    }
    file_.end_description();
  }

  /// So that the disk is at work while the next points are worked out; seldom enough that it has
  /// long pieces of each variable to take.
  void begin_flush_now_and_then(const GridPiece& piece) {
    constexpr std::size_t often_enough = std::size_t{1} << 18U;
    const std::size_t written = piece.first + piece.cycles.rows();
    if (written - flushed_ < often_enough && written < grid_.size()) return;
    file_.begin_flush();
    flushed_ = written;
  }

  /// One value of each variable is written: with it the library gives the whole variable its place,
  /// so that what is written later leaves the file's structure as it is, and a program that is
  /// killed leaves it readable.
  void claim_places() {
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

  NetcdfFile file_;
  ServoGrid grid_;
  std::vector<CycleQuantity> quantities_;
  NetcdfVariable verdict_ = 0;
  std::vector<NetcdfVariable> variables_;  ///< of the quantities
  std::vector<signed char> flags_;
  std::size_t flushed_ = 0;  ///< points written before the last begin_flush()
};

GridNetcdf::GridNetcdf(std::unique_ptr<Layout> layout) : layout_(std::move(layout)) {}
GridNetcdf::~GridNetcdf() = default;
GridNetcdf::GridNetcdf(GridNetcdf&& other) noexcept = default;

GridNetcdf GridNetcdf::create(const std::filesystem::path& path, const std::string& shown_name,
                              const GridContents& contents) {
  auto layout = std::make_unique<Layout>(NetcdfFile::create(path, shown_name), contents);
  layout->describe(contents);
  return GridNetcdf(std::move(layout));
}

GridNetcdf GridNetcdf::reopen(const std::filesystem::path& path, const std::string& shown_name,
                              const GridContents& contents) {
  auto layout = std::make_unique<Layout>(NetcdfFile::reopen(path, shown_name), contents);
  layout->find_variables();
  if (!layout->describes(contents)) {
    throw OutputError(shown_name + ": describes another grid than the one to go on with");
  }
  return GridNetcdf(std::move(layout));
}

void GridNetcdf::read(std::size_t first, CycleTable& cycles) const { layout_->read(first, cycles); }

void GridNetcdf::write(const GridPiece& piece) { layout_->write(piece); }
void GridNetcdf::write_boundary(const std::vector<MapCurve>& boundary) {
  layout_->write_boundary(boundary);
}

void GridNetcdf::flush() { layout_->file().flush(); }
void GridNetcdf::close() { layout_->file().close(); }

std::size_t netcdf_bytes(const GridContents& contents) {
  return contents.grid.size() * (1 + sizeof(double) * contents.quantities.size());
}

GridCount make_grid_netcdf(const ServoGrid& grid, GridBoundary boundary,
                           const Provenance& provenance, const OutputFile& output,
                           const GoingOn& going_on) {
  GridNetcdf file =
      GridNetcdf::create(output.hidden_file(), output.shown_name(),
                         {.grid = grid,
                          .quantities = {all_quantities.begin(), all_quantities.end()},
                          .provenance = provenance});
  std::vector<double> growth_at_rest;
  if (boundary == GridBoundary::hunting) growth_at_rest.reserve(grid.size());
  const GridCount count = evaluate_in_pieces(
      grid, 0, points_at_a_time,
      [&](const GridPiece& piece) {
        file.write(piece);
        if (boundary == GridBoundary::none) return;
        const std::vector<double>& growth = piece.cycles[CycleQuantity::growth_at_rest];
        growth_at_rest.insert(growth_at_rest.end(), growth.begin(), growth.end());
      },
      going_on);
  if (boundary == GridBoundary::hunting && !count.stopped) {
    file.write_boundary(hunting_boundary(grid, growth_at_rest));
  }
  file.close();
  return count;
}

}  // namespace gearlash
