option(ORTHONAV_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(ORTHONAV_BUILD_BENCH "Build the benchmarks" OFF)
option(ORTHONAV_HEADSET "Only what runs on a headset: no window, no voice, no video, no command" OFF)
option(ORTHONAV_PYTHON "Build the Python module" OFF)
set(ORTHONAV_SANITIZE "" CACHE STRING "Sanitizers for every target: address,undefined or thread")
option(ORTHONAV_FUZZ "Build the fuzzers of tests/fuzz (clang)" OFF)
option(ORTHONAV_UNITY "Compile several sources as one: a full build takes less than half the time" ON)
set(ORTHONAV_UNITY_BATCH 32 CACHE STRING "How many sources are compiled as one")
option(ORTHONAV_WARNINGS "Warn, and end the build at a warning: for those who change the code"
  ${PROJECT_IS_TOP_LEVEL})
option(ORTHONAV_COVERAGE "Instrument for line coverage" OFF)
option(ORTHONAV_CCACHE "Compile through ccache, where it is installed"
  ${PROJECT_IS_TOP_LEVEL})

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

find_program(CCACHE_PROGRAM ccache)
if(ORTHONAV_CCACHE AND CCACHE_PROGRAM)
  # Without this, ccache does not cache anything compiled with a precompiled header. Found by the files that it read
  # (CCACHE_DEPEND), a source is not preprocessed once more for ccache alone.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

# The same digits at every optimisation level: no implicit fused multiply-add.
add_compile_options(-ffp-contract=off)
# Reproducible objects that every checkout can share: no absolute paths in them.
add_compile_options("-ffile-prefix-map=${PROJECT_SOURCE_DIR}=.")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC collects garbage less often: 10 % less time, for 1.4 GB of memory instead of 1.1.
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:--param ggc-min-expand=400 --param ggc-min-heapsize=1048576>")
endif()

if(ORTHONAV_SANITIZE OR ORTHONAV_FUZZ)
  # As in release (OrthonavHardening.cmake).
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
if(ORTHONAV_SANITIZE)
  add_compile_options("-fsanitize=${ORTHONAV_SANITIZE}" -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  add_link_options("-fsanitize=${ORTHONAV_SANITIZE}")
endif()
if(ORTHONAV_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "ORTHONAV_FUZZ needs clang: libFuzzer comes with it")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(ORTHONAV_COVERAGE)
  add_compile_options(--coverage -fprofile-update=atomic)
  add_link_options(--coverage)
endif()
