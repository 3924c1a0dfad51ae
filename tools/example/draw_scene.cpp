// Draws a scene off-screen, without a window or a display, and writes it as a picture.
//   draw_scene PICTURE.png
#include <orthonav/engine/io/image_file.h>
#include <orthonav/render/projection.h>
#include <orthonav/render/renderer.h>
#include <orthonav/render/shapes.h>

#include "must.h"

using namespace orthonav;

/// A dashed axis, a ring around its entry, a ball at its end and a line of text. Metres.
render::Scene example_scene() {
  const render::Float3 entry{0, 0.03f, 0};
  const render::Float3 target{0.01f, -0.02f, 0};
  render::Scene scene;
  render::LineItem axis;
  axis.label = 1;
  axis.points = {entry, target};
  axis.colour = {0.2f, 0.9f, 1.0f, 1.0f};
  axis.dash_m = 0.004f;
  scene.lines.push_back(axis);
  render::LineItem ring;
  ring.label = 2;
  ring.points = render::make_ring(entry, {0, 1, 0}, 0.008f);
  ring.closed = true;
  scene.lines.push_back(ring);
  render::MeshItem ball;
  ball.label = 3;
  ball.mesh = std::make_shared<render::MeshData>(render::make_sphere(0.003f));
  ball.world_from_model = render::placed_at(target);
  ball.colour = {1.0f, 0.6f, 0.1f, 1.0f};
  scene.meshes.push_back(ball);
  render::TextItem text;
  text.label = 4;
  text.runs.push_back({"L4 left", {}});
  text.position = {0, 0.045f, 0};
  scene.texts.push_back(text);
  return scene;
}

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("draw_scene PICTURE.png\n", stderr);
    return 2;
  }
  render::RendererOptions options;
  options.width_px = 640;
  options.height_px = 480;
  const auto renderer = must(render::Renderer::create(options));
  const render::View view =
      render::look_at({0.05f, 0.12f, 0.25f}, {0, 0.01f, 0}, {0, 1, 0}, 0.3f, 0.225f);
  std::vector<RgbaImage> images;
  must(renderer->draw(example_scene(), {view}, {}, images));
  must(engine::write_png(argv[1], images.front()));
  std::printf("%s, drawn by %s\n", argv[1], renderer->device().name.c_str());
}
