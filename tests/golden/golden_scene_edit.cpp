#include "tests/golden/golden_scene_edit.h"

#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine {
namespace {

using render::Float3;

/// The step in the first view's own axes at a depth, metres.
Float3 step_in_eye(const GoldenScene& golden, float depth_m, PixelStep step) {
  const render::View& view = golden.views.front();
  const float across = (view.tan_left + view.tan_right) / static_cast<float>(golden.width_px);
  const float down = (view.tan_up + view.tan_down) / static_cast<float>(golden.height_px);
  return {step.right * depth_m * across, -step.down * depth_m * down, 0};
}

/// The same in the world at a point's depth.
Float3 step_at(const GoldenScene& golden, Float3 point, PixelStep step) {
  const render::Matrix4& m = golden.views.front().eye_from_world;
  const Float3 in_eye = step_in_eye(golden, -render::transformed(m, point).z, step);
  return in_eye.x * Float3{m[0].x, m[1].x, m[2].x} + in_eye.y * Float3{m[0].y, m[1].y, m[2].y};
}

/// The numbers of a text, each by the place of its last digit.
std::vector<std::size_t> number_ends(const std::string& text) {
  const auto is_digit = [&](std::size_t i) { return text[i] >= '0' && text[i] <= '9'; };
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_digit(i) && (i + 1 == text.size() || !is_digit(i + 1))) {
      ends.push_back(i);
    }
  }
  return ends;
}

template <class Items>
void erase_label(Items& items, render::Label label, bool equal) {
  items.erase_if([&](const auto& item) { return (item.label == label) == equal; });
}

void dim(render::Colour& colour) {
  for (float* channel : {&colour.r, &colour.g, &colour.b}) {
    *channel *= 0.8f;
  }
}

}  // namespace

std::set<render::Label> labels_in(const render::Scene& scene) {
  std::set<render::Label> labels;
  for (const auto& item : scene.meshes) {
    labels.insert(item.label);
  }
  for (const auto& item : scene.lines) {
    labels.insert(item.label);
  }
  for (const auto& item : scene.triangles) {
    labels.insert(item.label);
  }
  for (const auto& item : scene.texts) {
    labels.insert(item.label);
  }
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
  if (!with_text) {
    golden.scene.texts.clear();
  }
  return golden;
}

GoldenScene only_shapes(GoldenScene golden) {
  golden.scene.texts.clear();
  return golden;
}

GoldenScene moved(GoldenScene golden, render::Label label, PixelStep step) {
  for (auto& item : golden.scene.meshes) {
    if (item.label != label) {
      continue;
    }
    render::Matrix4& m = item.world_from_model;
    const Float3 offset = step_at(golden, Float3(m[3]), step);
    m[3].x += offset.x;
    m[3].y += offset.y;
    m[3].z += offset.z;
  }
  for (auto& item : golden.scene.lines) {
    if (item.label != label) {
      continue;
    }
    for (Float3& point : item.points) {
      point = point + step_at(golden, point, step);
    }
  }
  for (auto& item : golden.scene.triangles) {
    if (item.label != label) {
      continue;
    }
    for (Float3& corner : item.corners) {
      corner = corner + step_at(golden, corner, step);
    }
  }
  for (auto& item : golden.scene.texts) {
    if (item.label != label) {
      continue;
    }
    if (item.place == render::TextPlace::kWorld) {
      item.position = item.position + step_at(golden, item.position, step);
    } else {
      item.position = item.position + step_in_eye(golden, -item.position.z, step);
    }
  }
  return golden;
}

GoldenScene dimmed(GoldenScene golden, render::Label label) {
  for (auto& item : golden.scene.meshes) {
    if (item.label == label) {
      dim(item.colour);
    }
  }
  for (auto& item : golden.scene.lines) {
    if (item.label == label) {
      dim(item.colour);
    }
  }
  for (auto& item : golden.scene.triangles) {
    if (item.label == label) {
      dim(item.colour);
    }
  }
  for (auto& item : golden.scene.texts) {
    if (item.label != label) {
      continue;
    }
    for (auto& run : item.runs) {
      dim(run.colour);
    }
    dim(item.rim);
  }
  return golden;
}

std::vector<GoldenScene> with_one_number_changed(const GoldenScene& golden) {
  std::vector<GoldenScene> changed;
  const auto& texts = golden.scene.texts;
  for (std::size_t t = 0; t < texts.size(); ++t) {
    for (std::size_t r = 0; r < texts[t].runs.size(); ++r) {
      for (const std::size_t end : number_ends(texts[t].runs[r].text)) {
        changed.push_back(golden);
        char& digit = changed.back().scene.texts[t].runs[r].text[end];
        digit = digit == '9' ? '0' : static_cast<char>(digit + 1);
      }
    }
  }
  return changed;
}

}  // namespace orthonav::engine
