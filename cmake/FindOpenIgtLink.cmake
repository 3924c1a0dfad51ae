# OpenIGTLink, as the target OpenIgtLink::OpenIgtLink. Debian's OpenIGTLinkConfig.cmake sets flags and
# folders for whole projects.
find_path(OpenIgtLink_INCLUDE_DIR igtlTransformMessage.h PATH_SUFFIXES openigtlink)
find_library(OpenIgtLink_LIBRARY OpenIGTLink)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenIgtLink REQUIRED_VARS OpenIgtLink_LIBRARY OpenIgtLink_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "Debian: libopenigtlink-dev")
if(OpenIgtLink_FOUND AND NOT TARGET OpenIgtLink::OpenIgtLink)
  add_library(OpenIgtLink::OpenIgtLink INTERFACE IMPORTED)
  set_target_properties(OpenIgtLink::OpenIgtLink PROPERTIES
    INTERFACE_LINK_LIBRARIES "${OpenIgtLink_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OpenIgtLink_INCLUDE_DIR}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OpenIgtLink_INCLUDE_DIR}")
endif()
