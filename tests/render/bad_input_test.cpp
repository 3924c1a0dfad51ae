#include <gmock/gmock.h>

#include <cstdlib>
#include <limits>

#include "render/float3.h"
#include "render/shapes.h"
#include "tests/render/test_renderer.h"
#include "tests/support/test_device.h"

namespace orthonav::render {
namespace {

using ::testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// A scene with one of everything, all well.
Scene good_scene() {
  Scene scene;
  MeshItem mesh;
  mesh.label = 201;
  mesh.mesh = std::make_shared<MeshData>(make_sphere(0.05f));
  mesh.world_from_model = placed_at({0, 0, -1});
  scene.meshes.push_back(mesh);
  LineItem line;
  line.label = 401;
  line.points = {{0, 0, -1}, {0.1f, 0, -1}};
  scene.lines.push_back(line);
  scene.triangles.push_back({501, {Float3{0, 0, -1}, {0.1f, 0, -1}, {0, 0.1f, -1}}, {}});
  TextItem text;
  text.label = 601;
  text.position = {0, 0, -1};
  text.runs = {{"12.4°", {}}};
  scene.texts.push_back(text);
  return scene;
}

class BadScene : public ::testing::Test {
 protected:
  void SetUp() override {
    const RgbaImage image = renderer_.draw(good_scene(), TestRenderer::straight_ahead());
    ASSERT_FALSE(image.pixels.empty());
  }
  /// After any refusal a good frame must still come out.
  void TearDown() override { renderer_.draw(good_scene(), TestRenderer::straight_ahead()); }
  TestRenderer renderer_;
  Scene scene_ = good_scene();
};

TEST_F(BadScene, NotFinitePointOfALineIsNamed) {
  scene_.lines[0].points[1].y = kNaN;
  EXPECT_EQ(renderer_.error_of(scene_), "scene: line 0 (label 401) point 1 is not a finite place");
}

TEST_F(BadScene, NotFiniteTriangleAndTextAreNamed) {
  scene_.triangles[0].corners[2].z = std::numeric_limits<float>::infinity();
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("triangle 0 (label 501)"));
  scene_ = good_scene();
  scene_.texts[0].position.x = kNaN;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("text 0 (label 601)"));
  scene_ = good_scene();
  scene_.texts[0].height_m = kNaN;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("height"));
}

TEST_F(BadScene, TextThatIsNoUtf8IsNamed) {
  scene_.texts[0].runs[0].text = "12.4\xb0";
  EXPECT_EQ(renderer_.error_of(scene_), "scene: text 0 (label 601) is not valid UTF-8");
}

TEST_F(BadScene, ColoursOutsideTheRangeAreNamed) {
  scene_.lines[0].colour.g = -0.1f;
  EXPECT_THAT(renderer_.error_of(scene_),
              HasSubstr("line 0 (label 401) has a colour outside 0 to 1"));
  scene_ = good_scene();
  scene_.meshes[0].colour.a = kNaN;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("mesh 0 (label 201) has a colour"));
}

TEST_F(BadScene, MeshesThatCantBeDrawnAreNamed) {
  scene_.meshes[0].mesh = nullptr;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("mesh 0 (label 201) has no mesh"));
  MeshData data = make_sphere(0.05f);
  data.positions[17].x = kNaN;
  scene_.meshes[0].mesh = std::make_shared<MeshData>(data);
  EXPECT_EQ(renderer_.error_of(scene_), "scene: mesh 0 (label 201): vertex 17 is not finite");
  data = make_sphere(0.05f);
  data.indices[5] = 100000;
  scene_.meshes[0].mesh = std::make_shared<MeshData>(data);
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("index 100000, limit"));
  data = make_sphere(0.05f);
  data.normals.pop_back();
  scene_.meshes[0].mesh = std::make_shared<MeshData>(data);
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("normals for"));
  data = make_sphere(0.05f);
  data.tints.assign(3, 0.5f);
  scene_.meshes[0].mesh = std::make_shared<MeshData>(data);
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("3 tints for"));
  data.tints.assign(data.positions.size(), 1.5f);
  scene_.meshes[0].mesh = std::make_shared<MeshData>(data);
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("tint 0 is outside"));
  data = make_sphere(0.05f);
  data.indices.pop_back();
  scene_.meshes[0].mesh = std::make_shared<MeshData>(data);
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("three a triangle"));
}

TEST_F(BadScene, MirroredPlacesAreRefused) {
  scene_.meshes[0].world_from_model[0].x = -1;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("is a reflection or singular"));
  scene_ = good_scene();
  scene_.meshes[0].world_from_model[3].y = kNaN;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("finite affine"));
}

TEST_F(BadScene, NormalsThatAreNotUnitVectorsAreNamed) {
  for (const Float3 wrong :
       {Float3{0, 0, 0}, Float3{0, 0, 1.5f}, Float3{0, kNaN, 0}, Float3{0, 0, 0.5f}}) {
    MeshData data = make_sphere(0.05f);
    data.normals[7] = wrong;
    scene_.meshes[0].mesh = std::make_shared<MeshData>(data);
    EXPECT_EQ(renderer_.error_of(scene_),
              "scene: mesh 0 (label 201): normal 7 is not of unit length");
  }
  MeshData data = make_sphere(0.05f);
  data.normals[7] = 1.005f * data.normals[7];
  scene_.meshes[0].mesh = std::make_shared<MeshData>(data);
  renderer_.draw(scene_, TestRenderer::straight_ahead());
}

TEST_F(BadScene, PlacesThatAreNotUniformAreRefused) {
  scene_.meshes[0].world_from_model[1].y = 2;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("mesh 0 (label 201) has a place that shears"));
  scene_ = good_scene();
  scene_.meshes[0].world_from_model[1].x = 0.1f;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("shears or scales unevenly"));
  scene_ = good_scene();
  scene_.meshes[0].world_from_model = placed_at({0, 0, -1}, 0.0015f);
  renderer_.draw(scene_, TestRenderer::straight_ahead());
}

TEST_F(BadScene, EndlessDashesAreRefused) {
  scene_.lines[0].points[1].x = 90000;
  scene_.lines[0].dash_m = 0.001f;
  EXPECT_THAT(renderer_.error_of(scene_), HasSubstr("more than 20000 dashes"));
}

TEST_F(BadScene, EmptyItemsDrawNothing) {
  scene_ = {};
  scene_.lines.push_back({});
  scene_.lines.push_back({});
  scene_.lines[1].dash_m = 0.01f;
  scene_.texts.push_back({});
  MeshItem mesh;
  mesh.mesh = std::make_shared<MeshData>();
  scene_.meshes.push_back(mesh);
  const RgbaImage image = renderer_.draw(scene_, TestRenderer::straight_ahead());
  EXPECT_EQ(image, renderer_.draw({}, TestRenderer::straight_ahead()));
}

TEST_F(BadScene, ViewsAreChecked) {
  View view = TestRenderer::straight_ahead();
  view.eye_from_world[0].x = 2;
  EXPECT_THAT(renderer_.error_of(scene_, view), HasSubstr("view 0: eye_from_world is not a rigid"));
  view = TestRenderer::straight_ahead();
  view.eye_from_world[0].x = -1;
  EXPECT_THAT(renderer_.error_of(scene_, view), HasSubstr("not a rigid"));
  view = TestRenderer::straight_ahead();
  view.tan_up = 0;
  EXPECT_THAT(renderer_.error_of(scene_, view), HasSubstr("tangent"));
  std::vector<RgbaImage> images;
  EXPECT_EQ(test::error_of(renderer_->draw(scene_, {}, {}, images)), "views: 0, expected 1 or 2");
  EXPECT_EQ(test::error_of(renderer_->draw(scene_, std::vector<View>(3), {}, images)),
            "views: 3, expected 1 or 2");
}

TEST_F(BadScene, BackgroundsOfTheWrongSizeAreRefused) {
  RgbaImage background{100, 120, std::vector<std::uint8_t>(4 * 100 * 120)};
  std::vector<RgbaImage> images;
  const std::vector<View> views = {TestRenderer::straight_ahead()};
  const auto error_with = [&](const std::vector<const RgbaImage*>& backgrounds) {
    return test::error_of(renderer_->draw(scene_, views, backgrounds, images));
  };
  EXPECT_THAT(error_with({&background}), HasSubstr("background 0: 100x120 px"));
  EXPECT_THAT(error_with({&background}), HasSubstr("expected 200x120 px"));
  EXPECT_EQ(error_with({nullptr}), "background 0 is missing");
  EXPECT_EQ(error_with({&background, &background}), "backgrounds: 2 for 1 views");
}

TEST(BadOptions, AreOneLineEach) {
  RendererOptions options;
  options.width_px = 0;
  EXPECT_EQ(test::error_of(Renderer::create(options)),
            "renderer: image side 0 px, expected 16 to 8192");
  options = {};
}

TEST(BadOptions, UnknownDeviceListsWhatThereIs) {
  RendererOptions options;
  options.device = "no such card";
  const auto renderer = Renderer::create(options);
  ASSERT_FALSE(renderer.ok());
  EXPECT_THAT(renderer.error().message,
              HasSubstr("no usable Vulkan device named 'no such card'; there is: "));
  EXPECT_THAT(renderer.error().message, HasSubstr(test::test_device()));
  EXPECT_EQ(renderer.error().code, ErrorCode::kNotFound);
}

TEST(Devices, AreListedWithTheOneThatTestsDrawOn) {
  const std::vector<DeviceInfo> devices = list_devices();
  ASSERT_FALSE(devices.empty());
  EXPECT_TRUE(std::any_of(devices.begin(), devices.end(), [](const DeviceInfo& device) {
    return device.usable && device.name.find(test::test_device()) != std::string::npos &&
           device.reason.empty();
  }));
}

// In a process of its own, since the loader reads its environment once.
TEST(NoDeviceDeathTest, IsOneLine) {
  EXPECT_EXIT(
      {
        for (const char* name : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) {
          setenv(name, "/none.json", 1);
        }
        const auto renderer = Renderer::create({});
        std::fprintf(stderr, "%s|%zu\n", test::error_of(renderer).c_str(), list_devices().size());
        std::_Exit(renderer ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "renderer: .*no Vulkan (driver|device).*\\|0");
}

}  // namespace
}  // namespace orthonav::render
