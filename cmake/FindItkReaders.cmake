# The readers of the Insight Toolkit for DICOM, NIfTI and NRRD, as the target ItkReaders::ItkReaders.
# ITKConfig.cmake would look for every module's dependencies (HDF5, curl, executables of GDCM).
find_path(ItkReaders_INCLUDE_DIR itkImageIOBase.h PATH_SUFFIXES ITK-5.4 ITK-5.3 ITK-5.2)
find_path(ItkReaders_GDCM_INCLUDE_DIR gdcmTrace.h PATH_SUFFIXES gdcm-3.0)
set(ItkReaders_LIBRARIES "")
set(itk_readers_required ItkReaders_INCLUDE_DIR ItkReaders_GDCM_INCLUDE_DIR)
foreach(module ITKIOGDCM ITKIONIFTI ITKIONRRD ITKIOImageBase ITKCommon itksys itkvnl
        gdcmCommon)
  find_library(ItkReaders_${module}_LIBRARY NAMES ${module}-5.4 ${module}-5.3 ${module}-5.2 ${module})
  list(APPEND itk_readers_required ItkReaders_${module}_LIBRARY)
  list(APPEND ItkReaders_LIBRARIES "${ItkReaders_${module}_LIBRARY}")
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ItkReaders REQUIRED_VARS ${itk_readers_required}
  REASON_FAILURE_MESSAGE "Debian: libinsighttoolkit5-dev")
if(ItkReaders_FOUND AND NOT TARGET ItkReaders::ItkReaders)
  add_library(ItkReaders::ItkReaders INTERFACE IMPORTED)
  set_target_properties(ItkReaders::ItkReaders PROPERTIES
    INTERFACE_LINK_LIBRARIES "${ItkReaders_LIBRARIES}"
    INTERFACE_INCLUDE_DIRECTORIES "${ItkReaders_INCLUDE_DIR};${ItkReaders_GDCM_INCLUDE_DIR}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${ItkReaders_INCLUDE_DIR};${ItkReaders_GDCM_INCLUDE_DIR}")
endif()
