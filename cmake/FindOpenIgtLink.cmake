# OpenIGTLink, as the target OpenIgtLink::OpenIgtLink. Debian's OpenIGTLinkConfig.cmake sets flags and
# folders for whole projects.
find_path(OpenIgtLink_INCLUDE_DIR igtlTransformMessage.h PATH_SUFFIXES openigtlink)
find_library(OpenIgtLink_LIBRARY OpenIGTLink)
include(FindPackageHandleStandardArgs)
include("${CMAKE_CURRENT_LIST_DIR}/OrthonavImported.cmake")
find_package_handle_standard_args(OpenIgtLink REQUIRED_VARS OpenIgtLink_LIBRARY OpenIgtLink_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Debian: libopenigtlink-dev")
if(OpenIgtLink_FOUND)
  orthonav_imported(OpenIgtLink::OpenIgtLink LIBRARIES "${OpenIgtLink_LIBRARY}" INCLUDE_DIRS "${OpenIgtLink_INCLUDE_DIR}")
endif()
