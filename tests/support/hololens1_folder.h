#pragma once

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "hal/api/devices.h"
#include "tests/support/stream_recorder_folder.h"

namespace orthonav::test {

/// A folder as HoloLensForCV's recorder leaves it on a HoloLens 1, written from the format's
/// description alone, without the reader's code. Times count from FILETIME ticks `kStart`.
class Hololens1Folder {
 public:
  static constexpr std::int64_t kStart = 132000000000000000;

  Hololens1Folder(const StereoCalibration& calibration, const std::vector<StereoFrame>& frames) {
    write_text(folder_ / "recording_version_information.csv", "RecordingVersion\n1\n");
    write_sensor("vlc_lf", calibration.left, calibration.left_from_rig.row_major(), frames, true);
    write_sensor("vlc_rf", calibration.right, calibration.right_from_rig.row_major(), frames,
                 false);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
  void write(const std::string& name, const std::string& text) const {
    write_text(folder_ / name, text);
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    return content_of(folder_ / name);
  }

 private:
  TemporaryFolder folder_;

  static std::string twenty_digits(std::int64_t ticks) {
    char digits[32];
    std::snprintf(digits, sizeof(digits), "%020lld", static_cast<long long>(ticks));
    return digits;
  }
  /// A matrix for column vectors, written for row vectors: column after column.
  static std::string for_row_vectors(const std::array<double, 16>& matrix) {
    std::string text;
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t r = 0; r < 4; ++r) {
        char number[32];
        std::snprintf(number, sizeof(number), ",%.6g", matrix[4 * r + c]);
        text += number;
      }
    }
    return text;
  }
  /// Rotates vision axes (x right, y down, z forward) into the view frame (x right, y up, z back):
  /// the second and third rows change their sign.
  static std::array<double, 16> view_from_rig(std::array<double, 16> vision_from_rig) {
    for (std::size_t i = 4; i < 12; ++i) {
      vision_from_rig[i] = -vision_from_rig[i];
    }
    return vision_from_rig;
  }
  static void append_float(std::string& bytes, double value) {
    const auto single = static_cast<float>(value);
    char raw[sizeof(float)];
    std::memcpy(raw, &single, sizeof(float));
    bytes.append(raw, sizeof(float));
  }
  /// Column after column, at the pixels' top left corners. The scene point (u, v, 1) of vision axes
  /// is (u, -v, -1) in the view frame, which the table names by (x, y) with -(x, y, 1) along it.
  static std::string projection(const CameraModel& camera) {
    std::string bytes;
    for (int x = 0; x < camera.width_px(); ++x) {
      for (int y = 0; y < camera.height_px(); ++y) {
        const auto seen = camera.unproject({static_cast<double>(x), static_cast<double>(y)});
        append_float(bytes, seen ? -seen->x : std::numeric_limits<double>::infinity());
        append_float(bytes, seen ? seen->y : std::numeric_limits<double>::infinity());
      }
    }
    return bytes;
  }
  void write_sensor(const std::string& sensor, const CameraModel& camera,
                    const std::array<double, 16>& vision_from_rig,
                    const std::vector<StereoFrame>& frames, bool left) {
    HandmadeTar tar;
    std::string csv = "Timestamp,ImageFileName";
    for (const char* matrix :
         {"FrameToOrigin", "CameraViewTransform", "CameraProjectionTransform"}) {
      for (int i = 0; i < 16; ++i) {
        csv += "," + std::string(matrix) + ".m" + std::to_string(i / 4 + 1) +
               std::to_string(i % 4 + 1);
      }
    }
    csv += "\n";
    for (const StereoFrame& frame : frames) {
      const GreyImage& image = left ? frame.left : frame.right;
      // The right camera's shutter lags a little.
      const std::int64_t ticks = kStart + ticks_100ns(frame.time) + (left ? 0 : 3000);
      const std::string name = sensor + "\\" + twenty_digits(ticks) + ".pgm";
      tar.add(name, "P5\n" + std::to_string(image.width_px) + " " +
                        std::to_string(image.height_px) + "\n255\n" +
                        std::string(image.pixels.begin(), image.pixels.end()));
      const auto pose = frame.world_from_rig ? frame.world_from_rig->row_major()
                                             : std::array<double, 16>{};  // not located: zeros
      csv += std::to_string(ticks) + "," + name + for_row_vectors(pose) +
             for_row_vectors(view_from_rig(vision_from_rig)) +
             for_row_vectors({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) + "\n";
    }
    write_text(folder_ / (sensor + ".tar"), tar.finished());
    write_text(folder_ / (sensor + ".csv"), csv);
    write_text(folder_ / (sensor + "_camera_space_projection.bin"), projection(camera));
  }
};

}  // namespace orthonav::test
