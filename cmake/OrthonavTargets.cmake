# Users write <orthonav/nav/...>; the headers themselves name each other as here, "nav/...", for which the
# folder orthonav is on the path as well.
#
# orthonav_library(NAME [NOT_INSTALLED] [COLD | EIGEN] [SOURCES_IN folders... | FILES files...]
#                  [EXCEPT files...] [INTERNAL folders...])
# makes the static library orthonav_NAME, alias orthonav::NAME, of every .cpp directly in the calling
# folder, in the folders SOURCES_IN, or of FILES; without the files named after EXCEPT. The headers
# beside them are installed with it, but those in the folders INTERNAL, by which it is made. COLD: its
# speed does not matter, so it is optimized less and compiles faster; the results are the same to
# the bit. EIGEN: most of it computes with Eigen.
function(orthonav_library name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "NOT_INSTALLED;COLD;EIGEN" "" "SOURCES_IN;FILES;EXCEPT;INTERNAL")
  if(NOT ARG_SOURCES_IN AND NOT ARG_FILES)
    set(ARG_SOURCES_IN ".")
  endif()
  set(sources ${ARG_FILES})
  foreach(folder IN LISTS ARG_SOURCES_IN)
    file(GLOB found CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp")
    list(APPEND sources ${found})
  endforeach()
  set(headers "")
  foreach(file IN LISTS ARG_FILES)
    string(REGEX REPLACE "cpp$" "h" header "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
    if(EXISTS "${header}")
      list(APPEND headers "${header}")
    endif()
  endforeach()
  list(REMOVE_ITEM ARG_SOURCES_IN ${ARG_INTERNAL})
  foreach(folder IN LISTS ARG_SOURCES_IN)
    file(GLOB found CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.h")
    list(APPEND headers ${found})
  endforeach()
  list(TRANSFORM headers REPLACE "/[.]/" "/")
  foreach(file IN LISTS ARG_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "/${file}$")
    string(REGEX REPLACE "cpp$" "h" header "${file}")
    list(FILTER headers EXCLUDE REGEX "/${header}$")
  endforeach()
  add_library(orthonav_${name} STATIC ${sources})
  add_library(orthonav::${name} ALIAS orthonav_${name})
  target_include_directories(orthonav_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR};${CMAKE_INSTALL_INCLUDEDIR}/orthonav>")
  target_compile_features(orthonav_${name} PUBLIC cxx_std_20)
  set_target_properties(orthonav_${name} PROPERTIES EXPORT_NAME ${name})
  orthonav_warnings(orthonav_${name})
  orthonav_hardened(orthonav_${name})
  orthonav_unity(orthonav_${name})
  if(ARG_COLD)
    orthonav_cold(orthonav_${name})
    orthonav_precompiled(orthonav_${name} COLD)
  elseif(ARG_EIGEN)
    # The more of Eigen's types a unit has met, the longer GCC takes to resolve each of its operators: in units of
    # eight sources nav compiles in a tenth less time.
    set_target_properties(orthonav_${name} PROPERTIES UNITY_BUILD_BATCH_SIZE 8)
    orthonav_precompiled(orthonav_${name} EIGEN <Eigen/Dense>)
  else()
    orthonav_precompiled(orthonav_${name} FAST)
  endif()
  if(NOT ARG_NOT_INSTALLED)
    set_property(GLOBAL APPEND PROPERTY ORTHONAV_LIBRARIES orthonav_${name})
    target_sources(orthonav_${name} PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}" FILES ${headers})
    set_property(GLOBAL APPEND PROPERTY ORTHONAV_HEADERS ${headers})
  endif()
endfunction()

# Several sources are compiled as one, so that headers are read once for all of them.
function(orthonav_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${ORTHONAV_UNITY}
    UNITY_BUILD_BATCH_SIZE ${ORTHONAV_UNITY_BATCH})
endfunction()

function(orthonav_cold target)
  target_compile_options(${target} PRIVATE "$<$<CONFIG:Release>:-O1>")
endfunction()

function(orthonav_warnings target)
  if(NOT ORTHONAV_WARNINGS)
    return()
  endif()
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Werror -Wshadow
    -Wconversion -Wno-sign-conversion -Wno-missing-field-initializers
    -Wnon-virtual-dtor -Woverloaded-virtual)
  # GCC 12 wrongly warns of overlapping copies in plain "text" + std::string (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
    # In instrumented code it also wrongly warns of uninitialized values: of what an empty optional would hold, and
    # within <regex> (GCC bug 105562).
    if(ORTHONAV_SANITIZE OR ORTHONAV_COVERAGE)
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
  endif()
  # Without optimisation, or with sanitizers, a loop need not be vectorized.
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_compile_options(${target} PRIVATE -Wno-pass-failed)
  endif()
endfunction()

# The standard library's headers that most sources include, and those given, read once for all libraries of a group,
# which are compiled with the same options: they are precompiled for the first and used by the others. Only where
# warnings are off (ORTHONAV_WARNINGS, as in tools/demo): a missing include would be hidden, and GCC 12 wrongly warns
# of overflows in strings that come from a precompiled header.
function(orthonav_precompiled target group)
  if(ORTHONAV_WARNINGS OR NOT ORTHONAV_UNITY OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  target_compile_options(${target} PRIVATE -Wno-stringop-overflow -Wno-stringop-overread)
  get_property(first GLOBAL PROPERTY ORTHONAV_PRECOMPILED_${group})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
    return()
  endif()
  set_property(GLOBAL PROPERTY ORTHONAV_PRECOMPILED_${group} ${target})
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional>
    <map> <memory> <numbers> <optional> <span> <sstream> <string> <thread> <variant> <vector> ${ARGN})
endfunction()

# orthonav_support(NAME sources...) makes the static library orthonav_NAME of what tests and benchmarks share.
function(orthonav_support name)
  add_library(orthonav_${name} STATIC ${ARGN})
  target_include_directories(orthonav_${name} PUBLIC "${PROJECT_SOURCE_DIR}")
  target_compile_definitions(orthonav_${name} PRIVATE
    ORTHONAV_SOURCE_DIR="${PROJECT_SOURCE_DIR}" ORTHONAV_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  orthonav_warnings(orthonav_${name})
  orthonav_unity(orthonav_${name})
endfunction()

# The headers that nearly every test includes, read once for all of them. Each test still includes
# what it uses: without ORTHONAV_UNITY nothing is precompiled.
function(orthonav_test_headers target)
  if(NOT ORTHONAV_UNITY)
    return()
  endif()
  get_property(first GLOBAL PROPERTY ORTHONAV_TEST_HEADERS)
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
    return()
  endif()
  set_property(GLOBAL PROPERTY ORTHONAV_TEST_HEADERS ${target})
  target_precompile_headers(${target} PRIVATE <gmock/gmock.h> <gtest/gtest.h> <algorithm> <array> <chrono>
    <cmath> <filesystem> <fstream> <functional> <map> <memory> <nlohmann/json.hpp> <numbers> <optional>
    <string> <thread> <variant> <vector>)
endfunction()

# orthonav_test(NAME [IN folder] [SHARDS N | TOGETHER "suite;..."] [COST n] [COMPUTES] libs...) makes one test program
# of every .cpp in the folder, which is the calling one unless it is named. COMPUTES: the tests themselves
# compute so much that they are optimized; they then can't share the precompiled header, which is
# built without optimization. Each test is a process of its own; with SHARDS N all run in N
# processes, and with TOGETHER each of these suites runs in one, for tests that share what is slow to make. Tests of
# greater COST start earlier, so that none of the long ones is left for the end.
function(orthonav_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "COMPUTES" "IN;SHARDS;COST;TOGETHER" "")
  find_package(GTest REQUIRED)
  include(GoogleTest)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${test_IN}/*.cpp")
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE ${test_UNPARSED_ARGUMENTS} orthonav_keep_drivers
    GTest::gmock GTest::gtest_main)
  target_include_directories(test_${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_compile_definitions(test_${name} PRIVATE
    ORTHONAV_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    ORTHONAV_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  orthonav_warnings(test_${name})
  orthonav_unity(test_${name})
  # The tested code is optimized, the tests are not: that takes three quarters of the time to
  # compile.
  if(test_COMPUTES)
    orthonav_cold(test_${name})
  else()
    orthonav_test_headers(test_${name})
    target_compile_options(test_${name} PRIVATE "$<$<CONFIG:Release>:-O0>")
  endif()
  # A whole operation of 45 s takes ten minutes under ThreadSanitizer or an emulator, and longer when
  # several run at once.
  set(timeout 600)
  if(ORTHONAV_SANITIZE OR CMAKE_CROSSCOMPILING_EMULATOR)
    set(timeout 3600)
  endif()
  if(test_SHARDS)
    math(EXPR shard_timeout "2 * ${timeout}")
    if(NOT test_COST)
      set(test_COST 300)
    endif()
    foreach(shard RANGE 1 ${test_SHARDS})
      math(EXPR index "${shard} - 1")
      add_test(NAME ${name}.shard_${shard} COMMAND test_${name} --gtest_brief=1)
      set_tests_properties(${name}.shard_${shard} PROPERTIES TIMEOUT ${shard_timeout} COST ${test_COST} ENVIRONMENT
        "GTEST_TOTAL_SHARDS=${test_SHARDS};GTEST_SHARD_INDEX=${index}")
    endforeach()
    return()
  endif()
  set(properties TIMEOUT ${timeout})
  if(test_COST)
    list(APPEND properties COST ${test_COST})
  endif()
  set(others "")
  foreach(suite IN LISTS test_TOGETHER)
    add_test(NAME ${name}.${suite} COMMAND test_${name} --gtest_brief=1 "--gtest_filter=${suite}.*")
    set_tests_properties(${name}.${suite} PROPERTIES ${properties})
  endforeach()
  if(test_TOGETHER)
    list(JOIN test_TOGETHER ".*:" suites)
    set(others TEST_FILTER "-${suites}.*")
  endif()
  gtest_discover_tests(test_${name} DISCOVERY_MODE PRE_TEST TEST_PREFIX "${name}." ${others}
                       PROPERTIES ${properties})
endfunction()
