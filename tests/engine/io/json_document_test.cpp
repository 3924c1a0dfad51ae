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

TEST(JsonNode, ReadsAListOfNumbersOfAnyLengthUpToALimit) {
  const auto document = JsonDocument::parse(R"({"a": [1, 2.5, -3], "none": []})", "x.json");
  EXPECT_EQ(document->root().number_list("a", 3), (std::vector<double>{1.0, 2.5, -3.0}));
  EXPECT_TRUE(document->root().number_list("none", 3).empty());
  EXPECT_TRUE(document->status().ok());
  for (const char* bad : {R"({"a": 1})", R"({"a": [1, "b"]})", R"({"a": [[1]]})", "{}",
                          R"({"a": [1, 2, 3, 4]})", R"({"a": [1e999]})"}) {
    const auto refused = JsonDocument::parse(bad, "x.json");
    if (refused) {
      EXPECT_TRUE(refused->root().number_list("a", 3).empty()) << bad;
      EXPECT_FALSE(refused->status().ok()) << bad;
    }
  }
}

TEST(JsonNode, HasNoKeysWhereItIsNoObject) {
  const auto document = JsonDocument::parse(R"({"a": [1]})", "x.json");
  ASSERT_TRUE(document.ok()) << document.error().message;
  EXPECT_THAT(document->root().child("a").keys(), IsEmpty());
  EXPECT_EQ(document->status().error().message, "x.json: a must be an object, is array");
}

}  // namespace
}  // namespace orthonav::engine
