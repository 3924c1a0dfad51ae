#include "engine/scan/nrrd_file.h"

#include "engine/scan/itk_under_clang.h"

#include <itkMetaDataObject.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "engine/io/text_fields.h"
#include "engine/scan/itk_voxels.h"
#include "engine/scan/whole_file.h"

namespace orthonav::engine {
namespace {

using Fields = std::map<std::string, std::string>;

/// `field: value` lines, the names in lower case.
Fields fields_in(const std::string& path) {
  constexpr int kMaxLines = 100'000;
  Fields fields;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  for (int i = 0; i < kMaxLines && std::getline(file, line); ++i) {
    if (line.ends_with('\r')) {
      line.pop_back();
    }
    if (line.empty()) {
      break;  // ends the header
    }
    const std::size_t colon = line.find(": ");
    if (!line.starts_with('#') && colon != std::string::npos && colon < line.find(":=")) {
      fields[lower_case(line.substr(0, colon))] = std::string(trimmed(line.substr(colon + 2)));
    }
  }
  return fields;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    words.push_back(word);
  }
  return words;
}

/// "(1,0,0) (0, 2, 0) none": each vector, and nothing for `none`.
std::optional<std::vector<std::optional<Vec3>>> vectors_in(const std::string& text) {
  std::vector<std::optional<Vec3>> out;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == ' ' || text[at] == '\t') {
      ++at;
    } else if (text.compare(at, 4, "none") == 0) {
      out.emplace_back();
      at += 4;
    } else {
      const std::size_t end = text.find(')', at);
      if (text[at] != '(' || end == std::string::npos) {
        return std::nullopt;
      }
      const auto parts = split(text.substr(at + 1, end - at - 1), ',');
      if (parts.size() != 3) {
        return std::nullopt;
      }
      Vec3 v;
      for (int i = 0; i < 3; ++i) {
        const auto number = number_from(parts[static_cast<std::size_t>(i)]);
        if (!number) {
          return std::nullopt;
        }
        v[i] = *number;
      }
      out.emplace_back(v);
      at = end + 1;
    }
  }
  return out;
}

/// The signs that take a space's axes to LPS; nothing for a space that is no patient's.
std::optional<Vec3> signs_to_lps(const std::string& space) {
  static const std::map<std::string, Vec3> kSigns = {
      {"right-anterior-superior", {-1, -1, 1}}, {"ras", {-1, -1, 1}},
      {"left-anterior-superior", {1, -1, 1}},   {"las", {1, -1, 1}},
      {"left-posterior-superior", {1, 1, 1}},   {"lps", {1, 1, 1}}};
  const auto found = kSigns.find(lower_case(space));
  return found == kSigns.end() ? std::nullopt : std::optional(found->second);
}

Result<double> metres_of(const Fields& fields) {
  const auto units = fields.find("space units");
  if (units == fields.end()) {
    return 1e-3;  // what Slicer and every writer without the field mean
  }
  static const std::map<std::string, double> kMetres = {{"\"mm\"", 1e-3}, {"\"millimeter\"", 1e-3},
                                                        {"\"cm\"", 1e-2}, {"\"m\"", 1.0},
                                                        {"\"um\"", 1e-6}, {"\"\"", 1e-3}};
  const auto words = words_of(units->second);
  const auto found = words.empty() ? kMetres.end() : kMetres.find(words[0]);
  if (found == kMetres.end() ||
      !std::all_of(words.begin(), words.end(), [&](const auto& w) { return w == words[0]; })) {
    return Error{"space units are " + units->second + ", must be the same for all axes: \"mm\""};
  }
  return found->second;
}

/// The grid that the header states.
Result<VolumeGrid> grid_of(const Fields& fields, std::vector<std::string>& notes) {
  const auto field = [&](const char* name) {
    const auto found = fields.find(name);
    return found == fields.end() ? std::string() : found->second;
  };
  constexpr const char* kRemedy = "; save it again, for example with 3D Slicer";
  if (field("space").empty()) {
    return Error{std::string("states no space: left and right are undefined") + kRemedy};
  }
  const auto signs = signs_to_lps(field("space"));
  if (!signs) {
    return Error{
        "its space is \"" + field("space") +
        "\", must be left-posterior-superior, right-anterior-superior or left-anterior-superior" +
        kRemedy};
  }
  const auto metres = metres_of(fields);
  if (!metres) {
    return metres.error();
  }
  const auto directions = vectors_in(field("space directions"));
  const auto origin = vectors_in(field("space origin"));
  if (!directions || !origin || origin->size() != 1 || !origin->front()) {
    return Error{std::string("states no space directions or no space origin in numbers") + kRemedy};
  }
  const auto sizes = words_of(field("sizes"));
  const auto lps_m = [&](Vec3 v) {
    return *metres * Vec3{signs->x * v.x, signs->y * v.y, signs->z * v.z};
  };
  std::array<int, 3> size{};
  std::array<Vec3, 3> steps_m;
  std::size_t count = 0;
  for (std::size_t axis = 0; axis < directions->size(); ++axis) {
    if (!(*directions)[axis]) {
      continue;  // of the values at a voxel
    }
    const auto voxels = axis < sizes.size() ? number_from(sizes[axis]) : std::nullopt;
    if (count == 3 || !voxels) {
      count = 4;
      break;
    }
    size[count] = static_cast<int>(std::clamp(*voxels, 0.0, 1e9));
    steps_m[count] = lps_m(*(*directions)[axis]);
    ++count;
  }
  if (count != 3 || directions->size() != sizes.size()) {
    return Error{"must have 3 axes in space, one direction and one size each"};
  }
  return squared_grid(size, steps_m, lps_m(*origin->front()), notes);
}

std::map<std::string, std::string> text_of(const itk::ImageIOBase& io) {
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

Result<Volume> volume_from_nrrd(const std::string& path) {
  if (const Status s = check_names_no_other_file(path); !s) {
    return s.error();
  }
  const auto io = itk::NrrdImageIO::New();
  if (!io->CanReadFile(path.c_str())) {
    return Error{"is not a NRRD file"};
  }
  Volume volume;
  const auto grid = grid_of(fields_in(path), volume.notes);
  if (!grid) {
    return grid.error();
  }
  volume.grid = *grid;
  io->SetFileName(path);
  io->ReadImageInformation();
  if (const Status s =
          check_long_enough(path, static_cast<std::uint64_t>(io->GetImageSizeInBytes()));
      !s) {
    return s.error();
  }
  volume.layers = io->GetNumberOfComponents();
  volume.fields = text_of(*io);
  if (const Status s = read_voxels(*io, volume.values); !s) {
    return s.error();
  }
  if (volume.values.size() != volume.grid.voxels() * volume.layers) {
    return Error{"holds " + std::to_string(volume.values.size()) + " values, must hold " +
                 std::to_string(volume.grid.voxels() * volume.layers)};
  }
  return volume;
}

}  // namespace

Result<Volume> read_nrrd(const std::string& path) {
  try {
    return volume_from_nrrd(path);
  } catch (const std::exception& error) {
    return Error{"can't be read: " + itk_problem(error)};
  }
}

}  // namespace orthonav::engine
