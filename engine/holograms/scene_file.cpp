#include "engine/holograms/scene_file.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "base/angle.h"
#include "engine/holograms/scene_file_holograms.h"
#include "engine/holograms/scene_file_values.h"
#include "engine/holograms/shapes/render_values.h"
#include "engine/io/json_document.h"
#include "render/float3.h"
#include "render/projection.h"

namespace orthonav::engine {
namespace {

constexpr int kSmallest_px = 16;
constexpr int kLargest_px = 8192;
constexpr std::size_t kMaxHolograms = 1000;

double number_or(const JsonNode& node, const char* key, double fallback, double low, double high,
                 const char* unit) {
  return node.has(key) ? number_between(node, key, low, high, unit) : fallback;
}

void read_view(const JsonNode& view, SceneFile& file) {
  const render::Float3 eye = place_from(view, "eye_mm");
  const render::Float3 target = place_from(view, "target_mm");
  if (render::length(target - eye) < 1e-3f) {
    view.refuse("target_mm", "is where the eye is");
  }
  render::Float3 up{0, 1, 0};
  if (view.has("up")) {
    up = to_float3(view.vec3("up"));
  }
  if (render::length(render::cross(up, target - eye)) < 1e-6f) {
    view.refuse("up", "must not lie along the line of sight");
  }
  const auto pixels = [&view](const char* key, int fallback) {
    (void)number_or(view, key, fallback, kSmallest_px, kLargest_px, "px");
    return view.has(key) ? view.integer(key) : fallback;
  };
  file.width_px = pixels("width_px", file.width_px);
  file.height_px = pixels("height_px", file.height_px);
  const double width_deg = number_or(view, "width_deg", 43.0, 1.0, 150.0, "deg");
  const double apart_mm = number_or(view, "eyes_apart_mm", 63.0, 0.0, 100.0, "mm");
  const auto across = static_cast<float>(std::tan(0.5 * width_deg * kRadiansPerDegree));
  const float high =
      across * static_cast<float>(file.height_px) / static_cast<float>(file.width_px);
  file.eyes = render::stereo_pair(render::look_at(eye, target, up, across, high),
                                  static_cast<float>(apart_mm * 1e-3));
}

Result<SceneFile> scene_of(const JsonDocument& document, const std::string& folder) {
  const JsonNode root = document.root();
  if (root.text("format") != "orthonav-scene") {
    root.refuse("format", "must be \"orthonav-scene\"");
  }
  if (root.integer("version") != 1) {
    root.refuse("version", "must be 1");
  }
  SceneFile file;
  read_view(root.child("view"), file);
  const std::vector<JsonNode> holograms = root.list("holograms");
  if (holograms.size() > kMaxHolograms) {
    root.refuse("holograms", "holds " + std::to_string(holograms.size()) + ", at most " +
                                 std::to_string(kMaxHolograms));
  }
  std::map<std::string, std::size_t> count;
  for (const JsonNode& node : holograms) {
    if (!document.status()) {
      break;
    }
    add_hologram(node, folder, ++count[node.text("type")], file.scene);
  }
  if (const Status status = document.status(); !status) {
    return status.error();
  }
  return file;
}

}  // namespace

Result<SceneFile> load_scene(const std::string& path) {
  const auto document = JsonDocument::read(path);
  if (!document) {
    return document.error();
  }
  return scene_of(*document, std::filesystem::path(path).parent_path().string());
}

Result<SceneFile> parse_scene(const std::string& text, const std::string& name,
                              const std::string& folder) {
  const auto document = JsonDocument::parse(text, name);
  return document ? scene_of(*document, folder) : Result<SceneFile>(document.error());
}

}  // namespace orthonav::engine
