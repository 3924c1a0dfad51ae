#include "render/frame/scene_check.h"

#include <algorithm>
#include <cmath>

#include "render/float3.h"
#include "render/text/text_layout.h"

namespace orthonav::render {
namespace {

constexpr float kFarthest_m = 1e5f;  // beyond it, floats resolve centimetres only
constexpr float kWidest_m = 10.0f;
constexpr float kMaxDashes = 20000.0f;
constexpr float kColourSlack = 1e-3f;  // of a fade computed in floats
constexpr float kRigidSlack = 1e-3f;
constexpr float kUnitSlack = 1e-2f;  // of normals stored in few digits

bool is_place(Float3 p) {
  return std::abs(p.x) <= kFarthest_m && std::abs(p.y) <= kFarthest_m &&
         std::abs(p.z) <= kFarthest_m;  // false for NaN
}

bool is_between(float value, float low, float high) { return value >= low && value <= high; }

bool is_colour(const Colour& c) {
  const float top = 1 + kColourSlack;
  return is_between(c.r, 0, top) && is_between(c.g, 0, top) && is_between(c.b, 0, top) &&
         is_between(c.a, 0, top);
}

bool is_affine(const Matrix4& m) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!(std::abs(m[column][row]) <= kFarthest_m)) {
        return false;
      }
    }
  }
  return m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1;
}

/// Positive for a rotation with a scale, negative with a reflection.
float volume(const Matrix4& m) { return dot(cross(Float3(m[0]), Float3(m[1])), Float3(m[2])); }

bool is_rigid(const Matrix4& m) {
  if (!is_affine(m)) {
    return false;
  }
  const Float3 x(m[0]);
  const Float3 y(m[1]);
  const Float3 z(m[2]);
  const auto is_zero = [](float value) { return std::abs(value) <= kRigidSlack; };
  return is_zero(dot(x, x) - 1) && is_zero(dot(y, y) - 1) && is_zero(dot(x, y)) &&
         length(cross(x, y) - z) <= kRigidSlack;
}

/// Whether it is a rotation times one scale: columns of equal length, at right angles.
bool is_uniform(const Matrix4& m) {
  const Float3 x(m[0]);
  const Float3 y(m[1]);
  const Float3 z(m[2]);
  const float slack = kRigidSlack * dot(x, x);
  return std::abs(dot(y, y) - dot(x, x)) <= slack && std::abs(dot(z, z) - dot(x, x)) <= slack &&
         std::abs(dot(x, y)) <= slack && std::abs(dot(y, z)) <= slack &&
         std::abs(dot(z, x)) <= slack;
}

Status check_item(const MeshItem& item) {
  if (!item.mesh) {
    return Error{"has no mesh"};
  }
  if (!is_affine(item.world_from_model)) {
    return Error{"has a place that is not a finite affine matrix"};
  }
  if (!(volume(item.world_from_model) > 0)) {
    return Error{"transform is a reflection or singular"};
  }
  if (!is_uniform(item.world_from_model)) {
    return Error{"has a place that shears or scales unevenly"};
  }
  if (!is_colour(item.colour)) {
    return Error{"has a colour outside 0 to 1"};
  }
  if (!is_colour(item.tint)) {
    return Error{"has a tint outside 0 to 1"};
  }
  return {};
}

Status check_item(const LineItem& item) {
  float run_m = 0;
  for (std::size_t i = 0; i < item.points.size(); ++i) {
    if (!is_place(item.points[i])) {
      return Error{"point " + std::to_string(i) + " is not a finite place"};
    }
    if (i > 0) {
      run_m += length(item.points[i] - item.points[i - 1]);
    }
  }
  if (!is_between(item.width_m, 0, kWidest_m)) {
    return Error{"has a width outside 0 to 10 m"};
  }
  if (!is_between(item.dash_m, 0, kWidest_m)) {
    return Error{"has dashes outside 0 to 10 m"};
  }
  if (item.dash_m > 0 && run_m / item.dash_m > kMaxDashes) {
    return Error{"has more than 20000 dashes"};
  }
  if (!is_colour(item.colour)) {
    return Error{"has a colour outside 0 to 1"};
  }
  return {};
}

Status check_item(const TriangleItem& item) {
  if (!std::all_of(item.corners.begin(), item.corners.end(), is_place)) {
    return Error{"has a corner that is not a finite place"};
  }
  if (!is_colour(item.colour)) {
    return Error{"has a colour outside 0 to 1"};
  }
  return {};
}

Status check_item(const TextItem& item) {
  for (const TextRun& run : item.runs) {
    if (!is_utf8(run.text)) {
      return Error{"is not valid UTF-8"};
    }
    if (!is_colour(run.colour)) {
      return Error{"has a colour outside 0 to 1"};
    }
  }
  if (!is_place(item.position)) {
    return Error{"is not at a finite place"};
  }
  if (!is_between(item.height_m, 0, kWidest_m)) {
    return Error{"has a height outside 0 to 10 m"};
  }
  if (!is_between(item.min_height_deg, 0, 45)) {
    return Error{"has a least height outside 0 to 45 deg"};
  }
  if (!is_colour(item.rim)) {
    return Error{"has a rim outside 0 to 1"};
  }
  if (!is_place({item.offset_right, item.offset_up, 0})) {
    return Error{"has an offset that is not finite"};
  }
  return {};
}

template <class Item>
Status check_items(const ItemList<Item>& items, const char* kind) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (const Status checked = check_item(items[i]); !checked) {
      return Error{std::string("scene: ") + kind + " " + std::to_string(i) + " (label " +
                   std::to_string(items[i].label) + ") " + checked.error().message};
    }
  }
  return {};
}

Status check_indices(const MeshData& mesh, const std::vector<std::uint32_t>& indices) {
  if (indices.size() % 3 != 0) {
    return Error{std::to_string(indices.size()) + " indices, expected three a triangle"};
  }
  for (const std::uint32_t index : indices) {
    if (index >= mesh.positions.size()) {
      return Error{"index " + std::to_string(index) + ", limit " +
                   std::to_string(mesh.positions.size()) + " vertices"};
    }
  }
  return {};
}

}  // namespace

Status check_scene(const Scene& scene) {
  if (const Status checked = check_items(scene.meshes, "mesh"); !checked) {
    return checked;
  }
  if (const Status checked = check_items(scene.lines, "line"); !checked) {
    return checked;
  }
  if (const Status checked = check_items(scene.triangles, "triangle"); !checked) {
    return checked;
  }
  return check_items(scene.texts, "text");
}

Status check_views(const std::vector<View>& views) {
  if (views.empty() || views.size() > 2) {
    return Error{"views: " + std::to_string(views.size()) + ", expected 1 or 2"};
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    const View& view = views[i];
    const std::string name = "view " + std::to_string(i);
    if (!is_rigid(view.eye_from_world)) {
      return Error{name + ": eye_from_world is not a rigid transform"};
    }
    for (const float tangent : {view.tan_left, view.tan_right, view.tan_up, view.tan_down}) {
      if (!is_between(tangent, 1e-4f, 100.0f)) {
        return Error{name + ": tangent of a half angle " + std::to_string(tangent) +
                     ", expected 0.0001 to 100"};
      }
    }
  }
  return {};
}

Status check_mesh(const MeshData& mesh) {
  if (mesh.normals.size() != mesh.positions.size()) {
    return Error{std::to_string(mesh.normals.size()) + " normals for " +
                 std::to_string(mesh.positions.size()) + " vertices"};
  }
  if (!mesh.tints.empty() && mesh.tints.size() != mesh.positions.size()) {
    return Error{std::to_string(mesh.tints.size()) + " tints for " +
                 std::to_string(mesh.positions.size()) + " vertices"};
  }
  for (std::size_t i = 0; i < mesh.tints.size(); ++i) {
    if (!is_between(mesh.tints[i], 0, 1)) {
      return Error{"tint " + std::to_string(i) + " is outside 0 to 1"};
    }
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!is_place(mesh.positions[i])) {
      return Error{"vertex " + std::to_string(i) + " is not finite"};
    }
    // A normal without length has no direction, and its light would be NaN.
    if (!is_between(length(mesh.normals[i]), 1 - kUnitSlack, 1 + kUnitSlack)) {
      return Error{"normal " + std::to_string(i) + " is not of unit length"};
    }
  }
  if (const Status checked = check_indices(mesh, mesh.indices); !checked) {
    return checked;
  }
  for (const MeshLevel& level : mesh.levels) {
    if (const Status checked = check_indices(mesh, level.indices); !checked) {
      return checked;
    }
  }
  return {};
}

Status check_backgrounds(std::span<const RgbaImage* const> backgrounds,
                         const std::vector<View>& views, int width_px, int height_px) {
  if (backgrounds.empty()) {
    return {};
  }
  if (backgrounds.size() != views.size()) {
    return Error{"backgrounds: " + std::to_string(backgrounds.size()) + " for " +
                 std::to_string(views.size()) + " views"};
  }
  const std::string wanted = std::to_string(width_px) + "x" + std::to_string(height_px) + " px";
  for (std::size_t i = 0; i < backgrounds.size(); ++i) {
    const std::string name = "background " + std::to_string(i);
    if (backgrounds[i] == nullptr) {
      return Error{name + " is missing"};
    }
    const RgbaImage& image = *backgrounds[i];
    const auto bytes = 4 * static_cast<std::size_t>(width_px) * height_px;
    if (image.width_px != width_px || image.height_px != height_px ||
        image.pixels.size() != bytes) {
      return Error{name + ": " + std::to_string(image.width_px) + "x" +
                   std::to_string(image.height_px) + " px with " +
                   std::to_string(image.pixels.size()) + " bytes, expected " + wanted};
    }
  }
  return {};
}

Status check_options(const RendererOptions& options) {
  for (const int side_px : {options.width_px, options.height_px}) {
    if (side_px < 16 || side_px > 8192) {
      return Error{"renderer: image side " + std::to_string(side_px) + " px, expected 16 to 8192"};
    }
  }
  return {};
}

}  // namespace orthonav::render
