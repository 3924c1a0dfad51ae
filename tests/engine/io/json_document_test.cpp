#include "engine/io/json_document.h"

#include <gmock/gmock.h>

namespace orthonav::engine {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(JsonNode, NamesItsKeysAlsoThoseWithoutAValue) {
  const auto document = JsonDocument::parse(R"({"b": {"z": 1, "a": null}, "a": [1]})", "x.json");
  ASSERT_TRUE(document.ok()) << document.error().message;
  EXPECT_THAT(document->root().keys(), ElementsAre("a", "b"));
  EXPECT_THAT(document->root().child("b").keys(), ElementsAre("a", "z"));
}

TEST(JsonNode, HasNoKeysWhereItIsNoObject) {
  const auto document = JsonDocument::parse(R"({"a": [1]})", "x.json");
  ASSERT_TRUE(document.ok()) << document.error().message;
  EXPECT_THAT(document->root().child("a").keys(), IsEmpty());
  EXPECT_EQ(document->status().error().message, "x.json: a must be an object, is array");
}

}  // namespace
}  // namespace orthonav::engine
