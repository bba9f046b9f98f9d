// The engine for hybrid systems beside integrators with root finding.
#pragma once

#include "fastest_times.hpp"

namespace gearlash::benchmarks {

/// A period of the thesis's sample servo, and a second of a drive with dry friction, faces that
/// give and a sampled PID controller, each with everything that happens on the way. Ours gives the
/// trajectory with its events, the rivals the state at the end. Throws std::runtime_error where
/// they do not agree on that.
ReportPart enter_hybrid_race();

}  // namespace gearlash::benchmarks
