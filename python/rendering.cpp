#include <pybind11/stl.h>

#include "engine/holograms/scene_file.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "render/renderer.h"

namespace orthonav::python {
namespace {

py::array array_of_eyes(const std::vector<RgbaImage>& eyes) {
  std::vector<std::uint8_t> pixels;
  for (const RgbaImage& eye : eyes) {
    pixels.insert(pixels.end(), eye.pixels.begin(), eye.pixels.end());
  }
  const std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(eyes.size()),
                                          eyes.front().height_px, eyes.front().width_px, 4};
  return py::array_t<std::uint8_t>(shape, pixels.data());
}

py::array draw(const engine::SceneFile& file, const std::string& device) {
  std::vector<RgbaImage> eyes;
  {
    const py::gil_scoped_release others_run;
    render::RendererOptions options;
    options.width_px = file.width_px;
    options.height_px = file.height_px;
    options.device = device;
    const auto renderer = value_of(render::Renderer::create(options));
    succeed(renderer->draw(file.scene, file.eyes, {}, eyes));
  }
  return array_of_eyes(eyes);
}

}  // namespace

void bind_rendering(py::module_& module) {
  module.def(
      "render_file",
      [](const std::string& path, const std::string& device) {
        return draw(value_of(engine::load_scene(path)), device);
      },
      py::arg("path"), py::arg("device") = "",
      "Draws a scene file (docs/scene-files.md) off-screen: uint8, eyes x rows x columns x RGBA.\n"
      "device: part of a Vulkan device's name; empty: the best one, which may be the processor.");
  module.def(
      "render_text",
      [](const std::string& text, const std::string& folder, const std::string& device) {
        return draw(value_of(engine::parse_scene(text, "scene", folder)), device);
      },
      py::arg("text"), py::arg("folder") = "", py::arg("device") = "",
      "The same of the text of a scene file; folder: where the meshes lie that it names.");
}

}  // namespace orthonav::python
