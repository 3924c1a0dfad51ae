# orthonav_hardened(target): in a release build our code ends at the first overflow that these checks catch
# (docs/decisions/0095-a-hardened-build.md has the cost). The options are private: users who link
# our libraries choose for themselves. Programs are also position independent, and their relocation
# tables read-only once loaded.
option(ORTHONAV_HARDEN "Harden release builds" ON)
include(CheckPIESupported)
check_pie_supported(LANGUAGES C CXX)

function(orthonav_hardened target)
  # Sanitizers and fuzzers check more, and conflict with some of these.
  if(NOT ORTHONAV_HARDEN OR ORTHONAV_SANITIZE OR ORTHONAV_FUZZ)
    return()
  endif()
  target_compile_definitions(${target} PRIVATE
    "$<$<CONFIG:Release>:_FORTIFY_SOURCE=3;_GLIBCXX_ASSERTIONS>")
  target_compile_options(${target} PRIVATE
    "$<$<CONFIG:Release>:-fstack-protector-strong;-fstack-clash-protection>")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(${target} PRIVATE "$<$<CONFIG:Release>:-fcf-protection>")
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE" OR type STREQUAL "MODULE_LIBRARY")
    target_link_options(${target} PRIVATE "$<$<CONFIG:Release>:LINKER:-z,relro,-z,now,-z,noexecstack>")
  endif()
endfunction()
