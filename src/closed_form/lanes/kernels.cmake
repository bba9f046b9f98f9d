# Each kernel is compiled with the instructions of its vector unit; which one is called is decided
# when the program runs. Elsewhere than on x86 the baseline is all there is.
# Optimised in every build: unoptimised, xsimd's AVX-512 does not compile with gcc 12, and
# inline functions that the kernels share with other files would not be inlined.
set(kernels "${CMAKE_CURRENT_LIST_DIR}/cycle_kernel")
set(optimised "$<$<NOT:$<CONFIG:Release,RelWithDebInfo,MinSizeRel>>:-O2>")
# xsimd converts the exponents of all lanes to integers, those of lanes that are NaN as well, whose
# results it then leaves out; of SSE2 it does so number by number, which clang's sanitizer notices.
set(baseline -fno-sanitize=float-cast-overflow ${optimised})
if(EMSCRIPTEN)
  list(APPEND baseline -msimd128 -msse2)  # which Emscripten makes of WebAssembly's vectors
endif()
set_source_files_properties("${kernels}_baseline.cpp" PROPERTIES COMPILE_OPTIONS "${baseline}")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_definitions(gearlash_closed_form PRIVATE GEARLASH_X86_VECTOR_UNITS)
  # Sanitizers watch the baseline's kernel, which is the same template; of the others, some minutes'
  # compiling would be for nothing.
  set(avx2 -mavx2 -fno-sanitize=all)
  set(avx512 -mavx512f -mavx512cd -mavx512dq -mavx512bw -fno-sanitize=all)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms in gcc's own avx512fintrin.h (gcc bug 105593).
    list(APPEND avx512 -Wno-uninitialized -Wno-maybe-uninitialized)
  endif()
  set_source_files_properties("${kernels}_avx2.cpp" PROPERTIES COMPILE_OPTIONS
                              "${avx2};${optimised}")
  set_source_files_properties("${kernels}_avx512.cpp" PROPERTIES COMPILE_OPTIONS
                              "${avx512};${optimised}")
else()
  set_source_files_properties("${kernels}_avx2.cpp" "${kernels}_avx512.cpp" PROPERTIES
                              HEADER_FILE_ONLY ON)
endif()
