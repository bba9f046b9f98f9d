#include "output/grid_netcdf.hpp"

#include <algorithm>
#include <utility>

namespace gearlash {
namespace {

enum class GridTask : std::size_t { write, read, write_boundary, write_target, flush, close };

struct GridRequest {
  GridTask task{};
  std::size_t first = 0;  ///< of the points to write or read
  std::size_t count = 0;  ///< of these points, or of curves
};

/// In the child: serves the requests of a GridNetcdf.
class GridServer {
 public:
  GridServer(GridNetcdfFile file, const std::vector<Quantity>& quantities)
      : file_(std::move(file)), quantities_(quantities) {}

  void serve(Connection& parent);

 private:
  void write(const GridRequest& asked, Connection& parent);
  void read_and_send(const GridRequest& asked, Connection& parent);
  void make_room(std::size_t rows);

  GridNetcdfFile file_;
  std::vector<Quantity> quantities_;
  Table box_;  ///< kept, because new memory costs as much as writing
};

void GridServer::make_room(std::size_t rows) {
  if (box_.rows() != rows) box_ = Table(rows, quantities_);
}

void GridServer::write(const GridRequest& asked, Connection& parent) {
  make_room(asked.count);
  parent.receive_all(box_.column_of_verdicts());
  for (const Quantity quantity : quantities_) parent.receive_all(box_.column(quantity));
  file_.write({asked.first, box_, {}});
}

void GridServer::read_and_send(const GridRequest& asked, Connection& parent) {
  make_room(asked.count);
  file_.read(asked.first, box_);
  report_done(parent);
  parent.send_all(box_.verdicts());
  for (const Quantity quantity : quantities_) parent.send_all(box_[quantity]);
}

std::vector<MapCurve> receive_curves(std::size_t count, Connection& parent) {
  std::vector<MapCurve> curves(count);
  for (MapCurve& curve : curves) {
    curve.resize(parent.receive_one<std::size_t>());
    parent.receive_all(std::span(curve));
  }
  return curves;
}

void GridServer::serve(Connection& parent) {
  const auto asked = parent.receive_one<GridRequest>();
  switch (asked.task) {
    case GridTask::write:
      write(asked, parent);
      break;
    case GridTask::read:
      return read_and_send(asked, parent);
    case GridTask::write_boundary:
      file_.write_boundary(receive_curves(asked.count, parent));
      break;
    case GridTask::write_target: {
      std::vector<PlaceKind> kinds(asked.count);
      parent.receive_all(std::span(kinds));
      file_.write_target(kinds);
      break;
    }
    case GridTask::flush:
      file_.flush();
      break;
    case GridTask::close:
      file_.close();
      break;
  }
  report_done(parent);
}

}  // namespace

GridNetcdf::GridNetcdf(const std::string& shown_name, const GridContents& contents,
                       const Open& open)
    : grid_(contents.grid),
      quantities_(contents.quantities),
      process_(std::make_unique<WritingProcess>(shown_name, [&]() -> Server {
        const auto server = std::make_shared<GridServer>(open(), quantities_);
        return [server](Connection& parent) { server->serve(parent); };
      })) {}

GridNetcdf GridNetcdf::create(const std::filesystem::path& path, const std::string& shown_name,
                              const GridContents& contents) {
  return {shown_name, contents, [&] { return GridNetcdfFile::create(path, shown_name, contents); }};
}

GridNetcdf GridNetcdf::reopen(const std::filesystem::path& path, const std::string& shown_name,
                              const GridContents& contents) {
  return {shown_name, contents, [&] { return GridNetcdfFile::reopen(path, shown_name, contents); }};
}

void GridNetcdf::write(const GridPiece& piece) {
  constexpr std::size_t most_points = std::size_t{1} << 15U;  // 3 MB
  const Table& table = piece.table;
  for (std::size_t done = 0, count = 0; done < table.rows(); done += count) {
    const std::size_t first = piece.first + done;
    count = box_length(grid_, first, std::min(table.rows() - done, most_points));
    process_->ask([&](Connection& child) {
      child.send_one(GridRequest{GridTask::write, first, count});
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
        child.send_one(GridRequest{GridTask::read, first, table.rows()});
      },
      [&](Connection& child) {
        child.receive_all(table.column_of_verdicts());
        for (const Quantity quantity : quantities_) child.receive_all(table.column(quantity));
      });
}

void GridNetcdf::write_boundary(const std::vector<MapCurve>& boundary) {
  process_->ask([&](Connection& child) {
    child.send_one(GridRequest{GridTask::write_boundary, 0, boundary.size()});
    for (const MapCurve& curve : boundary) {
      child.send_one(curve.size());
      child.send_all(std::span(curve));
    }
  });
}

void GridNetcdf::write_target(std::span<const PlaceKind> kinds) {
  process_->ask([&](Connection& child) {
    child.send_one(GridRequest{GridTask::write_target, 0, kinds.size()});
    child.send_all(kinds);
  });
}

void GridNetcdf::flush() {
  process_->ask([](Connection& child) { child.send_one(GridRequest{GridTask::flush}); });
}

void GridNetcdf::close() {
  process_->ask([](Connection& child) { child.send_one(GridRequest{GridTask::close}); });
}

std::size_t netcdf_bytes(const GridContents& contents) {
  return contents.grid.size() * (1 + sizeof(double) * contents.quantities.size());
}

}  // namespace gearlash
