#include "render/item_list.h"

#include <gtest/gtest.h>

#include "render/scene.h"

namespace orthonav::render {
namespace {

LineItem line(Label label, std::size_t points) {
  LineItem item;
  item.label = label;
  item.points.resize(points);
  item.closed = true;
  return item;
}

TEST(ItemList, ItemsThatComeAgainAreAsNewButForTheirMemory) {
  ItemList<LineItem> list;
  list.push_back(line(1, 50));
  list.clear();
  EXPECT_TRUE(list.empty());
  const LineItem& again = list.emplace_back();
  EXPECT_EQ(again.label, 0u);
  EXPECT_FALSE(again.closed);
  EXPECT_TRUE(again.points.empty());
  EXPECT_GE(again.points.capacity(), 50u);
}

TEST(ItemList, LetsGoOfWhatIsSharedAtOnce) {
  const auto mesh = std::make_shared<const MeshData>();
  ItemList<MeshItem> list;
  list.emplace_back().mesh = mesh;
  list.clear();
  EXPECT_EQ(mesh.use_count(), 1);
}

TEST(ItemList, KeepsTheOrderOfWhatStays) {
  ItemList<LineItem> list = {line(1, 1), line(2, 2), line(3, 3), line(4, 4)};
  list.erase_if([](const LineItem& item) { return item.label % 2 == 1; });
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].label, 2u);
  EXPECT_EQ(list[1].label, 4u);
  EXPECT_EQ(list[1].points.size(), 4u);
  list.pop_back();
  EXPECT_EQ(list.back().label, 2u);
}

TEST(ItemList, CopiesAndComparesItsItemsAlone) {
  ItemList<LineItem> list = {line(1, 1), line(2, 2)};
  list.pop_back();
  const ItemList<LineItem> copy = list;
  EXPECT_EQ(copy.size(), 1u);
  ItemList<LineItem> other = {line(3, 3), line(4, 4)};
  other = copy;
  ASSERT_EQ(other.size(), 1u);
  EXPECT_EQ(other[0].label, 1u);
  ItemList<LineItem> moved = std::move(other);
  EXPECT_EQ(moved.size(), 1u);
  EXPECT_THROW((void)moved.at(1), std::out_of_range);
}

TEST(ItemList, TakesOneOfItsOwn) {
  ItemList<TextRun> list = {{"a text that is too long for a string's own room", {}}};
  for (int i = 0; i < 9; ++i) {
    list.push_back(list[0]);
  }
  for (const TextRun& run : list) {
    EXPECT_EQ(run.text, list[0].text);
  }
  EXPECT_EQ(list.size(), 10u);
}

}  // namespace
}  // namespace orthonav::render
