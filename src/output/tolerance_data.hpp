// What a production run will do, as data for other programs.
#pragma once

#include "output/output_file.hpp"
#include "output/tolerance_report.hpp"

namespace gearlash {

/// A row an estimate: what it is, of what (a share of samples, a parameter's path, a step of the
/// histogram), its value and its standard error; amplitudes in rad, frequencies in Hz.
void write_tolerance_csv(const ToleranceReport& report, const TextSink& sink);

/// NetCDF-4, in place of output.write(): quantiles over `share`, indices over `number` (whose names
/// are its flag_meanings), the histogram over `bin` with its edges, each with its standard error as
/// a variable NAME_standard_error; CF conventions 1.8 and provenance. Throws OutputError.
void write_tolerance_netcdf(const ToleranceReport& report, const OutputFile& output);

}  // namespace gearlash
