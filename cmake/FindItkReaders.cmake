# Of the Insight Toolkit: the readers for DICOM (with GDCM, on which that one is built) and NRRD as the target
# ItkReaders::ItkReaders, and those of transforms with their writers, which tests hold ours against, as
# ItkReaders::ItkTransforms.
# ITKConfig.cmake would look for every module's dependencies (HDF5, curl, executables of GDCM).
find_path(ItkReaders_INCLUDE_DIR itkImageIOBase.h PATH_SUFFIXES ITK-5.4 ITK-5.3 ITK-5.2)
find_path(ItkReaders_GDCM_INCLUDE_DIR gdcmTrace.h PATH_SUFFIXES gdcm-3.0)
set(itk_readers_required ItkReaders_INCLUDE_DIR ItkReaders_GDCM_INCLUDE_DIR)
set(itk_readers ITKIOGDCM ITKIONRRD ITKIOImageBase ITKCommon itksys itkvnl gdcmMSFF gdcmDICT gdcmDSED gdcmCommon)
set(itk_transforms ITKIOTransformHDF5 ITKIOTransformInsightLegacy ITKIOTransformBase ITKTransformFactory ITKTransform
    ITKCommon itksys itkvnl)
foreach(group itk_readers itk_transforms)
  set(${group}_libraries "")
  foreach(module IN LISTS ${group})
    find_library(ItkReaders_${module}_LIBRARY NAMES ${module}-5.4 ${module}-5.3 ${module}-5.2 ${module})
    list(APPEND itk_readers_required ItkReaders_${module}_LIBRARY)
    list(APPEND ${group}_libraries "${ItkReaders_${module}_LIBRARY}")
  endforeach()
endforeach()
list(REMOVE_DUPLICATES itk_readers_required)
include(FindPackageHandleStandardArgs)
include("${CMAKE_CURRENT_LIST_DIR}/OrthonavImported.cmake")
find_package_handle_standard_args(ItkReaders REQUIRED_VARS ${itk_readers_required}
  REASON_FAILURE_MESSAGE "Debian: libinsighttoolkit5-dev")
if(ItkReaders_FOUND)
  set(itk_folders "${ItkReaders_INCLUDE_DIR}" "${ItkReaders_GDCM_INCLUDE_DIR}")
  orthonav_imported(ItkReaders::ItkReaders LIBRARIES ${itk_readers_libraries} INCLUDE_DIRS ${itk_folders})
  orthonav_imported(ItkReaders::ItkTransforms LIBRARIES ${itk_transforms_libraries} INCLUDE_DIRS ${itk_folders})
endif()
