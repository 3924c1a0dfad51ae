#include "tools/orthonav/dashboard/web_access.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>

#include "tests/support/temporary_folder.h"

namespace orthonav::tools::dashboard_test {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

constexpr const char* kToken = "a-token_of-our_OWN";

std::string refusal(const std::string& at, const std::string& token_file = {}) {
  const auto access = WebAccess::of(at, token_file);
  return access ? "taken" : access.error().message;
}

/// A file that only its owner may read.
std::string own_file(const TemporaryFolder& folder, const std::string& text) {
  const std::string file = folder.with("token", text);
  std::filesystem::permissions(file, std::filesystem::perms(0600));
  return file;
}

TEST(WebAccessTest, IsThisMachinesAloneUnlessAnAddressIsNamed) {
  const auto access = WebAccess::of("8080", {});
  ASSERT_TRUE(access);
  EXPECT_EQ(access->host(), "127.0.0.1");
  EXPECT_EQ(access->port(), 8080);
  EXPECT_FALSE(access->asks_for_a_token());
  EXPECT_EQ(access->url(80), "http://127.0.0.1:80/");
  EXPECT_TRUE(access->lets_in("localhost:8080", ""));
  EXPECT_FALSE(access->lets_in("hospital.example:8080", ""));
  EXPECT_EQ(refusal("127.0.0.2:0"), "taken");
  const auto of_version_6 = WebAccess::of("[::1]:8080", {});
  ASSERT_TRUE(of_version_6);
  EXPECT_EQ(of_version_6->host(), "::1");
  EXPECT_TRUE(of_version_6->lets_in("[::1]:8080", "")) << "as a browser writes it";
}

TEST(WebAccessTest, RefusesOtherMachinesWithoutAToken) {
  for (const char* at : {"0.0.0.0:8080", "192.0.2.7:0"}) {
    EXPECT_EQ(refusal(at), std::string("--web \"") + at +
                               "\": other machines reach this address: needs --token FILE");
  }
}

TEST(WebAccessTest, RefusesWhatIsNoPort) {
  for (const char* at : {"", "x", "-1", "65536", "1.5", "127.0.0.1:", ":80", "127.0.0.1:80x",
                         "::1:80", "[::1]", "[::1]80", "8080:80", "127.0.0.1:80:81"}) {
    EXPECT_THAT(refusal(at), HasSubstr("must be PORT or ADDRESS:PORT")) << at;
  }
}

TEST(WebAccessTest, MakesATokenAtRandomThatItsOwnerAloneCanRead) {
  const TemporaryFolder folder;
  const std::string file = folder.file("token");
  const auto first = WebAccess::of("192.0.2.7:80", file);
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_THAT(first->url(80), MatchesRegex("http://192.0.2.7:80/.token=[0-9a-f]{32}"));
  EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0600));
  EXPECT_EQ(WebAccess::of("192.0.2.7:80", file)->url(80), first->url(80)) << "it is kept";
  EXPECT_NE(WebAccess::of("192.0.2.7:80", folder.file("other"))->url(80), first->url(80));
}

TEST(WebAccessTest, SendsABrowserToTheMachineByNameWhereEveryAddressIsServed) {
  const TemporaryFolder folder;
  const std::string file = own_file(folder, kToken);
  std::array<char, 256> name{};
  ASSERT_EQ(gethostname(name.data(), name.size()), 0);
  const std::string page = std::string("http://") + name.data() + ":80/?token=" + kToken;
  EXPECT_EQ(WebAccess::of("0.0.0.0:80", file)->url(80), page);
  EXPECT_EQ(WebAccess::of("[::]:80", file)->url(80), page);
  EXPECT_EQ(WebAccess::of("0.0.0.0:80", file)->host(), "0.0.0.0") << "where to listen";
  EXPECT_EQ(WebAccess::of("[::1]:80", {})->url(80), "http://[::1]:80/");
}

TEST(WebAccessTest, RefusesATokenFileThatOthersReadOrThatHoldsNone) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal("80", own_file(folder, "short")), HasSubstr("must hold 16 to 128"));
  EXPECT_THAT(refusal("80", own_file(folder, std::string(129, 'a'))), HasSubstr("16 to 128"));
  EXPECT_THAT(refusal("80", own_file(folder, "sixteen letters; and")), HasSubstr("16 to 128"));
  EXPECT_THAT(refusal("80", folder.path()), HasSubstr("is not a regular file"));
  EXPECT_THAT(refusal("80", folder.file("no/token")), HasSubstr("cannot be made"));
  const std::string file = own_file(folder, kToken);
  EXPECT_EQ(refusal("80", file), "taken");
  std::filesystem::permissions(file, std::filesystem::perms(0640));
  EXPECT_THAT(refusal("80", file), HasSubstr("others may read or write it"));
}

TEST(WebAccessTest, KnowsItsTokenAmongCookies) {
  const TemporaryFolder folder;
  const auto access = WebAccess::of("0.0.0.0:80", own_file(folder, std::string(kToken) + "\n"));
  ASSERT_TRUE(access);
  const std::string own = std::string("orthonav_token=") + kToken;
  EXPECT_TRUE(access->is_token(kToken));
  EXPECT_FALSE(access->is_token(""));
  EXPECT_TRUE(access->lets_in("any", own));
  EXPECT_TRUE(access->lets_in("any", "a=b;  " + own + "; c"));
  for (const std::string& cookies :
       {std::string(), std::string(";;"), own + "x", "x" + own, own.substr(0, own.size() - 1)}) {
    EXPECT_FALSE(access->lets_in("localhost", cookies)) << cookies;
  }
}

}  // namespace
}  // namespace orthonav::tools::dashboard_test
