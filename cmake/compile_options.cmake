# Options for everything compiled in this tree and nothing else. Third-party packages are imported
# targets, whose headers CMake treats as system headers (without warnings). A project that embeds
# Gearlash is not below this directory.

if(NOT CMAKE_CXX_STANDARD GREATER_EQUAL 20)  # a project around this one may ask for a later one
  set(CMAKE_CXX_STANDARD 20)
endif()
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT EMSCRIPTEN)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)  # static libraries can go into a shared Python module
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)    # for clang-tidy and editors

# Gearlash promises the same bits from every build. A compiler may otherwise contract a*b + c into
# one fused operation if the machine has it (gcc across statements, clang within expressions), so
# that two compilers or two machines round differently. -ffast-math is excluded for the same reason;
# it also breaks the infinities and NaNs that mark degenerate servos.
add_compile_options(-ffp-contract=off)

add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wold-style-cast)
# Where files share a compilation, a local name may be that of another file's function.
if(NOT CMAKE_UNITY_BUILD)
  add_compile_options(-Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-Wshadow=local)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms on every `"text" + std::string` (gcc bug 105651, fixed in gcc 13), and on lists of
  # lists as default arguments.
  add_compile_options(-Wno-restrict -Wno-maybe-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # It collects its garbage only from two gigabytes on: a fifth less to compile.
  add_compile_options(--param=ggc-min-heapsize=2000000)
endif()
if(GEARLASH_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

if(EMSCRIPTEN)
  # Exceptions of WebAssembly itself: those made of JavaScript are slow and large.
  add_compile_options(-fwasm-exceptions)
  # A page is fetched before it runs. Loops are few and small beside what they call.
  add_compile_options(-fno-unroll-loops)
  add_link_options(-fwasm-exceptions)
  # Not ahead of Emscripten's own C library: see emscripten.cmake.
  list(APPEND CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES /usr/include)
endif()

# Precompiles heavy third-party headers for all files of a target. Not with gcc 12: it would save
# only half a second for each file (<Eigen/Core> or gmock), its optimiser then warns of the standard
# library's strings, and ccache keeps nothing that was compiled with a precompiled header.
function(gearlash_read_once target)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# Level 3 is for the innermost loops, in numeric, closed_form and hybrid: up to a third faster than
# at level 2. What calls them runs as fast at level 2, and what judges, reads or writes at level 1,
# which compiles sooner. Tests need no more either.
function(gearlash_optimise target level)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O${level}>)
  if(level LESS 2)  # a debug build may optimise what calculates
    target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-O0>)
  endif()
  if(EMSCRIPTEN AND level LESS 2)  # a tenth smaller
    target_compile_options(${target} PRIVATE "SHELL:-mllvm -inline-threshold=20")
  endif()
endfunction()
