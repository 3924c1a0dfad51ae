#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/transform.h"
#include "tests/support/hololens1_folder.h"
#include "tests/support/stream_recorder_folder.h"

namespace orthonav::test {

/// A depth camera that looks at a plane, and both recorders' files of its frames, written from the
/// formats' descriptions alone, without the readers' code. Nothing about it is square, centred or
/// axis-parallel, so that no convention can be mistaken for another.
struct DepthScene {
  struct Picture {
    std::int64_t ticks = 0;  ///< since the folder's start
    std::optional<Transform<World, Rig>> world_from_rig;
  };
  int width_px = 44;
  int height_px = 36;
  double focal_px = 30.0;
  Vec2 centre_px{20.3, 19.4};
  Transform<DepthSensor, Rig> sensor_from_rig{rotation_from_vector({0.2, -0.15, 1.4}),
                                              {0.013, -0.021, 0.034}};
  /// normal . p = offset_m, in the world
  Vec3 normal = Vec3{0.6, 0.1, 1.0}.normalized();
  double offset_m = 1.1;
  std::vector<Picture> pictures;

  /// The pose of the test's rig at a picture.
  static Transform<World, Rig> pose(int index) {
    return {rotation_from_vector({0.05 * index, 0.1, -1.3}), {0.2, 0.05 * index, 0.3}};
  }
  /// Pictures at these ticks, all located.
  static std::vector<Picture> located(std::initializer_list<std::int64_t> ticks) {
    std::vector<Picture> made;
    for (const std::int64_t at : ticks) {
      made.push_back({at, pose(static_cast<int>(made.size()))});
    }
    return made;
  }
  /// The direction through a continuous pixel, on the unit plane of vision axes.
  [[nodiscard]] Vec2 unit_plane(double x_px, double y_px) const {
    return {(x_px - centre_px.x) / focal_px, (y_px - centre_px.y) / focal_px};
  }
  /// Outside a circle, the files have no ray.
  [[nodiscard]] bool mapped(double x_px, double y_px) const {
    return unit_plane(x_px, y_px).norm() < 0.75;
  }
  [[nodiscard]] Transform<World, DepthSensor> world_from_sensor(const Picture& picture) const {
    return picture.world_from_rig.value_or(pose(0)) * sensor_from_rig.inverse();
  }
  /// Where the ray through a pixel's centre meets the plane.
  [[nodiscard]] Point<World> hit(const Picture& picture, int x_px, int y_px) const {
    const auto world_from_camera = world_from_sensor(picture);
    const Vec2 p = unit_plane(x_px + 0.5, y_px + 0.5);
    const Vec3 ray = world_from_camera.rotation() * Vec3{p.x, p.y, 1.0};
    const Vec3 eye = world_from_camera.translation();
    return {eye + (offset_m - normal.dot(eye)) / normal.dot(ray) * ray};
  }
  /// Distance along the ray in whole millimetres; every ninth pixel has no measurement.
  [[nodiscard]] std::uint16_t range_mm(const Picture& picture, int x_px, int y_px,
                                       std::uint16_t invalid) const {
    if ((x_px + 5 * y_px) % 9 == 0) {
      return invalid;
    }
    const Vec3 to_hit = hit(picture, x_px, y_px).v - world_from_sensor(picture).translation();
    return static_cast<std::uint16_t>(std::lround(1e3 * to_hit.norm()));
  }
  static std::uint16_t brightness(int x_px, int y_px) {
    return static_cast<std::uint16_t>(300 * y_px + x_px);
  }
  template <class Value>
  [[nodiscard]] std::string pgm(bool big_endian, const Value& value) const {
    std::string bytes =
        "P5\n" + std::to_string(width_px) + " " + std::to_string(height_px) + "\n65535\n";
    for (int y = 0; y < height_px; ++y) {
      for (int x = 0; x < width_px; ++x) {
        const unsigned number = value(x, y);
        const auto high = static_cast<char>(number / 256);
        const auto low = static_cast<char>(number % 256);
        bytes += big_endian ? high : low;
        bytes += big_endian ? low : high;
      }
    }
    return bytes;
  }
  static void append_float(std::string& bytes, double value) {
    const auto single = static_cast<float>(value);
    std::array<char, sizeof(float)> raw{};
    std::memcpy(raw.data(), &single, raw.size());
    bytes.append(raw.data(), raw.size());
  }
  /// Values with a separator before each but the first.
  static std::string numbers(const std::array<double, 16>& values, const char* format) {
    std::string text;
    for (const double value : values) {
      std::array<char, 40> number{};
      std::snprintf(number.data(), number.size(), format, value);
      text += (text.empty() ? "" : ",") + std::string(number.data());
    }
    return text;
  }

  /// As StreamRecorder leaves it: unit rays, big-endian, column vectors. `invalid` is what a pixel
  /// without measurement holds.
  void write_stream_recorder(const std::filesystem::path& folder, const std::string& sensor,
                             std::uint16_t invalid = 0, bool bright = true) const {
    constexpr std::int64_t kStart = StreamRecorderFolder::kStart;
    HandmadeTar tar;
    std::string poses;
    for (const Picture& picture : pictures) {
      const std::string ticks = std::to_string(kStart + picture.ticks);
      if (bright) {
        tar.add(ticks + "_ab.pgm", pgm(true, brightness));
      }
      tar.add(ticks + ".pgm",
              pgm(true, [&](int x, int y) { return range_mm(picture, x, y, invalid); }));
      if (picture.world_from_rig) {
        poses += ticks + "," + numbers(picture.world_from_rig->row_major(), "%.9g") + "\n";
      }
    }
    std::string rays;
    for (int y = 0; y < height_px; ++y) {
      for (int x = 0; x < width_px; ++x) {
        const Vec2 p = unit_plane(x + 0.5, y + 0.5);
        const Vec3 ray = Vec3{p.x, p.y, 1.0}.normalized();
        const bool seen = mapped(x + 0.5, y + 0.5);
        // With a z of 0 the other values may be anything.
        for (int i = 0; i < 3; ++i) {
          append_float(rays, seen ? ray[i] : (i == 2 ? 0.0 : NAN));
        }
      }
    }
    write_text(folder / (sensor + ".tar"), tar.finished());
    write_text(folder / (sensor + "_lut.bin"), rays);
    write_text(folder / (sensor + "_extrinsics.txt"),
               numbers(sensor_from_rig.row_major(), "%.9g") + "\n");
    write_text(folder / (sensor + "_rig2world.txt"), poses);
  }

  /// As HoloLensForCV leaves it: tables at corners, x outer, little-endian, row vectors, the view
  /// frame with y up and -z forward.
  void write_hololens1(const std::filesystem::path& folder, const std::string& sensor,
                       std::uint16_t invalid = 0) const {
    constexpr std::int64_t kStart = Hololens1Folder::kStart;
    const auto transposed = [](const std::array<double, 16>& m) {
      std::array<double, 16> t{};
      for (std::size_t i = 0; i < 16; ++i) {
        t[i % 4 * 4 + i / 4] = m[i];
      }
      return t;
    };
    auto view_from_rig = sensor_from_rig.row_major();
    for (std::size_t i = 4; i < 12; ++i) {
      view_from_rig[i] = -view_from_rig[i];
    }
    HandmadeTar tar;
    std::string csv = "Timestamp,ImageFileName";
    for (int i = 0; i < 48; ++i) {
      csv += ",m";
    }
    csv += "\n";
    for (const Picture& picture : pictures) {
      std::array<char, 32> digits{};
      std::snprintf(digits.data(), digits.size(), "%020lld",
                    static_cast<long long>(kStart + picture.ticks));
      const std::string name = sensor + "\\" + digits.data() + ".pgm";
      tar.add(name, pgm(false, [&](int x, int y) { return range_mm(picture, x, y, invalid); }));
      const auto located =
          picture.world_from_rig ? picture.world_from_rig->row_major() : std::array<double, 16>{};
      csv += std::to_string(kStart + picture.ticks) + "," + name + "," +
             numbers(transposed(located), "%.6g") + "," +
             numbers(transposed(view_from_rig), "%.6g") + "," +
             numbers(Transform<World, Rig>().row_major(), "%.6g") + "\n";
    }
    std::string table;
    for (int x = 0; x < width_px; ++x) {
      for (int y = 0; y < height_px; ++y) {
        const Vec2 p = unit_plane(x, y);
        append_float(table, mapped(x, y) ? -p.x : INFINITY);
        append_float(table, mapped(x, y) ? p.y : INFINITY);
      }
    }
    write_text(folder / (sensor + ".tar"), tar.finished());
    write_text(folder / (sensor + ".csv"), csv);
    write_text(folder / (sensor + "_camera_space_projection.bin"), table);
  }
};

}  // namespace orthonav::test
