#include "hal/net/allowed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orthonav::net {
namespace {

using ::testing::HasSubstr;

Endpoint at(const std::string& number) {
  const auto endpoint = resolve(number);
  EXPECT_TRUE(endpoint.ok()) << number;
  return *endpoint;
}

Allowed allowed(const std::string& networks) {
  const auto made = Allowed::of(networks);
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
  return *made;
}

TEST(Allowed, IsThisMachineAloneUnlessOthersAreNamed) {
  for (const char* here : {"127.0.0.1", "127.3.2.1", "::1", "::ffff:127.0.0.1"}) {
    EXPECT_TRUE(Allowed().contains(at(here))) << here;
    EXPECT_FALSE(Allowed::nobody().contains(at(here))) << here;
  }
  for (const char* there : {"192.168.1.7", "0.0.0.0", "128.0.0.1", "::2", "::"}) {
    EXPECT_FALSE(Allowed().contains(at(there))) << there;
  }
}

TEST(Allowed, EndsToTheBit) {
  const Allowed odd = allowed("192.168.4.0/22,10.0.0.7");
  EXPECT_TRUE(odd.contains(at("192.168.4.0")));
  EXPECT_TRUE(odd.contains(at("192.168.7.255")));
  EXPECT_FALSE(odd.contains(at("192.168.8.0")));
  EXPECT_FALSE(odd.contains(at("192.168.3.255")));
  EXPECT_TRUE(odd.contains(at("10.0.0.7")));
  EXPECT_FALSE(odd.contains(at("10.0.0.6")));
  EXPECT_TRUE(odd.contains(at("::ffff:10.0.0.7"))) << "the same, as an IPv6 socket sees it";
  const Allowed six = allowed("fe80::/10");
  EXPECT_TRUE(six.contains(at("febf::1")));
  EXPECT_FALSE(six.contains(at("fec0::1")));
  EXPECT_FALSE(six.contains(at("192.168.4.1")));
}

TEST(Allowed, RefusesWhatIsNoNetworkAndWhatIsEverybody) {
  for (const char* text : {"0.0.0.0/0", "::/0", "10.0.0.0/7", "10.0.0.0/33", "::1/129", "1.2.3",
                           "1.2.3.4/", "1.2.3.4/8x", "host", "10.0.0.7,,10.0.0.8", " 10.0.0.7"}) {
    const auto made = Allowed::of(text);
    ASSERT_FALSE(made.ok()) << text;
    EXPECT_THAT(made.error().message, HasSubstr("network"));
  }
  EXPECT_TRUE(Allowed::of("10.0.0.0/8").ok());
}

TEST(Listening, BeyondThisMachineNeedsToSayForWhom) {
  EXPECT_TRUE(check_who_may("localhost", at("127.0.0.1"), Allowed()).ok());
  for (const char* open : {"0.0.0.0", "::", "192.168.1.20"}) {
    const Status named = check_who_may(open, at(open), Allowed());
    ASSERT_FALSE(named.ok());
    EXPECT_THAT(named.error().message, HasSubstr(open + std::string("; name who may connect")));
    EXPECT_TRUE(check_who_may(open, at(open), allowed("192.168.1.0/24")).ok());
  }
}

}  // namespace
}  // namespace orthonav::net
