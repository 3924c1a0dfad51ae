#include "engine/scan/volume_reader.h"

#include <filesystem>
#include <utility>

#include "engine/io/slicer_markups.h"
#include "engine/io/text_fields.h"
#include "engine/scan/dicom_folder.h"
#include "engine/scan/nifti_file.h"
#include "engine/scan/nrrd_file.h"

namespace orthonav::engine {

Result<Volume> read_volume(const std::string& path, const std::string& series) {
  const auto named = [&path](Result<Volume> read) {
    return read ? std::move(read)
                : Result<Volume>(Error{path + ": " + read.error().message, read.error().code});
  };
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) {
    return named(read_dicom(path, series));
  }
  if (!std::filesystem::exists(path, code)) {
    return Error{path + ": no such file or folder", ErrorCode::kNotFound};
  }
  const std::string name = lower_case(path);
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) {
    return named(read_nifti(path));
  }
  if (name.ends_with(".nrrd")) {
    return named(read_nrrd(path));
  }
  if (is_dicom(path)) {
    return named(read_dicom(path, series));
  }
  if (Status s =
          check_no_scene(path, "export its volume as .nrrd and its segmentation as .seg.nrrd");
      !s) {
    return s.error();
  }
  return Error{path + ": must be .nii, .nii.gz, .nrrd, DICOM or a folder of it"};
}

}  // namespace orthonav::engine
