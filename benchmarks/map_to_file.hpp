// A map, from command to finished NetCDF file: what computing takes of it, and what writing.
#pragma once

#include "fastest_times.hpp"

namespace gearlash::benchmarks {

/// A map of 1000 × 1000 servos over the thesis's ranges, with every quantity, made as `gearlash map
/// --output FILE.nc` makes it, in the folder for temporary files; nothing is left there.
ReportPart enter_map_to_file();

}  // namespace gearlash::benchmarks
