#include "tests/support/anatomy.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <utility>

#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace orthonav::test {

using orthonav::test::content_of;

namespace {

nav::TriangleMesh binary_stl(const std::string& bytes) {
  nav::TriangleMesh mesh;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    float values[12];
    std::memcpy(values, bytes.data() + at, sizeof values);
    const auto base = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (std::size_t k = 3; k < 12; k += 3) {
      mesh.vertices_m.push_back({values[k] * 1e-3, values[k + 1] * 1e-3, values[k + 2] * 1e-3});
    }
    mesh.triangles.push_back({base, base + 1, base + 2});
  }
  return nav::welded(mesh);
}

/// The three numbers after `key`, from `at` on; moves `at` behind them.
Vec3 vector_after(const std::string& text, const std::string& key, std::size_t& at) {
  at = text.find('[', text.find(key, at)) + 1;
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    char* end = nullptr;
    v[i] = std::strtod(text.c_str() + at, &end) * 1e-3;
    at = static_cast<std::size_t>(end - text.c_str()) + 1;
  }
  return v;
}

std::vector<nav::ScrewPlan> plan(const std::string& text) {
  std::vector<nav::ScrewPlan> screws;
  for (std::size_t at = 0; (at = text.find("\"side\"", at)) != std::string::npos;) {
    nav::ScrewPlan screw;
    screw.side = text.find("left", at) - at < 20 ? nav::Side::kLeft : nav::Side::kRight;
    screw.entry.v = vector_after(text, "\"entry\"", at);
    screw.target.v = vector_after(text, "\"target\"", at);
    at = text.find(':', text.find("\"radius\"", at)) + 1;
    screw.radius_m = std::strtod(text.c_str() + at, nullptr) * 1e-3;
    screws.push_back(screw);
  }
  return screws;
}

AnatomyLevel level_of(std::filesystem::path file) {
  const std::string name = file.parent_path().filename().string() + "/" + file.stem().string();
  nav::TriangleMesh mesh = binary_stl(content_of(file));
  return {name, std::move(mesh), plan(content_of(file.replace_extension(".plan.json")))};
}

struct Stroker {
  const nav::SurfaceIndex surface;
  double front_m;  ///< limit in front of which nothing is touched
  Random& random;
  std::vector<Vec3> tips_m;

  void touch(Vec3 from_m, Vec3 direction) {
    const auto hit = surface.first_hit(from_m, direction);
    if (hit && hit->point_m.y > front_m) {
      tips_m.push_back(hit->point_m);
    }
  }
  /// A sweep to and fro from behind over x in [from, to], drifting from z low to high.
  void sweep(double from_x, double to_x, double low_z, double high_z, int rows) {
    constexpr double kStep_m = 0.0007;
    const int steps = std::max(2, static_cast<int>(std::abs(to_x - from_x) / kStep_m));
    for (int row = 0; row < rows; ++row) {
      const double z0 = low_z + (high_z - low_z) * (row + random.uniform(0.2, 0.8)) / rows;
      const double slope_m = random.uniform(-0.002, 0.002);
      for (int i = 0; i <= steps; ++i) {
        const double s = static_cast<double>(row % 2 == 0 ? i : steps - i) / steps;
        touch({from_x + (to_x - from_x) * s, 0.2, z0 + slope_m * s}, {0, -1, 0});
      }
    }
  }
  /// Along the spinous process from its root to its tip, with the pointer held obliquely from one
  /// side.
  void flank(double side, double from_y, double to_y, double z) {
    constexpr double kStep_m = 0.0007;
    const int steps = std::max(2, static_cast<int>((to_y - from_y) / kStep_m));
    const Vec3 direction{-side * std::cos(0.5), -std::sin(0.5), 0};
    for (int i = 0; i <= steps; ++i) {
      const Vec3 aim{0, from_y + (to_y - from_y) * i / steps, z};
      touch(aim - 0.1 * direction, direction);
    }
  }
};

}  // namespace

std::vector<AnatomyLevel> anatomy_levels() {
  std::vector<std::filesystem::path> files;
  for (const char* subject : {"morph-a", "morph-b", "shape-mean", "visible-human"}) {
    const std::filesystem::path folder = test_data("anatomy/" + std::string(subject));
    if (!std::filesystem::is_directory(folder)) {
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".stl") {
        files.push_back(entry.path());
      }
    }
  }
  // Sorted by subject and level, independent of folders.
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return std::pair(a.parent_path().filename(), a.filename()) <
           std::pair(b.parent_path().filename(), b.filename());
  });
  std::vector<AnatomyLevel> levels;
  for (const std::filesystem::path& file : files) {
    levels.push_back(level_of(file));
  }
  return levels;
}

std::vector<AnatomyLevel> sampled_anatomy_levels() {
  constexpr std::size_t kOwn = 5;
  std::vector<AnatomyLevel> all = anatomy_levels();
  if (all.size() <= kOwn) {
    return all;
  }
  std::vector<AnatomyLevel> sampled;
  for (std::size_t i = 0; i < all.size(); i += 4) {
    sampled.push_back(std::move(all[i]));
  }
  return sampled;
}

std::optional<AnatomyLevel> anatomy_level(const std::string& name) {
  const std::filesystem::path file = test_data("anatomy/" + name + ".stl");
  if (!std::filesystem::is_regular_file(file)) {
    return std::nullopt;
  }
  return level_of(file);
}

std::vector<Vec3> strokes(const AnatomyLevel& level, const StrokeRegions& regions, Random& random) {
  const Vec3 left = level.screws.at(0).entry.v;
  const Vec3 right = level.screws.at(1).entry.v;
  const Vec3 middle = 0.5 * (left + right);
  Stroker s{nav::SurfaceIndex(level.mesh), middle.y - 0.010, random, {}};
  double back_y = -1.0;
  double back_z = 0.0;
  for (const Vec3& v : level.mesh.vertices_m) {
    if (std::abs(v.x) < 0.006 && v.y > back_y) {
      back_y = v.y, back_z = v.z;
    }
  }
  const double half_m = 0.5 * std::abs(left.x - right.x);
  if (regions.laminae) {
    s.sweep(0.003, 0.6 * half_m, middle.z - 0.022, middle.z - 0.002, 8);
    s.sweep(-0.003, -0.6 * half_m, middle.z - 0.022, middle.z - 0.002, 8);
  }
  if (regions.facets) {
    s.sweep(0.5 * half_m, half_m + 0.006, middle.z - 0.025, middle.z + 0.012, 8);
    s.sweep(-0.5 * half_m, -half_m - 0.006, middle.z - 0.025, middle.z + 0.012, 8);
  }
  if (regions.spinous_process) {
    for (int row = 0; row < 4; ++row) {
      for (const double side : {1.0, -1.0}) {
        s.flank(side, middle.y + 0.008, back_y, back_z + random.uniform(-0.008, 0.010));
      }
    }
  }
  return std::move(s.tips_m);
}

Mat3 random_rotation(Random& random) {
  Quaternion q{random.normal(), random.normal(), random.normal(), random.normal()};
  const double n = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return rotation_from_quaternion({q.x / n, q.y / n, q.z / n, q.w / n});
}

}  // namespace orthonav::test
