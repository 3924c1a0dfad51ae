#include "tests/render/test_scenes.h"

#include <memory>

#include "render/shapes.h"

namespace orthonav::render {

Scene line_scene(float width_m, Float3 from, Float3 to) {
  Scene scene;
  LineItem line;
  line.label = 401;
  line.points = {from, to};
  line.width_m = width_m;
  line.colour = {1, 1, 1, 1};
  scene.lines.push_back(line);
  return scene;
}

Scene sphere_scene(MeshStyle style, Colour colour, Float3 at, Label label) {
  Scene scene;
  MeshItem item;
  item.label = label;
  item.mesh = std::make_shared<MeshData>(make_sphere(0.05f));
  item.world_from_model = placed_at(at);
  item.style = style;
  item.colour = colour;
  scene.meshes.push_back(item);
  return scene;
}

Scene crowded_scene() {
  Scene scene = sphere_scene(MeshStyle::kRim, {0.9f, 0.8f, 0.7f, 0.35f}, {0, 0, -1}, 201);
  const auto add = [&](const Scene& more) {
    for (const MeshItem& item : more.meshes) {
      scene.meshes.push_back(item);
    }
    for (const LineItem& item : more.lines) {
      scene.lines.push_back(item);
    }
  };
  add(sphere_scene(MeshStyle::kRim, {0.4f, 0.8f, 0.7f, 0.5f}, {0.03f, 0, -0.98f}, 202));
  add(sphere_scene(MeshStyle::kSolid, {0.1f, 0.3f, 1, 1}, {-0.05f, 0.02f, -1}, 301));
  add(sphere_scene(MeshStyle::kSolid, {0.1f, 0.7f, 0.2f, 1}, {-0.02f, 0.05f, -1}, 302));
  add(line_scene(0.02f, {-0.3f, -0.1f, -0.9f}, {0.3f, 0.1f, -1.2f}));
  add(line_scene(0.02f, {-0.3f, 0.1f, -0.9f}, {0.3f, -0.1f, -1.2f}));
  scene.lines[0].colour = {0.31f, 0.02f, 0.17f, 0.7f};
  scene.lines[1].colour = {0.07f, 0.43f, 0.11f, 0.6f};
  scene.lines[1].label = 402;
  for (Label k = 0; k < 3; ++k) {
    const float offset = 0.05f * static_cast<float>(k);
    scene.triangles.push_back(
        {501 + k,
         {Float3{-0.2f + offset, -0.1f, -1}, {0.2f, -0.1f, -1}, {0, 0.15f, -1}},
         {0.21f, 0.13f * static_cast<float>(k), 0.3f, 0.3f}});
    TextItem text;
    text.label = 601 + k;
    text.position = {0.01f * static_cast<float>(k), offset - 0.05f, -1};
    text.height_m = 0.05f;
    text.runs = {{"12.4°", {0.3f, 0.4f, 0.2f * static_cast<float>(k), 0.8f}}};
    text.rim = {0.5f, 0.1f, 0, 0.9f};
    scene.texts.push_back(text);
  }
  return scene;
}

}  // namespace orthonav::render
