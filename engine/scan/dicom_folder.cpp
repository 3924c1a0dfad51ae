#include "engine/scan/dicom_folder.h"

#include "engine/scan/itk_under_clang.h"

#include <gdcmAttribute.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>
#include <itkGDCMImageIO.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "engine/io/text_fields.h"
#include "engine/scan/itk_voxels.h"
#include "engine/scan/whole_file.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;
using gdcm::DataSet;
using gdcm::Tag;

// DICOM PS3.6, the data elements that a slice needs.
const Tag kClass{0x0008, 0x0016}, kModality{0x0008, 0x0060}, kDescription{0x0008, 0x103e},
    kSeries{0x0020, 0x000e}, kPosition{0x0020, 0x0032}, kOrientation{0x0020, 0x0037},
    kPhotometric{0x0028, 0x0004}, kFrames{0x0028, 0x0008}, kSpacing{0x0028, 0x0030},
    kIntercept{0x0028, 0x1052}, kSlope{0x0028, 0x1053}, kPixels{0x7fe0, 0x0010},
    kShared{0x5200, 0x9229}, kPerFrame{0x5200, 0x9230}, kPlanePosition{0x0020, 0x9113},
    kPlaneOrientation{0x0020, 0x9116}, kMeasures{0x0028, 0x9110}, kTransformation{0x0028, 0x9145},
    kImagerSpacing{0x0018, 0x1164}, kNominalSpacing{0x0018, 0x2010};

// DICOM PS3.4, the kinds of objects that are mistaken for a CT.
constexpr const char* kEnhancedCt = "1.2.840.10008.5.1.4.1.1.2.1";
constexpr const char* kSecondaryCapture = "1.2.840.10008.5.1.4.1.1.7";
constexpr const char* kSegmentation = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr const char* kStructureSet = "1.2.840.10008.5.1.4.1.1.481.3";
constexpr const char* kDirectory = "1.2.840.10008.1.3.10";

/// An element's text without its padding; nothing where it is absent or empty.
std::optional<std::string> text_of(const DataSet& set, const Tag& tag) {
  if (!set.FindDataElement(tag)) {
    return std::nullopt;
  }
  const gdcm::ByteValue* bytes = set.GetDataElement(tag).GetByteValue();
  if (bytes == nullptr) {
    return std::nullopt;
  }
  std::string text(bytes->GetPointer(), bytes->GetLength());
  std::erase_if(text, [](unsigned char c) { return std::iscntrl(c) != 0; });
  text = std::string(trimmed(text));
  return text.empty() ? std::nullopt : std::optional(text);
}

/// "1.5\2": so many finite numbers, or nothing.
std::optional<std::vector<double>> numbers_of(const DataSet& set, const Tag& tag,
                                              std::size_t count) {
  const auto text = text_of(set, tag);
  if (!text) {
    return std::nullopt;
  }
  std::vector<double> numbers;
  for (const std::string& part : split(*text, '\\')) {
    const auto number = number_from(part.starts_with('+') ? part.substr(1) : part);
    if (!number) {
      return std::nullopt;
    }
    numbers.push_back(*number);
  }
  return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

/// The only item of a sequence in `set`, or its item `index`; nullptr where there is none.
const DataSet* item_of(const DataSet& set, const Tag& tag, std::size_t index = 0) {
  if (!set.FindDataElement(tag)) {
    return nullptr;
  }
  const auto items = set.GetDataElement(tag).GetValueAsSQ();
  return items && index < items->GetNumberOfItems() ? &items->GetItem(index + 1).GetNestedDataSet()
                                                    : nullptr;
}

/// Where the attributes of a frame stand: in its own group or the shared one (PS3.3, C.7.6.16), or,
/// of a single slice, in the object itself.
struct FrameGroups {
  const DataSet* object;
  const DataSet* own = nullptr;
  const DataSet* shared = nullptr;

  [[nodiscard]] std::optional<std::vector<double>> numbers(const Tag& group, const Tag& tag,
                                                           std::size_t count) const {
    if (own == nullptr && shared == nullptr) {
      return numbers_of(*object, tag, count);
    }
    for (const DataSet* functional : {own, shared}) {
      const DataSet* item = functional != nullptr ? item_of(*functional, group) : nullptr;
      if (item != nullptr) {
        return numbers_of(*item, tag, count);
      }
    }
    return std::nullopt;
  }
};

/// Why an object of this kind is not read; empty where it may be a CT.
std::string wrong_kind(const std::string& kind, const std::string& modality) {
  constexpr const char* kExport =
      ": in 3D Slicer load it and export the segments as .seg.nrrd, for --labels";
  if (kind == kSegmentation) {
    return std::string("is a DICOM segmentation (SEG)") + kExport;
  }
  if (kind == kStructureSet) {
    return std::string("is a structure set of radiotherapy (RTSTRUCT)") + kExport;
  }
  if (kind.starts_with(kSecondaryCapture)) {
    return "is a secondary capture, a picture of a scan: export the scan's own series";
  }
  if (modality != "CT") {
    return "is of modality " + (modality.empty() ? std::string("unknown") : modality) +
           ", must be CT";
  }
  return {};
}

/// Fills in where a slice lies; a problem is what is missing.
void read_geometry(const FrameGroups& groups, SliceHeader& slice) {
  const auto position = groups.numbers(kPlanePosition, kPosition, 3);
  const auto orientation = groups.numbers(kPlaneOrientation, kOrientation, 6);
  const auto spacing = groups.numbers(kMeasures, kSpacing, 2);
  const auto needs = [&](const std::string& what) {
    if (slice.problem.empty()) {
      slice.problem = what;
    }
  };
  if (position) {
    slice.position_m = 1e-3 * Vec3{(*position)[0], (*position)[1], (*position)[2]};
  } else {
    needs("states no position (0020,0032)");
  }
  if (orientation) {
    slice.row = {(*orientation)[0], (*orientation)[1], (*orientation)[2]};
    slice.column = {(*orientation)[3], (*orientation)[4], (*orientation)[5]};
  } else {
    needs("states no orientation (0020,0037)");
  }
  if (spacing && (*spacing)[0] > 0.0 && (*spacing)[1] > 0.0) {
    slice.spacing_m = {(*spacing)[1] * 1e-3, (*spacing)[0] * 1e-3};  // stored: rows, columns
  } else {
    const bool elsewhere = groups.object->FindDataElement(kImagerSpacing) ||
                           groups.object->FindDataElement(kNominalSpacing);
    needs(std::string("states no pixel spacing (0028,0030)") +
          (elsewhere ? ", only one of the imager or of a nominal scan" : "") +
          ": export the original series");
  }
  if (!groups.numbers(kTransformation, kSlope, 1) ||
      !groups.numbers(kTransformation, kIntercept, 1)) {
    needs("states no rescale slope and intercept (0028,1053 and 1052): its values are no HU");
  }
}

int number_16(const DataSet& set, const Tag& tag) {
  if (!set.FindDataElement(tag)) {
    return 0;
  }
  const gdcm::ByteValue* bytes = set.GetDataElement(tag).GetByteValue();
  if (bytes == nullptr || bytes->GetLength() != 2) {
    return 0;
  }
  return static_cast<unsigned char>(bytes->GetPointer()[0]) |
         static_cast<unsigned char>(bytes->GetPointer()[1]) << 8;
}

/// The headers in a file: one for each frame. Nothing where it is no DICOM file, or a DICOMDIR.
std::vector<SliceHeader> slices_in(const std::string& path) {
  // What is incomplete the library only warns of, and makes up the rest.
  std::ostringstream warnings;
  gdcm::Trace::SetStream(warnings);
  gdcm::Trace::WarningOn();
  gdcm::Reader reader;
  reader.SetFileName(path.c_str());
  const bool read = reader.Read();
  gdcm::Trace::WarningOff();
  const DataSet& set = reader.GetFile().GetDataSet();
  const std::string kind = text_of(set, kClass).value_or("");
  if (!read || set.IsEmpty() || kind == kDirectory ||
      (kind != kStructureSet && !set.FindDataElement(kPixels))) {
    return {};
  }
  SliceHeader slice;
  slice.file = path;
  slice.series = text_of(set, kSeries).value_or("");
  slice.description = text_of(set, kDescription).value_or("");
  slice.modality = text_of(set, kModality).value_or("");
  slice.size = {number_16(set, {0x0028, 0x0011}), number_16(set, {0x0028, 0x0010})};
  slice.problem = wrong_kind(kind, slice.modality);
  slice.ct = slice.problem.empty();
  if (slice.problem.empty() && number_16(set, {0x0028, 0x0002}) != 1) {
    slice.problem = "is in colour, must have one grey value a pixel";
  }
  const std::string photometric = text_of(set, kPhotometric).value_or("");
  if (slice.problem.empty() && photometric != "MONOCHROME2") {
    slice.problem = "has photometric interpretation \"" + photometric + "\", must be MONOCHROME2";
  }
  const std::string said = warnings.str();
  if (slice.problem.empty() && (said.find("Incomplete Pixel Data") != std::string::npos ||
                                said.find("Fragment") != std::string::npos)) {
    slice.problem = "is cut off: its pixels end early";
  }
  const std::uint64_t bytes = std::uint64_t(slice.size[0]) * std::uint64_t(slice.size[1]);
  if (const Status enough = check_long_enough(path, bytes); slice.problem.empty() && !enough) {
    slice.problem = enough.error().message;
  }
  if (kind != kEnhancedCt) {
    if (slice.problem.empty() && number_from(text_of(set, kFrames).value_or("1")) != 1.0) {
      slice.problem = "holds several frames but is no enhanced CT";
    }
    read_geometry({&set}, slice);
    return {slice};
  }
  const auto frames = number_from(text_of(set, kFrames).value_or(""));
  constexpr double kMaxFrames = 10'000;
  const DataSet* shared = item_of(set, kShared);
  const DataSet* last = frames && *frames >= 1.0 && *frames <= kMaxFrames
                            ? item_of(set, kPerFrame, static_cast<std::size_t>(*frames) - 1)
                            : nullptr;
  if (slice.problem.empty() && last == nullptr) {
    slice.problem = "does not say where each of its frames lies";
  }
  if (!slice.problem.empty()) {
    return {slice};
  }
  const auto groups_of = [&](int frame) {
    return FrameGroups{&set, item_of(set, kPerFrame, static_cast<std::size_t>(frame)), shared};
  };
  std::vector<SliceHeader> out;
  slice.frames = static_cast<int>(*frames);
  for (slice.frame = 0; slice.frame < slice.frames; ++slice.frame) {
    SliceHeader frame = slice;
    read_geometry(groups_of(slice.frame), frame);
    for (const Tag& tag : {kSlope, kIntercept}) {
      if (frame.problem.empty() && groups_of(slice.frame).numbers(kTransformation, tag, 1) !=
                                       groups_of(0).numbers(kTransformation, tag, 1)) {
        frame.problem = "has frames of different rescale slope or intercept: export it as slices";
      }
    }
    out.push_back(frame);
  }
  return out;
}

/// The grey values of a whole file as HU, frame after frame.
Status append_file(const std::string& path, std::vector<float>& values) {
  const auto io = itk::GDCMImageIO::New();
  try {
    io->SetFileName(path);
    io->ReadImageInformation();
    if (io->GetNumberOfComponents() != 1) {
      return Error{"is in colour, must be a CT slice"};
    }
    const auto bytes = static_cast<std::uint64_t>(io->GetImageSizeInBytes());
    if (const Status enough = check_long_enough(path, bytes); !enough) {
      return enough;
    }
    return read_voxels(*io, values);
  } catch (const std::exception& error) {
    return Error{"can't be read: " + itk_problem(error)};
  }
}

Status append_slices(const std::vector<SliceHeader>& slices, std::vector<float>& values) {
  std::map<std::string, std::vector<float>> multi_frame;
  for (const SliceHeader& slice : slices) {
    const std::size_t pixels = std::size_t(slice.size[0]) * std::size_t(slice.size[1]);
    std::vector<float> own;
    std::vector<float>& file = slice.frames > 1 ? multi_frame[slice.file] : own;
    if (file.empty()) {
      if (const Status s = append_file(slice.file, file); !s) {
        return Error{slice.file + ": " + s.error().message, s.error().code};
      }
      if (file.size() != pixels * std::size_t(slice.frames)) {
        return Error{slice.file + ": holds " + std::to_string(file.size()) + " values, must hold " +
                     std::to_string(pixels * std::size_t(slice.frames))};
      }
    }
    const auto first = file.begin() + static_cast<std::ptrdiff_t>(pixels) * slice.frame;
    values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(pixels));
  }
  return {};
}

}  // namespace

std::vector<SliceHeader> dicom_slices(const std::string& path) {
  constexpr std::size_t kMaxFiles = 100'000;
  // Problems are returned; the library must not print.
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  std::vector<std::string> files;
  std::error_code code;
  if (!fs::is_directory(path, code)) {
    files.push_back(path);
  } else {
    for (fs::recursive_directory_iterator at(path, code), end; !code && at != end;
         at.increment(code)) {
      if (at->is_regular_file(code) && files.size() < kMaxFiles) {
        files.push_back(at->path().string());
      }
    }
  }
  std::sort(files.begin(), files.end());
  std::vector<SliceHeader> slices;
  for (const std::string& file : files) {
    for (SliceHeader& slice : slices_in(file)) {
      slices.push_back(std::move(slice));
    }
  }
  return slices;
}

Result<Volume> read_dicom(const std::string& path, const std::string& series) {
  const auto members = one_series(dicom_slices(path), series);
  if (!members) {
    return members.error();
  }
  auto stack = stacked(*members);
  if (!stack) {
    return stack.error();
  }
  if (Status s = check_grid(stack->grid); !s) {
    return s.error();
  }
  Volume volume;
  volume.grid = stack->grid;
  if (Status s = append_slices(stack->slices, volume.values); !s) {
    return s.error();
  }
  return volume;
}

bool is_dicom(const std::string& path) {
  constexpr std::size_t kPreamble = 128;
  std::array<char, kPreamble + 4> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return file.gcount() == static_cast<std::streamsize>(begin.size()) &&
         std::string(begin.end() - 4, begin.end()) == "DICM";
}

}  // namespace orthonav::engine
