# HDF5 without MPI, as the target Hdf5Serial::Hdf5Serial. By pkg-config's folder, Debian's hdf5/serial, programs would
# look for it in a folder of their own (RPATH); the library lies among all others as well.
find_path(Hdf5Serial_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(Hdf5Serial_LIBRARY NAMES hdf5_serial hdf5)
include(FindPackageHandleStandardArgs)
include("${CMAKE_CURRENT_LIST_DIR}/OrthonavImported.cmake")
find_package_handle_standard_args(Hdf5Serial REQUIRED_VARS Hdf5Serial_LIBRARY Hdf5Serial_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Debian: libhdf5-dev")
if(Hdf5Serial_FOUND)
  orthonav_imported(Hdf5Serial::Hdf5Serial LIBRARIES "${Hdf5Serial_LIBRARY}" INCLUDE_DIRS "${Hdf5Serial_INCLUDE_DIR}")
endif()
