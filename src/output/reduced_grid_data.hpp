// What a sweep keeps, as a NetCDF file and as text.
#pragma once

#include <string>

#include "analysis/grid/reduced_grid.hpp"
#include "output/grid_description.hpp"
#include "output/output_file.hpp"

namespace gearlash {

/// The shares of the quantiles that are reported.
inline constexpr double reported_shares[] = {0.0,  0.001, 0.01, 0.05,  0.25, 0.5,
                                             0.75, 0.95,  0.99, 0.999, 1.0};

/// A NetCDF-4 file by the CF conventions 1.8 with the axes, the fixed numbers and the attributes of
/// GridNetcdf, and in place of the points, as far as it is kept (q: the name of a quantity, a: the
/// column of an axis):
///
///   points(verdict), points_by_a(a, verdict)          numbers of points
///   q_known                                           number of points at which q is known
///   q_extreme(extreme), q_extreme_a(extreme)          smallest and largest value, and where first
///   q_bin_from, q_bin_to, q_bin_points(q_bin)         bins with points, rising; infinities too
///   q_quantile(share)                                 with the attribute relative_accuracy
///   border_verdict, border_a(border_point)            the border's points
///
/// Throws OutputError.
void write_reduced_netcdf(const GridContents& contents, ReducedGrid& reduced,
                          const OutputFile& output);

/// Tables for a reader: the counts by verdict, each quantity's extremes and quantiles, where the
/// extremes are, and the length of the border.
std::string reduced_text(const GridContents& contents, ReducedGrid& reduced);

}  // namespace gearlash
