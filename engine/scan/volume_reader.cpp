#include "engine/scan/volume_reader.h"

#ifdef __clang__
// Debian's ITK was configured for GCC and refuses other compilers. Clang reads this file for its
// checks; of the skipped definitions it needs these two.
#define ITK_COMPILER_DETECTION_H
#define ITK_NOEXCEPT noexcept
#define ITK_NOEXCEPT_EXPR(X) noexcept(X)
#endif
#include <gdcmTrace.h>
#include <itkGDCMImageIO.h>
#include <itkMetaDataObject.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>

#include "engine/scan/dicom_fields.h"
#include "engine/scan/dicom_order.h"
#include "engine/scan/nifti_header.h"
#include "engine/scan/whole_file.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;
using itk::IOComponentEnum;

/// An exception of ITK as one line: its description ends with the file and line of its source.
Error refused(const std::string& path, const itk::ExceptionObject& error) {
  std::string what = error.GetDescription();
  what = what.substr(0, what.find('\n'));
  if (const auto object = what.find("): "); object != std::string::npos) {
    what.erase(0, object + 3);  // "ITK ERROR: GDCMImageIO(0x...): "
  }
  return Error{path + ": can't be read: " + (what.empty() ? "unknown format" : what)};
}

template <class T>
void append_as_floats(const std::vector<char>& bytes, std::vector<float>& values) {
  const std::size_t count = bytes.size() / sizeof(T);
  values.reserve(values.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    T value{};
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    values.push_back(static_cast<float>(value));
  }
}

Status append(IOComponentEnum type, const std::vector<char>& bytes, std::vector<float>& values) {
  switch (type) {
    case IOComponentEnum::UCHAR:
      append_as_floats<unsigned char>(bytes, values);
      return {};
    case IOComponentEnum::CHAR:
      append_as_floats<signed char>(bytes, values);
      return {};
    case IOComponentEnum::USHORT:
      append_as_floats<unsigned short>(bytes, values);
      return {};
    case IOComponentEnum::SHORT:
      append_as_floats<short>(bytes, values);
      return {};
    case IOComponentEnum::UINT:
      append_as_floats<unsigned int>(bytes, values);
      return {};
    case IOComponentEnum::INT:
      append_as_floats<int>(bytes, values);
      return {};
    case IOComponentEnum::ULONG:
      append_as_floats<unsigned long>(bytes, values);
      return {};
    case IOComponentEnum::LONG:
      append_as_floats<long>(bytes, values);
      return {};
    case IOComponentEnum::FLOAT:
      append_as_floats<float>(bytes, values);
      return {};
    case IOComponentEnum::DOUBLE:
      append_as_floats<double>(bytes, values);
      return {};
    default:
      return Error{"voxels of an unknown type"};
  }
}

/// The voxels of what `io` was told to read.
Status read_voxels(itk::ImageIOBase& io, std::vector<float>& values) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  itk::ImageIORegion region(dimensions);
  for (unsigned d = 0; d < dimensions; ++d) {
    region.SetIndex(d, 0);
    region.SetSize(d, io.GetDimensions(d));
  }
  io.SetIORegion(region);
  std::vector<char> bytes(static_cast<std::size_t>(io.GetImageSizeInBytes()));
  io.Read(bytes.data());
  return append(io.GetComponentType(), bytes, values);
}

Vec3 vector_of(const std::vector<double>& v) { return {v.at(0), v.at(1), v.at(2)}; }

/// How many voxels the file states along an axis; a number that no int holds is too large anyway.
int side_of(const itk::ImageIOBase& io, unsigned axis) {
  constexpr itk::SizeValueType kMost = std::numeric_limits<int>::max();
  return static_cast<int>(std::min(io.GetDimensions(axis), kMost));
}

/// The grid as the file states it, or what is wrong with it.
Result<VolumeGrid> grid_of(const itk::ImageIOBase& io) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  bool flat = dimensions < 3;
  for (unsigned d = 3; d < dimensions; ++d) {
    flat = flat || io.GetDimensions(d) != 1;
  }
  if (flat) {
    return Error{"has " + std::to_string(dimensions) + " dimensions, must have 3"};
  }
  VolumeGrid grid;
  for (unsigned d = 0; d < 3; ++d) {
    grid.size[d] = side_of(io, d);
    grid.spacing_m[static_cast<int>(d)] = io.GetSpacing(d) * 1e-3;
    grid.origin_m[static_cast<int>(d)] = io.GetOrigin(d) * 1e-3;
  }
  grid.directions = Mat3::from_columns(vector_of(io.GetDirection(0)), vector_of(io.GetDirection(1)),
                                       vector_of(io.GetDirection(2)));
  return grid;
}

std::map<std::string, std::string> fields_of(const itk::ImageIOBase& io) {
  std::map<std::string, std::string> fields;
  const itk::MetaDataDictionary& dictionary = io.GetMetaDataDictionary();
  for (const std::string& key : dictionary.GetKeys()) {
    std::string value;
    if (itk::ExposeMetaData<std::string>(dictionary, key, value)) {
      fields[key] = value;
    }
  }
  return fields;
}

Result<Volume> load_file(itk::ImageIOBase& io, const std::string& path) {
  try {
    if (const Status numbers = check_nifti_numbers(path); !numbers) {
      return Error{path + ": " + numbers.error().message};
    }
    if (!io.CanReadFile(path.c_str())) {
      return Error{path + ": is not what its name says, or can't be read"};
    }
    io.SetFileName(path);
    io.ReadImageInformation();
    Volume volume;
    const auto grid = grid_of(io);
    Status checked = grid ? check_grid(*grid) : Status{grid.error()};
    if (checked) {
      checked = check_voxels(path, static_cast<std::uint64_t>(io.GetImageSizeInBytes()));
    }
    if (!checked) {
      return Error{path + ": " + checked.error().message, checked.error().code};
    }
    volume.grid = *grid;
    volume.layers = io.GetNumberOfComponents();
    volume.fields = fields_of(io);
    if (Status s = read_voxels(io, volume.values); !s) {
      return Error{path + ": " + s.error().message};
    }
    if (volume.values.size() != volume.grid.voxels() * volume.layers) {
      return Error{path + ": holds " + std::to_string(volume.values.size()) +
                   " values, must hold " + std::to_string(volume.grid.voxels() * volume.layers)};
    }
    return volume;
  } catch (const itk::ExceptionObject& error) {
    return refused(path, error);
  } catch (const std::exception& error) {
    return Error{path + ": can't be read: " + error.what()};
  }
}

/// The place of a slice from its header; nothing if the file is not a DICOM slice with a place.
std::optional<SliceHeader> header_of(const std::string& path) {
  const auto io = itk::GDCMImageIO::New();
  try {
    if (!io->CanReadFile(path.c_str())) {
      return std::nullopt;
    }
    io->SetFileName(path);
    io->ReadImageInformation();
  } catch (const std::exception&) {
    return std::nullopt;
  }
  auto fields = fields_of(*io);
  const auto position = dicom_numbers(fields["0020|0032"]);
  const auto orientation = dicom_numbers(fields["0020|0037"]);
  if (position.size() != 3 || orientation.size() != 6) {
    return std::nullopt;
  }
  SliceHeader slice;
  slice.file = path;
  slice.series = dicom_text(fields["0020|000e"]);
  slice.description = dicom_text(fields["0008|103e"]);
  slice.position_m = 1e-3 * vector_of(position);
  slice.row = {orientation[0], orientation[1], orientation[2]};
  slice.column = {orientation[3], orientation[4], orientation[5]};
  slice.spacing_m = {io->GetSpacing(0) * 1e-3, io->GetSpacing(1) * 1e-3};
  slice.size = {side_of(*io, 0), side_of(*io, 1)};
  return slice;
}

Status append_slice(const SliceHeader& slice, std::vector<float>& values) {
  const auto io = itk::GDCMImageIO::New();
  try {
    io->SetFileName(slice.file);
    io->ReadImageInformation();
    if (io->GetNumberOfComponents() != 1) {
      return Error{slice.file + ": is in colour, must be a CT slice"};
    }
    const auto bytes = static_cast<std::uint64_t>(io->GetImageSizeInBytes());
    if (const Status enough = check_long_enough(slice.file, bytes); !enough) {
      return Error{slice.file + ": " + enough.error().message};
    }
    return read_voxels(*io, values);
  } catch (const itk::ExceptionObject& error) {
    return refused(slice.file, error);
  } catch (const std::exception& error) {
    return Error{slice.file + ": can't be read: " + error.what()};
  }
}

/// The headers of all DICOM slices in the folder, ordered by file name.
std::vector<SliceHeader> headers_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(folder, code)) {
    if (entry.is_regular_file(code)) {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<SliceHeader> slices;
  for (const std::string& file : files) {
    if (auto slice = header_of(file)) {
      slices.push_back(std::move(*slice));
    }
  }
  return slices;
}

Result<Volume> load_folder(const std::string& folder, const std::string& series) {
  // Problems are returned as errors; the library must not print.
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  const auto members = one_series(headers_in(folder), series);
  if (!members) {
    return Error{folder + ": " + members.error().message};
  }
  auto stack = stacked(*members);
  const Status checked = stack ? check_grid(stack->grid) : Status{stack.error()};
  if (!checked) {
    return Error{folder + ": " + checked.error().message};
  }
  Volume volume;
  volume.grid = stack->grid;
  for (const SliceHeader& slice : stack->slices) {
    if (Status s = append_slice(slice, volume.values); !s) {
      return s.error();
    }
  }
  if (volume.values.size() != volume.grid.voxels()) {
    return Error{folder + ": slices hold " + std::to_string(volume.values.size()) +
                 " values, must hold " + std::to_string(volume.grid.voxels())};
  }
  return volume;
}

}  // namespace

Result<Volume> read_volume(const std::string& path, const std::string& series) {
  std::error_code code;
  if (fs::is_directory(path, code)) {
    return load_folder(path, series);
  }
  if (!fs::exists(path, code)) {
    return Error{path + ": no such file or folder", ErrorCode::kNotFound};
  }
  if (path.ends_with(".nii") || path.ends_with(".nii.gz")) {
    return load_file(*itk::NiftiImageIO::New(), path);
  }
  if (path.ends_with(".nrrd")) {
    return load_file(*itk::NrrdImageIO::New(), path);
  }
  return Error{path + ": must be .nii, .nii.gz, .nrrd or a folder of DICOM slices"};
}

}  // namespace orthonav::engine
