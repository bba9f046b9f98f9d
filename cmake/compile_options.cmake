# Options for everything compiled in this tree, and for nothing else: third-party packages come in
# as imported targets, whose headers CMake treats as system headers (no warnings from them), and a
# project that embeds Gearlash is not below this directory.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)  # static libraries can go into a shared Python module
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)    # for clang-tidy and editors

# Gearlash promises the same bits from every build. A compiler may otherwise contract a*b + c into
# one fused operation where the machine has it, gcc across statements, clang within expressions, so
# that two compilers, or two machines, round differently. For the same reason never -ffast-math:
# it also breaks the infinities and NaNs by which degenerate servos are told.
add_compile_options(-ffp-contract=off)

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion
                    -Wold-style-cast)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarm on every `"text" + std::string` (gcc bug 105651, mended in gcc 13).
  add_compile_options(-Wno-restrict)
endif()
if(GEARLASH_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

# Heavy headers of others, read once for all files of a target. Not with gcc 12: it saves half a
# second a file (<Eigen/Core> or gmock), its optimiser then warns of the standard library's own
# strings, and ccache keeps nothing that was compiled with a precompiled header.
function(gearlash_read_once target)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# What reads, words and writes waits for a disk, a terminal or a plotter, not for its loops: optimised
# a little it runs as fast and compiles a quarter sooner; its tests need no optimiser at all.
function(gearlash_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O${level}>)
endfunction()
