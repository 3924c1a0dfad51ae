#include "tests/golden/golden_scene_edit.h"

#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine {
namespace {

using render::Float3;

/// The step of `pixels` to the right at a point's depth in the first view.
Float3 step_at(const GoldenScene& golden, Float3 point, float pixels) {
  const render::View& view = golden.views.front();
  const render::Matrix4& m = view.eye_from_world;
  const float depth_m = -render::transformed(m, point).z;
  const float metres =
      pixels * depth_m * (view.tan_left + view.tan_right) / static_cast<float>(golden.width_px);
  return metres * Float3{m[0], m[4], m[8]};
}

template <class Items>
void erase_label(Items& items, render::Label label, bool equal) {
  std::erase_if(items, [&](const auto& item) { return (item.label == label) == equal; });
}

void dim(render::Colour& colour) {
  for (float* channel : {&colour.r, &colour.g, &colour.b}) *channel *= 0.8f;
}

}  // namespace

std::set<render::Label> labels_in(const render::Scene& scene) {
  std::set<render::Label> labels;
  for (const auto& item : scene.meshes) labels.insert(item.label);
  for (const auto& item : scene.lines) labels.insert(item.label);
  for (const auto& item : scene.triangles) labels.insert(item.label);
  for (const auto& item : scene.texts) labels.insert(item.label);
  return labels;
}

GoldenScene without(GoldenScene golden, render::Label label) {
  erase_label(golden.scene.meshes, label, true);
  erase_label(golden.scene.lines, label, true);
  erase_label(golden.scene.triangles, label, true);
  erase_label(golden.scene.texts, label, true);
  return golden;
}

GoldenScene only(GoldenScene golden, render::Label label, bool with_text) {
  erase_label(golden.scene.meshes, label, false);
  erase_label(golden.scene.lines, label, false);
  erase_label(golden.scene.triangles, label, false);
  erase_label(golden.scene.texts, label, false);
  if (!with_text) golden.scene.texts.clear();
  return golden;
}

GoldenScene moved(GoldenScene golden, render::Label label, float pixels) {
  for (auto& item : golden.scene.meshes) {
    if (item.label != label) continue;
    render::Matrix4& m = item.world_from_model;
    const Float3 step = step_at(golden, {m[12], m[13], m[14]}, pixels);
    m[12] += step.x;
    m[13] += step.y;
    m[14] += step.z;
  }
  for (auto& item : golden.scene.lines) {
    if (item.label != label) continue;
    for (Float3& point : item.points) point = point + step_at(golden, point, pixels);
  }
  for (auto& item : golden.scene.triangles) {
    if (item.label != label) continue;
    for (Float3& corner : item.corners) corner = corner + step_at(golden, corner, pixels);
  }
  for (auto& item : golden.scene.texts) {
    if (item.label != label) continue;
    const render::View& view = golden.views.front();
    if (item.place == render::TextPlace::kWorld) {
      item.position = item.position + step_at(golden, item.position, pixels);
    } else {
      item.position.x -= item.position.z * pixels * (view.tan_left + view.tan_right) /
                         static_cast<float>(golden.width_px);
    }
  }
  return golden;
}

GoldenScene dimmed(GoldenScene golden, render::Label label) {
  for (auto& item : golden.scene.meshes) {
    if (item.label == label) dim(item.colour);
  }
  for (auto& item : golden.scene.lines) {
    if (item.label == label) dim(item.colour);
  }
  for (auto& item : golden.scene.triangles) {
    if (item.label == label) dim(item.colour);
  }
  for (auto& item : golden.scene.texts) {
    if (item.label != label) continue;
    for (auto& run : item.runs) dim(run.colour);
    dim(item.rim);
  }
  return golden;
}

bool change_digit(GoldenScene& golden, render::Label label) {
  for (auto& item : golden.scene.texts) {
    if (item.label != label) continue;
    for (auto& run : item.runs) {
      const std::size_t at = run.text.find_last_of("0123456789");
      if (at == std::string::npos) continue;
      run.text[at] = run.text[at] == '9' ? '0' : static_cast<char>(run.text[at] + 1);
      return true;
    }
  }
  return false;
}

}  // namespace orthonav::engine
