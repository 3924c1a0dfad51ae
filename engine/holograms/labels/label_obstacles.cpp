#include "engine/holograms/labels/label_obstacles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/holograms/shapes/hologram_label.h"
#include "render/float3.h"

namespace orthonav::engine {
namespace {

using render::Float3;
using render::Label;
using Kind = LabelObstacle::Kind;

constexpr float kRodRadius_m = 0.003f;
constexpr float kLineHalfWidth_m = 0.001f;

/// Spheres and diamonds are unit shapes, scaled down; bones and rods are drawn life-size.
bool is_small(const render::MeshItem& mesh) {
  const render::Matrix4& m = mesh.world_from_model;
  return render::length(Float3(m[0])) < 0.1f;
}

bool names_something(Label label) {
  const HologramKind kind = kind_of(label);
  return kind == HologramKind::kEntry || kind == HologramKind::kRod ||
         kind == HologramKind::kCheckPoint;
}

class Finder {
 public:
  Finder(const Eyes& eyes, std::vector<LabelObstacle>& obstacles)
      : eyes_(eyes), obstacles_(obstacles) {
    obstacles_.clear();
  }

  void add(Kind kind, Label label, std::span<const Float3> corners, float radius_m) {
    obstacles_.push_back({kind, label, eyes_.outline(corners, radius_m)});
  }

  void add_small_shapes(const render::Scene& scene) {
    const render::MeshItem* before = nullptr;  // along a rod
    for (const render::MeshItem& mesh : scene.meshes) {
      if (!names_something(mesh.label) || !is_small(mesh)) {
        continue;
      }
      const render::Matrix4& m = mesh.world_from_model;
      const std::array<Float3, 1> centre = {{Float3(m[3])}};
      add(Kind::kNamed, mesh.label, centre, render::length(Float3(m[0])));
      const bool rod = kind_of(mesh.label) == HologramKind::kRod;
      if (rod && before && before->label == mesh.label) {
        const render::Matrix4& b = before->world_from_model;
        const std::array<Float3, 2> span = {{Float3(b[3]), centre[0]}};
        add(Kind::kNamed, mesh.label, span, kRodRadius_m);
      }
      before = rod ? &mesh : nullptr;
    }
  }

  void add_ring(const render::LineItem& line) {
    std::array<Float3, 1> middle{};
    for (const Float3 p : line.points) {
      middle[0] = middle[0] + 1.0f / static_cast<float>(line.points.size()) * p;
    }
    float radius_m = 0;
    for (const Float3 p : line.points) {
      radius_m = std::max(radius_m, render::length(p - middle[0]));
    }
    add(Kind::kNamed, line.label, middle, radius_m + 0.5f * line.width_m);
  }

  void add_trajectory(const render::LineItem& line) {
    add(Kind::kLine, line.label, line.points, kLineHalfWidth_m);
    if (line.dash_m == 0) {  // the part outside ends at the entry
      add(Kind::kWound, line.label, std::span(line.points).last(1), kWoundRadius_m);
    }
  }

  /// The axis of a rod in hand, and the arrow on it.
  void add_rod_line(const render::LineItem& line) {
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
      add(Kind::kNamed, line.label, std::span(line.points).subspan(i, 2), kRodRadius_m);
    }
  }

  void add_lines(const render::Scene& scene) {
    for (const render::LineItem& line : scene.lines) {
      const bool cross = kind_of(line.label) == HologramKind::kCross;
      if (line.closed && line.points.size() > 4 && (cross || names_something(line.label))) {
        add_ring(line);
      } else if (!line.closed && kind_of(line.label) == HologramKind::kRod) {
        add_rod_line(line);
      } else if (kind_of(line.label) == HologramKind::kTrajectory && line.points.size() == 2) {
        add_trajectory(line);
      }
    }
  }

 private:
  const Eyes& eyes_;
  std::vector<LabelObstacle>& obstacles_;
};

}  // namespace

void find_obstacles(const render::Scene& scene, std::span<const GlarePatch> patches,
                    const Eyes& eyes, std::vector<LabelObstacle>& obstacles) {
  Finder finder(eyes, obstacles);
  for (const GlarePatch& patch : patches) {
    finder.add(Kind::kGlare, 0, patch, 0);
  }
  finder.add_small_shapes(scene);
  finder.add_lines(scene);
  for (const render::TriangleItem& triangle : scene.triangles) {
    if (kind_of(triangle.label) == HologramKind::kTriangle) {
      finder.add(Kind::kLine, triangle.label, triangle.corners, kLineHalfWidth_m);
    } else if (kind_of(triangle.label) == HologramKind::kTrajectory) {  // the way to the entry
      finder.add(Kind::kNamed, triangle.label, triangle.corners, 0);
    }
  }
}

void add_wound(const render::Scene& scene, const Eyes& eyes,
               std::vector<LabelObstacle>& obstacles) {
  // Along the longer side of what the head sees.
  const render::Head& head = eyes.head();
  const auto for_each_place = [&](const auto& take) {
    for (const render::MeshItem& mesh : scene.meshes) {
      if (kind_of(mesh.label) == HologramKind::kEntry) {
        const render::Matrix4& m = mesh.world_from_model;
        take(Float3(m[3]));
      }
    }
    for (const render::LineItem& line : scene.lines) {
      const HologramKind kind = kind_of(line.label);
      if (kind == HologramKind::kEntry || kind == HologramKind::kPath) {
        std::for_each(line.points.begin(), line.points.end(), take);
      }
    }
  };
  float count = 0;
  Float3 sum{};
  for_each_place([&](Float3 p) {
    count += 1;
    sum = sum + p;
  });
  if (count == 0) {
    return;
  }
  const Float3 middle = (1.0f / count) * sum;
  float across2 = 0, along2 = 0, both = 0;
  for_each_place([&](Float3 p) {
    const float x = dot(p - middle, head.right), y = dot(p - middle, head.up);
    across2 += x * x;
    along2 += y * y;
    both += x * y;
  });
  const float turned = 0.5f * std::atan2(2 * both, across2 - along2);
  const Float3 longer = std::cos(turned) * head.right + std::sin(turned) * head.up;
  const Float3 shorter = std::cos(turned) * head.up - std::sin(turned) * head.right;
  std::array<float, 4> ends{};  // least and most along each
  for_each_place([&](Float3 p) {
    const float x = dot(p - middle, longer), y = dot(p - middle, shorter);
    ends = {std::min(ends[0], x), std::max(ends[1], x), std::min(ends[2], y), std::max(ends[3], y)};
  });
  const std::array<Float3, 4> corners = {
      middle + ends[0] * longer + ends[2] * shorter, middle + ends[1] * longer + ends[2] * shorter,
      middle + ends[1] * longer + ends[3] * shorter, middle + ends[0] * longer + ends[3] * shorter};
  obstacles.push_back({Kind::kWound, 0, eyes.outline(corners, kOpenRadius_m)});
}

}  // namespace orthonav::engine
