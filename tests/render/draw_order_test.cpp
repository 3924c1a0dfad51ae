#include "render/frame/draw_order.h"

#include <gmock/gmock.h>

#include <memory>

#include "render/shapes.h"

namespace orthonav::render {
namespace {

using ::testing::ElementsAre;
using Order = std::vector<std::uint32_t>;

template <class Item>
Order order_of(const std::vector<Item>& items, const Head& head = {}) {
  Order order;
  if constexpr (std::is_same_v<Item, MeshItem>) {
    sort_for_drawing(
        items, head, [](const MeshItem& item) { return box_of(*item.mesh); }, order);
  } else {
    sort_for_drawing(items, head, order);
  }
  return order;
}

TextItem text_at(Float3 position, TextPlace place) {
  TextItem item;
  item.position = position;
  item.place = place;
  return item;
}

TEST(DrawOrder, MeasuresTextsOfTheViewFromTheEyes) {
  Head head;
  head.position = {5, 0, 0};
  const TextItem world = text_at({5, 0, -2}, TextPlace::kWorld);
  EXPECT_THAT(order_of(std::vector{text_at({0, 0, -0.5f}, TextPlace::kView), world}, head),
              ElementsAre(1, 0));
  EXPECT_THAT(order_of(std::vector{text_at({0, 0, -3}, TextPlace::kView), world}, head),
              ElementsAre(0, 1))
      << "the twin";
}

/// Two meshes of which only the second one's content differs, in either order of submission.
void expect_order_by_content(const MeshData& a, const MeshData& b) {
  MeshItem first;
  first.mesh = std::make_shared<const MeshData>(a);
  MeshItem second;
  second.mesh = std::make_shared<const MeshData>(b);
  const Order forward = order_of(std::vector{first, second});
  const Order backward = order_of(std::vector{second, first});
  EXPECT_EQ(forward[0], backward[1]) << "the same mesh is drawn first";
}

TEST(DrawOrder, TellsMeshesApartByNormalsAndIndicesToo) {
  const MeshData sphere = make_sphere(0.05f);
  MeshData other = sphere;
  other.normals[40] = {0, 1, 0};
  expect_order_by_content(sphere, other);
  other = sphere;
  std::swap(other.indices[0], other.indices[1]);
  expect_order_by_content(sphere, other);
}

TEST(DrawOrder, GoesByWhereMeshesAreAndNotByTheirOrigins) {
  // Both are modelled in the world: their origins are one.
  const auto sphere_at = [](float z_m) {
    MeshData sphere = make_sphere(0.05f);
    for (Float3& p : sphere.positions) {
      p.z += z_m;
    }
    MeshItem item;
    item.mesh = std::make_shared<const MeshData>(std::move(sphere));
    return item;
  };
  MeshItem far = sphere_at(-2);
  far.label = 2;
  MeshItem near = sphere_at(-1);
  near.label = 1;
  EXPECT_THAT(order_of(std::vector{near, far}), ElementsAre(1, 0));
  EXPECT_THAT(order_of(std::vector{far, near}), ElementsAre(0, 1));
}

}  // namespace
}  // namespace orthonav::render
