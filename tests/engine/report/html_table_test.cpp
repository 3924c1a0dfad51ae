#include "engine/report/html_table.h"

#include <gmock/gmock.h>

namespace orthonav::engine::html_table_test {
namespace {

TEST(HtmlTable, NamesEachCellsColumnAndEscapesTheNames) {
  HtmlTable table({{"<screw>"}, {"error \"e\"", "mm"}, {"why", "", true}});
  EXPECT_TRUE(table.empty());
  table.row("L4");
  table.cell("1.0", "bad");
  table.cell("too far");
  table.below("more", "bad");
  EXPECT_FALSE(table.empty());
  EXPECT_EQ(table.html(),
            "<table class=\"cards\"><thead><tr><th scope=col>&lt;screw&gt;</th>"
            "<th scope=col>error &quot;e&quot; <small>mm</small></th>"
            "<th scope=col class=text>why</th></tr></thead><tbody><tr><th scope=row>L4</th>"
            "<td class=bad data-label=\"error &quot;e&quot; [mm]\">1.0</td>"
            "<td class=text data-label=\"why\">too far</td></tr>"
            "<tr class=below><td colspan=3 class=bad>more</td></tr></tbody></table>");
}

TEST(HtmlTableDeathTest, RefusesRowsOfAnotherLength) {
  HtmlTable table({{"a"}, {"b"}});
  table.row("1");
  EXPECT_DEATH(table.row("2"), "next_ == columns_.size");
  EXPECT_DEATH(static_cast<void>(table.html()), "next_ == columns_.size");
  table.cell("x");
  EXPECT_DEATH(table.cell("y"), "next_ < columns_.size");
}

}  // namespace
}  // namespace orthonav::engine::html_table_test
