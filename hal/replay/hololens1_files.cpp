#include "hal/replay/hololens1_files.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "hal/replay/layout.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

constexpr std::uintmax_t kMaxCsvBytes = std::uintmax_t{1} << 30U;
constexpr std::size_t kColumns = 50;  // time, image, three matrices
constexpr std::size_t kOriginColumn = 2;
constexpr std::size_t kViewColumn = 18;
// Files have six significant digits of numbers up to 1; a camera that moves in its headset means
// damage.
constexpr double kSameCamera = 1e-3;
constexpr double kRotationTolerance = 1e-2;

/// From the view frame (x right, y up, -z forward) to vision axes (x right, y down, z forward).
constexpr Mat3 kVisionFromView = {{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};

/// A matrix for row vectors (p' = p·M) as one for column vectors: its transpose. Nothing for zeros.
template <class A, class B>
Result<std::optional<Transform<A, B>>> read_matrix(const std::vector<std::string_view>& fields,
                                                   std::size_t first, double max_translation_m) {
  std::array<double, 16> columns{};
  bool zeros = true;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto value = parse_double(fields[first + i]);
    if (!value || !std::isfinite(*value)) {
      return Error{"column " + std::to_string(first + i + 1) + " must be a finite number"};
    }
    columns[i % 4 * 4 + i / 4] = *value;
    zeros = zeros && *value == 0.0;
  }
  if (zeros) {
    return std::optional<Transform<A, B>>();
  }
  for (std::size_t c = 0; c < 4; ++c) {
    if (std::abs(columns[12 + c] - (c == 3 ? 1.0 : 0.0)) > 1e-6) {
      return Error{"the last column must be 0,0,0,1 (row vectors)"};
    }
  }
  const auto pose = Transform<A, B>::from_row_major(columns, kRotationTolerance);
  if (!pose) {
    return pose.error();
  }
  if (!(pose->translation().norm() <= max_translation_m)) {
    return Error{"translation is " + std::to_string(pose->translation().norm()) +
                 " m long, limit " + std::to_string(max_translation_m) + " m"};
  }
  return std::optional<Transform<A, B>>(*pose);
}

/// The camera in the headset, in vision axes: from the first row that has it; must be the same in
/// all.
template <class Camera>
Status take_view(const Transform<Camera, Rig>& view,
                 std::optional<Transform<Camera, Rig>>& camera_from_rig) {
  const Transform<Camera, Rig> vision(kVisionFromView * view.rotation(),
                                      kVisionFromView * view.translation());
  if (!camera_from_rig) {
    camera_from_rig = vision;
  }
  const double apart_m = (vision.translation() - camera_from_rig->translation()).norm();
  if (apart_m > kSameCamera ||
      rotation_angle_rad(vision.rotation(), camera_from_rig->rotation()) > kSameCamera) {
    return Error{"CameraViewTransform differs from the one above it"};
  }
  return {};
}

template <class Camera>
Status take_row(std::string_view line, std::vector<std::string_view>& fields,
                std::optional<Transform<Camera, Rig>>& camera_from_rig, PosesByTicks& poses) {
  split(line, fields);
  // A line may end in a comma.
  if (fields.size() == kColumns + 1 && fields.back().empty()) {
    fields.pop_back();
  }
  if (fields.size() != kColumns) {
    return Error{"holds " + std::to_string(fields.size()) + " columns, must be 50"};
  }
  const auto ticks = parse_integer(fields[0]);
  if (!ticks || *ticks < 0) {
    return Error{"Timestamp must be a whole number"};
  }
  const auto view = read_matrix<Camera, Rig>(fields, kViewColumn, kMaxExtrinsics_m);
  if (!view) {
    return Error{"CameraViewTransform: " + view.error().message};
  }
  if (*view) {
    if (Status taken = take_view(**view, camera_from_rig); !taken) {
      return taken;
    }
  }
  const auto pose = read_matrix<World, Rig>(fields, kOriginColumn, kMaxWorldM);
  if (!pose) {
    return Error{"FrameToOrigin: " + pose.error().message};
  }
  if (!*pose) {
    return {};
  }
  const auto [entry, added] = poses.emplace(*ticks, **pose);
  if (!added && entry->second != **pose) {
    return Error{"Timestamp " + std::to_string(*ticks) + " has another pose already"};
  }
  return {};
}

template <class Camera>
Result<Hololens1Frames<Camera>> read_frames_of(const std::filesystem::path& folder,
                                               const std::string& sensor) {
  const auto path = folder / (sensor + ".csv");
  const auto text = read_text(path, kMaxCsvBytes);
  if (!text) {
    return text.error();
  }
  std::optional<Transform<Camera, Rig>> camera_from_rig;
  Hololens1Frames<Camera> frames;
  std::vector<std::string_view> fields;
  bool header = true;
  Status status =
      for_each_whole_line(*text, [&](std::size_t number, std::string_view line) -> Status {
        if (std::exchange(header, false)) {
          if (line.starts_with("Timestamp")) {
            return {};
          }
          return line_error(path, number, "must be the header, beginning with Timestamp");
        }
        const Status taken = take_row(line, fields, camera_from_rig, frames.world_from_rig);
        return taken ? taken : Status(line_error(path, number, taken.error().message));
      });
  if (!status) {
    return status.error();
  }
  if (!camera_from_rig) {
    return file_error(path, "holds no CameraViewTransform");
  }
  frames.camera_from_rig = *camera_from_rig;
  return frames;
}

/// The direction at a pixel's top left corner on the unit plane. The table holds (x, y) of the
/// viewing ray -(x, y, 1) in the view frame, which is (-x, y, 1) in vision axes.
class CornerTable {
 public:
  static Result<CornerTable> read(const std::filesystem::path& folder, const std::string& sensor,
                                  int width_px, int height_px) {
    CornerTable table;
    table.path_ = folder / (sensor + "_camera_space_projection.bin");
    table.width_px_ = width_px;
    table.height_px_ = height_px;
    auto bytes = read_sized(table.path_, static_cast<std::size_t>(width_px) *
                                             static_cast<std::size_t>(height_px) * kPairBytes);
    if (!bytes) {
      return bytes.error();
    }
    table.bytes_ = std::move(*bytes);
    return table;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// For each pixel's centre, row-major.
  [[nodiscard]] std::vector<Vec2> centres() const {
    std::vector<Vec2> unit_plane;
    unit_plane.reserve(bytes_.size() / kPairBytes);
    for (int y = 0; y < height_px_; ++y) {
      for (int x = 0; x < width_px_; ++x) {
        unit_plane.push_back(centre(x, y));
      }
    }
    return unit_plane;
  }

 private:
  static constexpr std::size_t kPairBytes = 2 * sizeof(float);
  std::filesystem::path path_;
  std::string bytes_;
  int width_px_ = 0;
  int height_px_ = 0;

  [[nodiscard]] Vec2 at(int x, int y) const {
    std::array<float, 2> pair{};
    const std::size_t index = static_cast<std::size_t>(x) * static_cast<std::size_t>(height_px_) +
                              static_cast<std::size_t>(y);
    std::memcpy(pair.data(), bytes_.data() + index * sizeof(pair), sizeof(pair));
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(pair[0]) || !std::isfinite(pair[1])) {
      return {kNothing, kNothing};
    }
    return {-double{pair[0]}, double{pair[1]}};
  }
  /// Half a pixel further in both directions; extrapolated past the last column and row.
  [[nodiscard]] Vec2 centre(int x, int y) const {
    const int x0 = std::min(x, width_px_ - 2);
    const int y0 = std::min(y, height_px_ - 2);
    const double u = x - x0 + 0.5;
    const double v = y - y0 + 0.5;
    return (1 - u) * (1 - v) * at(x0, y0) + u * (1 - v) * at(x0 + 1, y0) +
           (1 - u) * v * at(x0, y0 + 1) + u * v * at(x0 + 1, y0 + 1);
  }
};

}  // namespace

Result<Hololens1Frames<LeftCamera>> read_hololens1_left(const std::filesystem::path& folder) {
  return read_frames_of<LeftCamera>(folder, kHololens1Left);
}

Result<Hololens1Frames<RightCamera>> read_hololens1_right(const std::filesystem::path& folder) {
  return read_frames_of<RightCamera>(folder, kHololens1Right);
}

Result<CameraModel> read_hololens1_camera(const std::filesystem::path& folder,
                                          const std::string& sensor) {
  const auto corners = CornerTable::read(folder, sensor, kImageWidthPx, kImageHeightPx);
  if (!corners) {
    return corners.error();
  }
  auto camera = CameraModel::from_lookup(kImageWidthPx, kImageHeightPx, corners->centres());
  if (!camera) {
    return file_error(corners->path(), camera.error().message);
  }
  return camera;
}

Result<Hololens1Frames<DepthSensor>> read_hololens1_depth(const std::filesystem::path& folder,
                                                          const std::string& sensor) {
  return read_frames_of<DepthSensor>(folder, sensor);
}

Result<std::vector<DepthCalibration::Ray>> read_hololens1_rays(const std::filesystem::path& folder,
                                                               const std::string& sensor,
                                                               int width_px, int height_px) {
  const auto corners = CornerTable::read(folder, sensor, width_px, height_px);
  if (!corners) {
    return corners.error();
  }
  std::vector<DepthCalibration::Ray> rays;
  rays.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (const Vec2 p : corners->centres()) {
    rays.push_back(DepthCalibration::ray_through(p));
  }
  return rays;
}

}  // namespace orthonav::replay
