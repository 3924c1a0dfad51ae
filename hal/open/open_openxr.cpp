#include "hal/open/open_openxr.h"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/file_code.h"
#include "hal/open/bad_uri.h"
#include "hal/openxr/openxr_headset.h"

namespace orthonav {
namespace {

constexpr const char* kForm =
    "openxr: is followed by [?rig=FILE] and [+URI], the headset whose cameras it takes, as in "
    "openxr:+sim: or openxr:?rig=rig.json+hl2ss://HOST";

/// Sixteen finite numbers in four rows; millimetres.
Result<Transform<Eye, Rig>> pose_from(const nlohmann::json& json, const std::string& name) {
  const auto field = json.is_object() ? json.find("view_from_rig") : json.end();
  if (!json.is_object() || field == json.end() || !field->is_array() || field->size() != 4) {
    return Error{name + ": view_from_rig must be four rows of four numbers"};
  }
  std::array<double, 16> rows{};
  for (std::size_t r = 0; r < 4; ++r) {
    const auto& row = (*field)[r];
    if (!row.is_array() || row.size() != 4) {
      return Error{name + ": view_from_rig must be four rows of four numbers"};
    }
    for (std::size_t c = 0; c < 4; ++c) {
      if (!row[c].is_number()) {
        return Error{name + ": view_from_rig must be four rows of four numbers"};
      }
      rows[4 * r + c] = row[c].get<double>();
    }
  }
  if (rows[12] != 0.0 || rows[13] != 0.0 || rows[14] != 0.0 || rows[15] != 1.0) {
    return Error{name + ": the last row of view_from_rig must be 0 0 0 1"};
  }
  constexpr double kMaxAway_mm = 1000.0;
  for (const std::size_t i : {3u, 7u, 11u}) {
    if (!(std::abs(rows[i]) <= kMaxAway_mm)) {
      return Error{name + ": view_from_rig is " + std::to_string(rows[i]) + " mm away, limit " +
                   std::to_string(kMaxAway_mm) + " mm"};
    }
    rows[i] *= 1e-3;
  }
  auto pose = Transform<Eye, Rig>::from_row_major(rows);
  if (!pose) {
    return Error{name + ": view_from_rig: " + pose.error().message};
  }
  return pose;
}

struct RigFile {
  Transform<Eye, Rig> view_from_rig;
  std::string calibration;  ///< path; empty: none
};

/// The path in the optional field `calibration`, which starts from the rig file's folder.
Result<std::string> calibration_from(const nlohmann::json& json, const std::string& path) {
  const auto field = json.find("calibration");
  if (field == json.end()) {
    return std::string();
  }
  if (!field->is_string() || field->get_ref<const std::string&>().empty()) {
    return Error{path + ": calibration must be the path of a file of orthonav calibrate stereo"};
  }
  return (std::filesystem::path(path).parent_path() / field->get<std::string>()).string();
}

Result<RigFile> load_rig(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Error{path + ": can't be read", code_of_unopened(path)};
  }
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (json.is_discarded()) {
    return Error{path + ": is not JSON"};
  }
  auto pose = pose_from(json, path);
  if (!pose) {
    return pose.error();
  }
  auto calibration = calibration_from(json, path);
  if (!calibration) {
    return calibration.error();
  }
  return RigFile{*pose, std::move(*calibration)};
}

/// Whether the cameras move with the wearer's head, unlike those of a simulation or a recording.
bool is_mounted(std::string_view cameras) {
  return !cameras.starts_with("sim:") && !cameras.starts_with("replay:");
}

/// The parts after "openxr:".
struct OpenxrUri {
  std::optional<std::string> rig_file;
  std::string cameras;  ///< the URI of the headset that lends its cameras
};

Result<OpenxrUri> parse(const std::string& uri, std::string_view rest) {
  OpenxrUri parts;
  if (rest.starts_with('?')) {
    const std::size_t end = rest.find('+');
    const std::string_view query = rest.substr(1, end == rest.npos ? rest.npos : end - 1);
    constexpr std::string_view kRig = "rig=";
    if (!query.starts_with(kRig) || query.size() == kRig.size()) {
      return bad_uri(uri, "unknown key \"" + std::string(query.substr(0, query.find('='))) +
                              "\"; known is rig=FILE");
    }
    parts.rig_file = std::string(query.substr(kRig.size()));
    rest = end == rest.npos ? std::string_view() : rest.substr(end);
  }
  if (rest.empty()) {
    rest = "+sim:";
  }
  if (!rest.starts_with('+') || rest.size() == 1) {
    return bad_uri(uri, kForm);
  }
  parts.cameras = rest.substr(1);
  if (parts.cameras.starts_with("openxr:")) {
    return bad_uri(uri, "the cameras of one openxr: can't be another one's");
  }
  return parts;
}

}  // namespace

Result<OpenedHeadset> open_openxr(const std::string& uri, std::string_view rest,
                                  const OpenOptions& options) {
  const auto parts = parse(uri, rest);
  if (!parts) {
    return parts.error();
  }
  openxr::RigOnHead rig;
  std::string calibration;
  rig.mounted = is_mounted(parts->cameras);
  if (rig.mounted && !parts->rig_file) {
    return bad_uri(uri,
                   "cameras on the head need rig=FILE: where they are mounted can't be guessed");
  }
  if (parts->rig_file) {
    auto file = load_rig(*parts->rig_file);
    if (!file) {
      return bad_uri(uri, file.error().message);
    }
    rig.view_from_rig = file->view_from_rig;
    calibration = std::move(file->calibration);
  }
  auto cameras = open_with_room(parts->cameras, options);
  if (!cameras) {
    return cameras.error();
  }
  if (cameras->headset->cameras() == nullptr || cameras->headset->tool_poses() != nullptr) {
    return bad_uri(uri,
                   cameras->headset->name() +
                       " measures tools itself, and its place in the display's map is unknown");
  }
  return OpenedHeadset{{openxr::OpenxrHeadset::around(std::move(cameras->headset), rig),
                        std::move(cameras->warning)},
                       cameras->room,
                       std::move(calibration)};
}

}  // namespace orthonav
