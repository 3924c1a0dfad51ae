# The NIfTI library for both versions of the format, as the target Nifti2::Nifti2. Debian's own config file names
# programs of packages that are not needed here.
find_path(Nifti2_INCLUDE_DIR nifti2_io.h PATH_SUFFIXES nifti)
find_library(Nifti2_LIBRARY nifti2)
include(FindPackageHandleStandardArgs)
include("${CMAKE_CURRENT_LIST_DIR}/OrthonavImported.cmake")
find_package_handle_standard_args(Nifti2 REQUIRED_VARS Nifti2_LIBRARY Nifti2_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Debian: libnifti-dev")
if(Nifti2_FOUND)
  orthonav_imported(Nifti2::Nifti2 LIBRARIES "${Nifti2_LIBRARY}" INCLUDE_DIRS "${Nifti2_INCLUDE_DIR}")
endif()
