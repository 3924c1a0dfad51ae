# When cross-compiling: AprilTag as the target apriltag::apriltag, from the headers of this machine's package and the
# library of the other architecture. libapriltag-dev can be installed for one architecture only, and its CMake files name
# that one's library; the headers are the same for all.
if(CMAKE_CROSSCOMPILING AND NOT TARGET apriltag::apriltag)
  find_library(APRILTAG_LIBRARY NAMES apriltag libapriltag.so.3 REQUIRED)
  find_path(APRILTAG_INCLUDE_DIR apriltag.h PATH_SUFFIXES apriltag REQUIRED)
  add_library(apriltag::apriltag SHARED IMPORTED GLOBAL)
  set_target_properties(apriltag::apriltag PROPERTIES
    IMPORTED_LOCATION "${APRILTAG_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${APRILTAG_INCLUDE_DIR}")
endif()
