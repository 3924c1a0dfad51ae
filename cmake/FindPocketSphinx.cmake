# PocketSphinx and SphinxBase, as the target PocketSphinx::PocketSphinx. Debian's pocketsphinx.pc
# names an include folder that is not there, which CMake refuses in an imported target.
find_path(PocketSphinx_INCLUDE_DIR pocketsphinx.h PATH_SUFFIXES pocketsphinx)
find_path(PocketSphinx_BASE_INCLUDE_DIR sphinxbase/err.h)
find_library(PocketSphinx_LIBRARY pocketsphinx)
find_library(PocketSphinx_BASE_LIBRARY sphinxbase)
include(FindPackageHandleStandardArgs)
include("${CMAKE_CURRENT_LIST_DIR}/OrthonavImported.cmake")
find_package_handle_standard_args(PocketSphinx REQUIRED_VARS PocketSphinx_LIBRARY
  PocketSphinx_BASE_LIBRARY PocketSphinx_INCLUDE_DIR PocketSphinx_BASE_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Debian: libpocketsphinx-dev libsphinxbase-dev")
if(PocketSphinx_FOUND)
  orthonav_imported(PocketSphinx::PocketSphinx
    LIBRARIES "${PocketSphinx_LIBRARY}" "${PocketSphinx_BASE_LIBRARY}"
    INCLUDE_DIRS "${PocketSphinx_INCLUDE_DIR}" "${PocketSphinx_BASE_INCLUDE_DIR}"
      "${PocketSphinx_BASE_INCLUDE_DIR}/sphinxbase")
endif()
