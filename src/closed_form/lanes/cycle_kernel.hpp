// The plain arrays between the batch and its kernels.
//
// The kernels' files are compiled for other processors than the rest and may share no inline
// function with it.
#pragma once

#include <cstddef>

namespace gearlash::detail {

/// A block of servos, one column for each quantity; a multiple of every vector's length.
struct CycleBlock {
  static constexpr std::size_t rows = 64;
  static constexpr std::size_t most_lanes = 16;  ///< of any kernel: two vectors of eight
  using Column = double[rows];

  alignas(64) Column damping;
  alignas(64) Column inertia_ratio;
  alignas(64) Column friction_ratio;
  alignas(64) Column backlash;

  alignas(64) Column outcome;  ///< of the values below
  alignas(64) Column growth_at_rest;
  /// As cycle_quantities; NaN if there is no cycle.
  static constexpr std::size_t property_count = 13;
  alignas(64) Column properties[property_count];

  static constexpr double uncertain = 0.0;  ///< to be solved one by one
  static constexpr double cannot_hunt = 1.0;
  static constexpr double hunts = 2.0;
};

/// Solves the first rows of the block (and those that fill up the last vectors). Assumes plastic
/// contact.
using CycleKernel = void (*)(CycleBlock& block, std::size_t rows);

/// Makes everything that a kernel calls one function with it: passing dozens of vectors through
/// memory costs time. Not in debug builds: with sanitizers such a function takes minutes to
/// compile.
#ifdef NDEBUG
#define GEARLASH_INLINED_WHOLE [[gnu::flatten]]
#else
#define GEARLASH_INLINED_WHOLE
#endif

void solve_block_baseline(CycleBlock& block, std::size_t rows);
void solve_block_avx2(CycleBlock& block, std::size_t rows);
void solve_block_avx512(CycleBlock& block, std::size_t rows);

}  // namespace gearlash::detail
