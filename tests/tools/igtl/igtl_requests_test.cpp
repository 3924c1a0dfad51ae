#include "tools/orthonav/igtl/igtl_requests.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/igtl/screw_plan.h"

namespace orthonav::tools::igtl_test {
namespace {

using ::testing::HasSubstr;

/// The reason why such a text is refused; empty: it is accepted.
std::string refusal(const std::string& device, const std::string& text) {
  const auto request = request_of(device, text);
  return request ? "" : request.error().message;
}

TEST(IgtlRequests, AreTheWordsThatOneWouldSay) {
  for (const char* said :
       {"start", "next", "move rod", "move cranial one", "screw six forty five"}) {
    const auto request = request_of("Command", said);
    ASSERT_TRUE(request.ok()) << request.error().message;
    EXPECT_EQ(request->text, said);
    EXPECT_FALSE(request->change);
  }
  EXPECT_THAT(refusal("Command", "begin"), HasSubstr("\"begin\" is not a command"));
  EXPECT_THAT(refusal("Command", ""), HasSubstr("is not a command"));
  EXPECT_THAT(refusal("Command", "next\n"), HasSubstr("one line"));
  EXPECT_THAT(refusal("Command", std::string(81, 'a')), HasSubstr("at most 80"));
  EXPECT_THAT(refusal("Command", "move up one"), HasSubstr("say cranial"));
}

TEST(IgtlRequests, AreAPlanOfTheScrewInWork) {
  const auto request = request_of("Plan", kScrew);
  ASSERT_TRUE(request.ok()) << request.error().message;
  EXPECT_EQ(request->text, "plan L4 left");
  ASSERT_TRUE(request->change);
  const auto& place = std::get<engine::PlaceScrew>(*request->change);
  EXPECT_EQ(place.level, "L4");
  EXPECT_EQ(place.side, nav::Side::kLeft);
  EXPECT_LT((place.entry.v - Vec3{0.015, 0.020, 0.004}).norm(), 1e-12) << "LPS, metres";
  EXPECT_LT((place.target.v - Vec3{0.015, -0.015, 0.004}).norm(), 1e-12);
  EXPECT_DOUBLE_EQ(place.radius_m, 0.003);
}

TEST(IgtlRequests, RefuseAPlanThatAFileMayNotBeAndMoreThanOneScrew) {
  const std::string plan = kScrew;
  const auto with = [&plan](const std::string& from, const std::string& to) {
    std::string changed = plan;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal("Plan", "no JSON"), HasSubstr("Plan: "));
  EXPECT_THAT(refusal("Plan", with("\"mm\"", "\"inch\"")), HasSubstr("must be mm or m"));
  EXPECT_THAT(refusal("Plan", with(R"("level": "L4", )", "")), HasSubstr("must name its level"));
  EXPECT_THAT(refusal("Plan", with("\"radius\": 3", "\"radius\": 9")), HasSubstr("radius"));
  EXPECT_THAT(refusal("Plan", with("\"radius\": 3", R"("radius": 3, "accept_breach": "mine")")),
              HasSubstr("accept_breach is not taken from outside"));
  const std::string second =
      R"(}, {"side": "right", "entry": [15, -20, 4], "target": [15, 15, 4], "radius": 3}]})";
  EXPECT_THAT(refusal("Plan", with("}]}", second)), HasSubstr("holds 2 screws, must be 1"));
}

}  // namespace
}  // namespace orthonav::tools::igtl_test
