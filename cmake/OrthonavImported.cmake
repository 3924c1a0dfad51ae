# orthonav_imported(TARGET LIBRARIES libraries... INCLUDE_DIRS folders...) makes an imported target of a library that a
# Find module found. Headers in the folders are the system's: nothing there is warned of.
function(orthonav_imported target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "LIBRARIES;INCLUDE_DIRS")
  if(TARGET ${target})
    return()
  endif()
  add_library(${target} INTERFACE IMPORTED)
  set_target_properties(${target} PROPERTIES
    INTERFACE_LINK_LIBRARIES "${ARG_LIBRARIES}"
    INTERFACE_INCLUDE_DIRECTORIES "${ARG_INCLUDE_DIRS}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${ARG_INCLUDE_DIRS}")
endfunction()
