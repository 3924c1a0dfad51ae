# orthonav_library(NAME folder) makes the static library orthonav_NAME, alias orthonav::NAME, of
# every .cpp directly in the calling folder (or in the folders given as SOURCES_IN).
function(orthonav_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES_IN" ${ARGN})
  if(NOT ARG_SOURCES_IN)
    set(ARG_SOURCES_IN ".")
  endif()
  set(sources "")
  foreach(folder IN LISTS ARG_SOURCES_IN)
    file(GLOB found CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp")
    list(APPEND sources ${found})
  endforeach()
  add_library(orthonav_${name} STATIC ${sources})
  add_library(orthonav::${name} ALIAS orthonav_${name})
  target_include_directories(orthonav_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/orthonav>)
  target_compile_features(orthonav_${name} PUBLIC cxx_std_20)
  set_target_properties(orthonav_${name} PROPERTIES EXPORT_NAME ${name})
  orthonav_warnings(orthonav_${name})
  set_property(GLOBAL APPEND PROPERTY ORTHONAV_LIBRARIES orthonav_${name})
endfunction()

function(orthonav_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Werror -Wshadow
    -Wconversion -Wno-sign-conversion -Wno-missing-field-initializers
    -Wnon-virtual-dtor -Woverloaded-virtual)
  # GCC 12 sees overlapping copies in plain "text" + std::string (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
endfunction()

# orthonav_uses_regex(FILES...): under AddressSanitizer GCC 12 sees <regex> use what it has not set, and
# is wrong (GCC bug 105562).
function(orthonav_uses_regex)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND ORTHONAV_SANITIZE MATCHES "address")
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -Wno-maybe-uninitialized)
  endif()
endfunction()

# orthonav_test(NAME [SHARDS N] libs...) makes one test binary of every .cpp in the calling folder.
# Each test is a process of its own; with SHARDS N all run in N processes, for tests that share what is
# slow to make.
function(orthonav_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "SHARDS" "")
  find_package(GTest REQUIRED)
  include(GoogleTest)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE ${test_UNPARSED_ARGUMENTS} GTest::gmock GTest::gtest_main)
  target_include_directories(test_${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_compile_definitions(test_${name} PRIVATE
    ORTHONAV_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    ORTHONAV_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
  orthonav_warnings(test_${name})
  # What is tested is optimized; the tests themselves are compiled in two thirds of the time so.
  target_compile_options(test_${name} PRIVATE "$<$<CONFIG:Release>:-O1>")
  # A whole operation of 45 s takes ten minutes under ThreadSanitizer, several at a time longer.
  set(timeout 600)
  if(ORTHONAV_SANITIZE)
    set(timeout 3600)
  endif()
  if(test_SHARDS)
    math(EXPR shard_timeout "2 * ${timeout}")
    foreach(shard RANGE 1 ${test_SHARDS})
      math(EXPR index "${shard} - 1")
      add_test(NAME ${name}.shard_${shard} COMMAND test_${name} --gtest_brief=1)
      set_tests_properties(${name}.shard_${shard} PROPERTIES TIMEOUT ${shard_timeout} COST 300 ENVIRONMENT
        "GTEST_TOTAL_SHARDS=${test_SHARDS};GTEST_SHARD_INDEX=${index}")
    endforeach()
    return()
  endif()
  gtest_discover_tests(test_${name} DISCOVERY_MODE PRE_TEST TEST_PREFIX "${name}."
                       PROPERTIES TIMEOUT ${timeout})
endfunction()
