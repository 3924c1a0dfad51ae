#include "hal/net/host_port.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace orthonav::net {
namespace {

using ::testing::HasSubstr;

TEST(HostPort, IsTakenAsItIsWritten) {
  struct Spelling {
    const char* text;
    const char* host;
    std::optional<int> port;
  };
  for (const Spelling& each :
       {Spelling{"10.0.0.5", "10.0.0.5", {}}, Spelling{"10.0.0.5:18944", "10.0.0.5", 18944},
        Spelling{"tracker", "tracker", {}},
        Spelling{"tracker-2.or_3.example:1", "tracker-2.or_3.example", 1},
        Spelling{"localhost:65535", "localhost", 65535}, Spelling{"[::1]", "::1", {}},
        Spelling{"[::1]:7", "::1", 7}, Spelling{"[::]:8080", "::", 8080},
        Spelling{"[fe80::1%eth0]:7", "fe80::1%eth0", 7},
        Spelling{"[::ffff:10.0.0.5]:7", "::ffff:10.0.0.5", 7}}) {
    const auto taken = host_and_port(each.text);
    ASSERT_TRUE(taken.ok()) << taken.error().message;
    EXPECT_EQ(taken->host, each.host);
    EXPECT_EQ(taken->port, each.port) << each.text;
  }
}

TEST(HostPort, IsRefusedByWhatIsWrongWithIt) {
  for (const auto& [text, why] : std::to_array<std::pair<const char*, const char*>>(
           {{"", "names no host"},
            {":18944", "names no host"},
            {"10.0.0.5:", "port \"\" must be a whole number from 1 to 65535"},
            {"10.0.0.5:0", "port \"0\" must be"},
            {"10.0.0.5:65536", "port \"65536\" must be"},
            {"10.0.0.5:-1", "port \"-1\" must be"},
            {"10.0.0.5:+1", "port \"+1\" must be"},
            {"10.0.0.5:1x", "port \"1x\" must be"},
            {"10.0.0.5: 1", "port \" 1\" must be"},
            {"10.0.0.5:99999999999", "port \"99999999999\" must be"},
            {"10.0.0.5:1:2", "several colons"},
            {"::1", "written in brackets"},
            {"::1:18944", "written in brackets"},
            {"fe80::1", "written in brackets"},
            {"[::1", "in brackets, as in [::1]"},
            {"[]:1", "in brackets, as in [::1]"},
            {"[10.0.0.5]:1", "in brackets, as in [::1]"},
            {"[tracker]", "in brackets, as in [::1]"},
            {"[::1]18944", "must be a colon and a port"},
            {"[::1]:", "port \"\" must be"},
            {"[::1]:x", "port \"x\" must be"},
            {"18944", "must be a name, or four numbers"},
            {"10.0.0", "must be a name, or four numbers"},
            {"10.0.0.256", "must be a name, or four numbers"},
            {"1.2.3.4.5:1", "must be a name, or four numbers"},
            {"0x7f000001", "must be a name, or four numbers"},
            {"10.0.0.5/24", "must be a name or an address"},
            {"user@host", "must be a name or an address"},
            {"a host", "must be a name or an address"},
            {"host]:1", "must be a name or an address"}})) {
    const auto taken = host_and_port(text);
    ASSERT_FALSE(taken.ok()) << text;
    EXPECT_THAT(taken.error().message, HasSubstr(why)) << text;
  }
}

TEST(HostPort, MayBeAnyFreePortWhereOneListens) {
  EXPECT_EQ(host_and_port("127.0.0.1:0", 0)->port, 0);
  EXPECT_FALSE(host_and_port("127.0.0.1:-1", 0).ok());
}

TEST(HostPort, IsWrittenAsItIsRead) {
  for (const char* text : {"10.0.0.5", "tracker", "[::1]"}) {
    EXPECT_EQ(before_port(host_and_port(text)->host), text);
  }
}

}  // namespace
}  // namespace orthonav::net
