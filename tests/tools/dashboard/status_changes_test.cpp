#include "tools/orthonav/dashboard/status_changes.h"

#include <gtest/gtest.h>

#include "engine/session/text/messages.h"

namespace orthonav::tools::status_changes_test {
namespace {

const engine::Message kDelete = engine::NothingToDelete{engine::NothingToDelete::What::kRegion};
const engine::Message kUnclear = engine::NotUnderstood{};

struct StatusChangesTest : ::testing::Test {
  StatusChanges changes;
  engine::StatusLine line;
  Timestamp time{};

  /// What is told of a pair with this message; null: none.
  std::string told(const engine::Message* message) {
    line.message = message;
    time += from_seconds(1.0 / 30.0);
    changes.look(time, line);
    return changes.new_message();
  }
};

TEST_F(StatusChangesTest, TellAMessageOnceThoughItComesBack) {
  EXPECT_NE(told(&kDelete), "");
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(told(&kDelete), "");
    EXPECT_EQ(told(nullptr), "");
    EXPECT_EQ(told(&kDelete), "");
    EXPECT_EQ(changes.untold(), 0);
  }
  const std::string other = told(&kUnclear);
  EXPECT_NE(other, "");
  EXPECT_EQ(changes.untold(), 7) << "then how often it came back";
  EXPECT_EQ(told(&kUnclear), "");
  EXPECT_EQ(changes.untold(), 0);
  EXPECT_NE(told(&kDelete), other) << "after another one it is news";
}

TEST_F(StatusChangesTest, TellAMessageAnewInTheNextStep) {
  EXPECT_NE(told(&kDelete), "");
  told(nullptr);
  told(&kDelete);
  told(nullptr);
  line.at.step = engine::Step::kDigitize;
  EXPECT_NE(told(&kDelete), "");
  EXPECT_NE(changes.new_step(), "");
  EXPECT_EQ(changes.untold(), 1);
}

}  // namespace
}  // namespace orthonav::tools::status_changes_test
