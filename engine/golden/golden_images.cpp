#include "engine/golden/golden_images.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "engine/io/image_file.h"
#include "engine/io/side_by_side.h"

namespace orthonav::engine {
GoldenPainter::GoldenPainter(std::string device, bool validation, render::MessageSink messages)
    : device_(std::move(device)),
      validation_(validation),
      messages_(messages ? std::move(messages) : std::make_shared<std::vector<std::string>>()) {}

Result<render::Renderer*> GoldenPainter::renderer_for(const GoldenScene& scene,
                                                      render::Blend blend) {
  auto& renderer = renderers_[{{scene.width_px, scene.height_px}, blend}];
  if (renderer) {
    return renderer.get();
  }
  render::RendererOptions options;
  options.width_px = scene.width_px;
  options.height_px = scene.height_px;
  options.blend = blend;
  options.device = device_;
  options.validation = validation_;
  options.messages = messages_;
  auto made = render::Renderer::create(options);
  if (!made) {
    return made.error();
  }
  renderer = std::move(*made);
  return renderer.get();
}

Result<GoldenImages> GoldenPainter::paint(const GoldenScene& scene) {
  const auto additive = renderer_for(scene, render::Blend::kAdditive);
  if (!additive) {
    return additive.error();
  }
  const auto over = renderer_for(scene, render::Blend::kOver);
  if (!over) {
    return over.error();
  }
  GoldenImages images;
  std::vector<RgbaImage> colour;
  Status drawn = (*additive)->draw(scene.scene, scene.views, {}, colour);
  if (!drawn) {
    return drawn.error();
  }
  images.additive = side_by_side(colour, &RgbaImage::pixels, 4);
  RgbaImage& background = backgrounds_[{{scene.width_px, scene.height_px}, scene.behind}];
  if (background.pixels.empty()) {
    background = golden_background(scene.width_px, scene.height_px, scene.behind);
  }
  const std::vector<const RgbaImage*> behind(scene.views.size(), &background);
  drawn = (*over)->draw(scene.scene, scene.views, behind, colour);
  if (!drawn) {
    return drawn.error();
  }
  images.over = side_by_side(colour, &RgbaImage::pixels, 4);
  std::vector<LabelImage> labels;
  drawn = (*additive)->draw_labels(scene.scene, scene.views, labels);
  if (!drawn) {
    return drawn.error();
  }
  images.labels = side_by_side(labels, &LabelImage::labels, 1);
  return images;
}

std::vector<std::string> golden_files(const std::string& scene_name) {
  return {scene_name + ".labels.png", scene_name + ".additive.png", scene_name + ".over.png"};
}

Result<GoldenImages> read_goldens(const std::filesystem::path& folder,
                                  const std::string& scene_name) {
  const std::vector<std::string> files = golden_files(scene_name);
  auto labels = read_png(folder / files[0]);
  if (!labels) {
    return labels.error();
  }
  auto additive = read_png(folder / files[1]);
  if (!additive) {
    return additive.error();
  }
  auto over = read_png(folder / files[2]);
  if (!over) {
    return over.error();
  }
  return GoldenImages{labels_of_picture(*labels), std::move(*additive), std::move(*over)};
}

Status write_goldens(const std::filesystem::path& folder, const std::string& scene_name,
                     const GoldenImages& images) {
  const Result<RgbaImage> labels = picture_of_labels(images.labels);
  if (!labels) {
    return labels.error();
  }
  const std::vector<std::string> files = golden_files(scene_name);
  if (Status status = write_png(folder / files[0], *labels); !status) {
    return status;
  }
  if (Status status = write_png(folder / files[1], images.additive); !status) {
    return status;
  }
  return write_png(folder / files[2], images.over);
}

std::vector<std::string> differences(const GoldenImages& expected, const GoldenImages& actual) {
  std::vector<std::string> lines;
  const auto labels = render::compare_labels(expected.labels, actual.labels);
  if (!labels.alike()) {
    lines.push_back("labels: " + labels.text());
  }
  const auto additive = render::compare_colour(expected.additive, actual.additive);
  if (!additive.alike()) {
    lines.push_back("additive: " + additive.text());
  }
  const auto over = render::compare_colour(expected.over, actual.over);
  if (!over.alike()) {
    lines.push_back("over: " + over.text());
  }
  return lines;
}

std::vector<std::string> orphaned_goldens(const std::filesystem::path& folder,
                                          const std::vector<GoldenScene>& scenes) {
  std::set<std::string> known;
  for (const GoldenScene& scene : scenes) {
    for (std::string& file : golden_files(scene.name)) {
      known.insert(std::move(file));
    }
  }
  std::vector<std::string> orphans;
  std::error_code failure;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".png" && !known.contains(name)) {
      orphans.push_back(name);
    }
  }
  std::sort(orphans.begin(), orphans.end());
  return orphans;
}

}  // namespace orthonav::engine
