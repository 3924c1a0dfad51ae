#pragma once

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/scripted_session.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::test {

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A ustar archive written by hand, independently of the recorder.
class HandmadeTar {
 public:
  HandmadeTar& add(const std::string& name, const std::string& content) {
    std::string header(512, '\0');
    const auto put = [&](std::size_t at, const std::string& text) {
      header.replace(at, text.size(), text);
    };
    put(0, name);
    put(100, "0000644");
    put(108, "0000000");
    put(116, "0000000");
    char size[16];
    std::snprintf(size, sizeof(size), "%011lo", static_cast<unsigned long>(content.size()));
    put(124, size);
    put(136, "00000000000");
    put(148, "        ");
    put(156, "0");
    put(257, std::string("ustar\0"
                         "00",
                         8));
    unsigned sum = 0;
    for (const char c : header) {
      sum += static_cast<unsigned char>(c);
    }
    char checksum[16];
    std::snprintf(checksum, sizeof(checksum), "%06o", sum);
    put(148, std::string(checksum, 7) + " ");
    bytes_ += header + content;
    bytes_.resize((bytes_.size() + 511) / 512 * 512, '\0');
    return *this;
  }
  HandmadeTar& add_image(std::int64_t ticks, std::uint8_t grey) {
    return add(std::to_string(ticks) + ".pgm", pgm(640, 480, grey));
  }
  [[nodiscard]] std::string finished() const { return bytes_ + std::string(1024, '\0'); }

  static std::string pgm(int width, int height, std::uint8_t grey) {
    return "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n" +
           std::string(static_cast<std::size_t>(width) * height, static_cast<char>(grey));
  }

 private:
  std::string bytes_;
};

/// A folder as StreamRecorder leaves it, with FILETIME ticks; pixels encode left (even greys) or
/// right (odd ones) and the image's number in its list.
class StreamRecorderFolder {
 public:
  static constexpr std::int64_t kStart = 132000000000000000;

  /// Images at these ticks after kStart, in this order; a pose for each left image.
  StreamRecorderFolder(const std::vector<std::int64_t>& left,
                       const std::vector<std::int64_t>& right) {
    HandmadeTar left_tar;
    HandmadeTar right_tar;
    std::string poses;
    for (std::size_t i = 0; i < left.size(); ++i) {
      left_tar.add_image(kStart + left[i], static_cast<std::uint8_t>(2 * i));
      poses += pose_line(left[i]);
    }
    for (std::size_t i = 0; i < right.size(); ++i) {
      right_tar.add_image(kStart + right[i], static_cast<std::uint8_t>(2 * i + 1));
    }
    write("VLC LF.tar", left_tar.finished());
    write("VLC RF.tar", right_tar.finished());
    for (const char* sensor : {"VLC LF", "VLC RF"}) {
      write(std::string(sensor) + "_lut.bin", rays());
      const std::string x_m = std::string(sensor) == "VLC RF" ? "-0.1" : "0";
      write(std::string(sensor) + "_extrinsics.txt",
            "0,1,0," + x_m + ",1,0,0,0,0,0,-1,0,0,0,0,1\n");
      write(std::string(sensor) + "_rig2world.txt", poses);
    }
  }
  /// A rotation about y by 0.1 rad for each second, moving 0.1 m along x.
  static std::string pose_line(std::int64_t ticks) {
    const double t = static_cast<double>(ticks) * 1e-7;
    char line[400];
    std::snprintf(line, sizeof(line), "%lld,%.9g,0,%.9g,%.9g,0,1,0,0,%.9g,0,%.9g,0,0,0,0,1\n",
                  static_cast<long long>(kStart + ticks), std::cos(0.1 * t), std::sin(0.1 * t),
                  0.1 * t, -std::sin(0.1 * t), std::cos(0.1 * t));
    return line;
  }
  void write(const std::string& name, const std::string& text) const {
    write_text(folder_ / name, text);
  }
  void remove(const std::string& name) const { std::filesystem::remove(folder_ / name); }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

  /// A pinhole camera of 360 px.
  static const std::string& rays() {
    static const std::string bytes = [] {
      std::string made;
      for (int y = 0; y < 480; ++y) {
        for (int x = 0; x < 640; ++x) {
          const Vec3 ray = Vec3{(x + 0.5 - 320) / 360.0, (y + 0.5 - 240) / 360.0, 1}.normalized();
          for (int i = 0; i < 3; ++i) {
            const auto single = static_cast<float>(ray[i]);
            char raw[sizeof(float)];
            std::memcpy(raw, &single, sizeof(float));
            made.append(raw, sizeof(float));
          }
        }
      }
      return made;
    }();
    return bytes;
  }
  /// The same with one number of a pixel's ray replaced.
  static std::string rays_with(int x, int y, int component, float value) {
    std::string bytes = rays();
    const auto at = static_cast<std::size_t>((y * 640 + x) * 3 + component) * sizeof(float);
    std::memcpy(bytes.data() + at, &value, sizeof(float));
    return bytes;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace orthonav::test
