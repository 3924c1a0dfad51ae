#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "nav/tracking/tool.h"

namespace orthonav::nav {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

ToolGeometry tool(const std::string& name, int id) {
  ToolGeometry made{name, ToolRole::kPointer, {"tag36h11", id, 0.05}, {}, {}, {}};
  made.tip_in_marker = {{0, -0.15, 0}};
  made.axis_in_marker = {{0, 1, 0}};
  return made;
}

TEST(ProblemsOfTools, NoneForGoodTools) {
  EXPECT_THAT(problems_of({tool("pointer", 3), tool("guide", 5)}), IsEmpty());
}

TEST(ProblemsOfTools, ReportsEveryOneAtOnce) {
  ToolGeometry bad = tool("", -1);
  bad.marker.family = "tag99h1";
  bad.marker.size_m = 0.3;
  bad.tip_in_marker = {{0, -1.5, 0}};
  bad.axis_in_marker = {{0, 1.1, 0}};
  EXPECT_THAT(problems_of({bad}),
              AllOf(SizeIs(6), Contains(HasSubstr("name is empty")),
                    Contains(HasSubstr("unknown tag family 'tag99h1'")),
                    Contains(HasSubstr("id -1")), Contains(HasSubstr("300 mm, must be 5-200 mm")),
                    Contains(HasSubstr("1500 mm from its marker, limit 1000 mm")),
                    Contains(HasSubstr("axis has length 1.1"))));
}

TEST(ProblemsOfTools, FindsDuplicates) {
  EXPECT_THAT(problems_of({tool("pointer", 3), tool("guide", 3)}),
              ElementsAre(HasSubstr("id 3 is already on tool 'pointer'")));
  EXPECT_THAT(problems_of({tool("pointer", 3), tool("pointer", 5)}),
              ElementsAre(HasSubstr("name is given twice")));
}

AttachedMarker attached(int id, Vec3 place_m) {
  return {{"tag36h11", id, 0.04}, {rotation_from_vector({0, 1.2, 0}), place_m}};
}

TEST(ProblemsOfTools, ChecksFurtherTagsLikeTheFirst) {
  ToolGeometry body = tool("pointer", 3);
  body.more_markers = {attached(4, {0.03, 0, -0.03}), attached(6, {-0.03, 0, -0.03})};
  EXPECT_THAT(problems_of({body, tool("guide", 5)}), IsEmpty());
  body.more_markers[0].definition = {"tag99h1", 4, 0.3};
  body.more_markers[1].marker_from_tag = {Mat3::identity(), {0, 1.2, 0}};
  EXPECT_THAT(problems_of({body}),
              AllOf(SizeIs(3), Contains(HasSubstr("unknown tag family 'tag99h1'")),
                    Contains(HasSubstr("300 mm, must be 5-200 mm")),
                    Contains(HasSubstr("tag id 6 lies 1200 mm from its marker, limit 1000 mm"))));
}

TEST(ProblemsOfTools, FindsATagThatIsOnTwoPlaces) {
  ToolGeometry body = tool("pointer", 3);
  body.more_markers = {attached(4, {0.03, 0, -0.03}), attached(3, {-0.03, 0, -0.03})};
  EXPECT_THAT(problems_of({body}), ElementsAre(HasSubstr("id 3 is already on tool 'pointer'")));
  body.more_markers[1].definition.id = 5;
  EXPECT_THAT(
      problems_of({body, tool("guide", 5)}),
      ElementsAre(HasSubstr("tool 'guide': tag tag36h11 id 5 is already on tool 'pointer'")));
  body.more_markers[1].definition.family = "tag36h10";
  EXPECT_THAT(problems_of({body, tool("guide", 5)}), IsEmpty()) << "another family's id 5";
}

TEST(ProblemsOfTools, FindsIdsThatTheFamilyDoesNotHave) {
  EXPECT_THAT(problems_of({tool("pointer", 586)}), IsEmpty());
  EXPECT_THAT(problems_of({tool("pointer", 587)}), ElementsAre(HasSubstr("0-586")));
}

TEST(ProblemsOfTools, FindsNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ToolGeometry bad = tool("pointer", 3);
  bad.marker.size_m = nan;
  bad.tip_in_marker = {{0, nan, 0}};
  bad.axis_in_marker = {{nan, 0, 0}};
  EXPECT_THAT(problems_of({bad}), SizeIs(3));
}

TEST(ProblemsOfTools, SizeLimitsAreInclusive) {
  ToolGeometry edge = tool("pointer", 3);
  for (const double size_m : {0.005, 0.2}) {
    edge.marker.size_m = size_m;
    EXPECT_THAT(problems_of({edge}), IsEmpty());
  }
  for (const double size_m : {0.00499, 0.2001}) {
    edge.marker.size_m = size_m;
    EXPECT_THAT(problems_of({edge}), SizeIs(1));
  }
}

TEST(ProblemsOfTools, NoToolsIsAProblem) { EXPECT_THAT(problems_of({}), SizeIs(1)); }

}  // namespace
}  // namespace orthonav::nav
