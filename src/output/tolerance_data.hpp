// The behaviour of a production run, as data for other programs.
#pragma once

#include "output/output_file.hpp"
#include "output/tolerance_report.hpp"

namespace gearlash {

/// One row for each estimate: the quantity, its argument (a share of samples, a parameter's path, a
/// bin of the histogram), its value and its standard error. Amplitudes are in rad, frequencies in
/// Hz.
void write_tolerance_csv(const ToleranceReport& report, const TextSink& sink);

/// Writes NetCDF-4 instead of calling output.write(): quantiles over `share`, indices over `number`
/// (its flag_meanings are the parameters' names), and the histogram over `bin` with its edges. Each
/// has its standard error in a variable NAME_standard_error. The file follows the CF conventions
/// 1.8 and holds the provenance. Throws OutputError.
void write_tolerance_netcdf(const ToleranceReport& report, const OutputFile& output);

}  // namespace gearlash
