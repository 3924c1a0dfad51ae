#include "hal/net/token.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/temporary_folder.h"

namespace orthonav::net {
namespace {

TEST(NetToken, IsItselfAloneAndNothingIfThereIsNone) {
  const test::TemporaryFolder folder;
  const std::string file = folder.with("token", "a-token_of-our_OWN\n");
  std::filesystem::permissions(file, std::filesystem::perms(0600));
  const auto token = Token::of(file);
  ASSERT_TRUE(token) << token.error().message;
  EXPECT_TRUE(token->is_asked_for());
  EXPECT_TRUE(token->is("a-token_of-our_OWN"));
  for (const char* other : {"a-token_of-our_OWn", "a-token_of-our_OW", "", "a-token_of-our_OWN "}) {
    EXPECT_FALSE(token->is(other)) << other;
  }
  EXPECT_FALSE(Token().is_asked_for());
  EXPECT_FALSE(Token().is(""));
}

TEST(NetToken, IsMadeOnceWhereThereIsNoFile) {
  const test::TemporaryFolder folder;
  const auto made = Token::of(folder.file("token"));
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->text().size(), 32u);
  const auto again = Token::of(folder.file("token"));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_TRUE(again->is(made->text()));
  EXPECT_FALSE(Token::of(folder.file("other")).value().is(made->text()));
}

}  // namespace
}  // namespace orthonav::net
