# OpenCV's camera calibration and what it stands on, as the target OpenCVCalib3d::OpenCVCalib3d.
# Debian's OpenCVConfig.cmake comes with libopencv-dev alone, which brings every module and its
# dependencies; libopencv-calib3d-dev is enough for this.
find_path(OpenCVCalib3d_INCLUDE_DIR opencv2/calib3d.hpp PATH_SUFFIXES opencv4)
set(OpenCVCalib3d_LIBRARIES "")
set(opencv_calib3d_required OpenCVCalib3d_INCLUDE_DIR)
foreach(module calib3d imgproc core)
  find_library(OpenCVCalib3d_${module}_LIBRARY opencv_${module})
  list(APPEND opencv_calib3d_required OpenCVCalib3d_${module}_LIBRARY)
  list(APPEND OpenCVCalib3d_LIBRARIES "${OpenCVCalib3d_${module}_LIBRARY}")
endforeach()
include(FindPackageHandleStandardArgs)
include("${CMAKE_CURRENT_LIST_DIR}/OrthonavImported.cmake")
find_package_handle_standard_args(OpenCVCalib3d REQUIRED_VARS ${opencv_calib3d_required}
  REASON_FAILURE_MESSAGE "Debian: libopencv-calib3d-dev")
if(OpenCVCalib3d_FOUND)
  orthonav_imported(OpenCVCalib3d::OpenCVCalib3d
    LIBRARIES ${OpenCVCalib3d_LIBRARIES} INCLUDE_DIRS "${OpenCVCalib3d_INCLUDE_DIR}")
endif()
