#include <algorithm>
#include <array>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/how_many.h"
#include "engine/golden/golden_scenes.h"
#include "engine/holograms/optical_model.h"
#include "engine/holograms/scene_file.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/io/image_file.h"
#include "engine/io/side_by_side.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

struct RenderArguments {
  std::string scene;
  std::string out;
  std::string eye = "both";
  std::string size;
  std::string blend = "additive";
  std::string background = "black";
  std::string device;
  bool optics = false;
  engine::OpticalModel model;
};

/// "WxH" in pixels of one eye.
Status read_size(const std::string& text, engine::SceneFile& file) {
  if (text.empty()) {
    return {};
  }
  const auto size = size_from(text);
  if (!size) {
    return Error{"--size: is \"" + text + "\", must be WIDTHxHEIGHT in px, as 1268x720"};
  }
  const auto [width, height] = *size;
  // The horizontal field of view stays; another aspect ratio shows more or less above and below.
  for (render::View& view : file.eyes) {
    const float shape = static_cast<float>(height) / static_cast<float>(std::max(width, 1));
    view.tan_up = view.tan_down = 0.5f * (view.tan_left + view.tan_right) * shape;
  }
  file.width_px = width;
  file.height_px = height;
  return {};
}

Result<std::optional<RgbaImage>> background_of(const std::string& name, int width_px,
                                               int height_px) {
  if (name == "black") {
    return std::optional<RgbaImage>{};
  }
  if (name == "wound") {
    return std::optional(engine::golden_background(width_px, height_px));
  }
  auto image = engine::read_png(name);
  if (!image) {
    return image.error();
  }
  if (image->width_px != width_px || image->height_px != height_px) {
    return Error{name + ": is " + std::to_string(image->width_px) + "x" +
                 std::to_string(image->height_px) + " px, must be " + std::to_string(width_px) +
                 "x" + std::to_string(height_px) + " as one eye"};
  }
  return std::optional(std::move(*image));
}

/// One line per hologram: its contrast in the light that was given.
void print_contrasts(const RgbaImage& light, const LabelImage& labels, const RgbaImage& background,
                     const engine::OpticalModel& model) {
  std::printf("hologram  pixels  contrast  faintest tenth\n");
  for (const engine::HologramContrast& c : engine::contrasts(light, labels, background, model)) {
    const bool legible = c.median >= engine::kLegibleContrast;
    std::printf("H%-3d #%-3zu %6d  %7.1f:1  %7.1f:1%s\n",
                static_cast<int>(engine::kind_of(c.label)), engine::instance_of(c.label), c.pixels,
                c.median, c.faint, legible ? "" : "  hard to make out (below 3:1)");
  }
}

/// The holograms in front of a background, as an optical see-through display shows them.
Status see_through(const RenderArguments& arguments, const engine::SceneFile& file,
                   const RgbaImage& background, render::Renderer& renderer,
                   std::vector<RgbaImage>& images) {
  std::vector<LabelImage> labels;
  if (const Status drawn = renderer.draw_labels(file.scene, file.eyes, labels); !drawn) {
    return drawn;
  }
  print_contrasts(images.front(), labels.front(), background, arguments.model);
  for (RgbaImage& image : images) {
    image = engine::through_combiner(image, background, arguments.model);
  }
  return {};
}

/// Draws the scene and writes the picture; `background` is one eye's, if there is one.
Status draw_scene(const RenderArguments& arguments, const engine::SceneFile& file,
                  const std::optional<RgbaImage>& background, render::Renderer& renderer) {
  std::vector<const RgbaImage*> backgrounds;
  if (background && !arguments.optics) {
    backgrounds.assign(file.eyes.size(), &*background);
  }
  std::vector<RgbaImage> images;
  const Status drawn = renderer.draw(file.scene, file.eyes, backgrounds, images);
  if (!drawn) {
    return Error{arguments.scene + ": " + drawn.error().message, drawn.error().code};
  }
  for (const std::string& note : renderer.notes()) {
    std::fprintf(stderr, "orthonav: %s\n", note.c_str());
  }
  if (arguments.optics) {
    const RgbaImage behind =
        background ? *background
                   : RgbaImage{file.width_px, file.height_px,
                               std::vector<std::uint8_t>(images.front().pixels.size(), 0)};
    if (const Status seen = see_through(arguments, file, behind, renderer, images); !seen) {
      return seen;
    }
  }
  const Status written =
      engine::write_png(arguments.out, engine::side_by_side(images, &RgbaImage::pixels, 4));
  if (!written) {
    return written;
  }
  std::printf("%s: %s, %dx%d px each, drawn by %s\n", arguments.out.c_str(),
              how_many(images.size(), "eye").c_str(), file.width_px, file.height_px,
              renderer.device().name.c_str());
  return {};
}

int render_scene(const RenderArguments& arguments) {
  if (const auto problems = arguments.model.check(); !problems.empty()) {
    return bad_input(problems.front());
  }
  auto file = engine::load_scene(arguments.scene);
  if (!file) {
    return bad_input(file.error().message);
  }
  if (const Status size = read_size(arguments.size, *file); !size) {
    return bad_input(size.error().message);
  }
  if (arguments.eye == "left") {
    file->eyes.resize(1);
  }
  if (arguments.eye == "right") {
    file->eyes.erase(file->eyes.begin());
  }
  render::RendererOptions options;
  options.width_px = file->width_px;
  options.height_px = file->height_px;
  options.device = arguments.device;
  options.blend = arguments.blend == "over" ? render::Blend::kOver : render::Blend::kAdditive;
  const auto background = background_of(arguments.background, options.width_px, options.height_px);
  if (!background) {
    return bad_input(background.error().message);
  }
  const auto renderer = render::Renderer::create(options);
  if (!renderer) {
    return bad_input(renderer.error().message);
  }
  const Status drawn = draw_scene(arguments, *file, *background, **renderer);
  return drawn ? kDone : bad_input(drawn.error().message);
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command =
      app.add_subcommand("render", "Draws the holograms of a scene file into a picture");
  command->add_option("SCENE", arguments->scene, "Scene file (docs/scene-files.md)")->required();
  command->add_option("-o,--out", arguments->out, "PNG to write; both eyes side by side")
      ->required();
  command->add_option("--eye", arguments->eye, "left, right or both")
      ->check(CLI::IsMember({"left", "right", "both"}))
      ->capture_default_str();
  command->add_option("--size", arguments->size, "of one eye, px (default: the file's)");
  command->add_option("--blend", arguments->blend, "additive as a headset, over as a preview")
      ->check(CLI::IsMember({"additive", "over"}))
      ->capture_default_str();
  command
      ->add_option("--background", arguments->background,
                   "black, wound, or a PNG of one eye's size")
      ->capture_default_str();
  command->add_option("--device", arguments->device, "Part of the Vulkan device's name");
  command->add_flag(
      "--optics", arguments->optics,
      "the holograms as seen through a combiner in a lit room; prints their contrasts");
  command->add_option("--display", arguments->model.display_cd_m2, "White of the display, cd/m2")
      ->capture_default_str();
  command->add_option("--ambient", arguments->model.ambient_lux, "Light on the background, lux")
      ->capture_default_str();
  command
      ->add_option("--transmission", arguments->model.combiner_fraction,
                   "Share of the world's light that the combiner passes")
      ->capture_default_str();
  command->callback(
      [&action, arguments] { action = [arguments] { return render_scene(*arguments); }; });
}

}  // namespace orthonav::tools
