#include <gmock/gmock.h>

#include "engine/session/journal_reader.h"

namespace orthonav::engine::journal_reader_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The first of the three lines of a short journal.
std::string header() {
  return R"({"format":"orthonav session","format_version":1,"orthonav":"0.1.0","device":"d",)"
         R"("method":"best","case":"c","seed":1})"
         "\n";
}
std::string started() {
  return R"({"time_100ns":1,"time_ns":100000000000,"what":"event","step":"setup",)"
         R"("event":"\"start\"","action":"begin level","next":"digitize"})"
         "\n";
}
std::string registered() {
  return R"({"time_100ns":1,"time_ns":101000000000,"what":"registration","level":"L4","attempt":1,)"
         R"("accepted":true,"points":100,"rmse_mm":1.5,"predicted_tre_mm":null})"
         "\n";
}

TEST(JournalReader, LeavesOutALineThatWasTorn) {
  const std::string whole = header() + started() + registered();
  for (std::size_t length = header().size(); length < whole.size(); ++length) {
    const auto read = read_journal_text(whole.substr(0, length), "cut");
    ASSERT_TRUE(read.ok()) << length << ": " << read.error().message;
    EXPECT_TRUE(read->cut);
    const std::size_t behind_start = header().size() + started().size();
    // A line counts if it is complete, with or without its newline.
    EXPECT_EQ(read->steps.size(), length + 1 >= behind_start ? 1U : 0U) << length;
    EXPECT_EQ(read->registrations.size(), length + 1 == whole.size() ? 1U : 0U) << length;
    const bool between = length == header().size() || length + 1 == behind_start ||
                         length == behind_start || length + 1 == whole.size();
    EXPECT_EQ(read->last_line_torn, !between) << length;
  }
  const auto zeros = read_journal_text(header() + started() + std::string(100, '\0'), "cut");
  ASSERT_TRUE(zeros.ok()) << zeros.error().message;
  EXPECT_TRUE(zeros->last_line_torn);
  EXPECT_EQ(zeros->lines, 2U);
}

TEST(JournalReader, DoesNotInventWhatIsNotThere) {
  const auto read = read_journal_text(header() + started() + registered(), "j");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_FALSE(read->has_plan);
  EXPECT_FALSE(read->registrations[0].predicted_tre_m) << "null: without a bound";
  EXPECT_FALSE(read->registrations[0].tre_95_m);
  EXPECT_FALSE(read->levels[0].digitization_s) << "no press was recorded";
  EXPECT_TRUE(read->levels[0].screws.empty());
}

struct Hostile {
  const char* name;
  std::string content;
  const char* refusal;
};
void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.name; }

std::string line_with(const std::string& what) {
  return header() + R"({"time_ns":100000000000,"what":)" + what + "}\n" + started();
}

class HostileJournal : public ::testing::TestWithParam<Hostile> {};

TEST_P(HostileJournal, IsRefusedInOneLineThatNamesFileAndLine) {
  const auto read = read_journal_text(GetParam().content, "bad");
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr(GetParam().refusal));
  EXPECT_THAT(read.error().message, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(
    Every, HostileJournal,
    ::testing::Values(
        Hostile{"Empty", "", "bad: is empty"}, Hostile{"Zeros", std::string(9, '\0'), "is empty"},
        Hostile{"Binary", "\x89PNG\r\n\x1a\n", "bad:1: is not JSON"},
        Hostile{"TornHeader", header().substr(0, 40), "bad:1: is not JSON"},
        Hostile{"AnotherFormat", "{\"format\":\"x\"}\n",
                "bad:1: format is not \"orthonav session\""},
        Hostile{"ALaterVersion", R"({"format":"orthonav session","format_version":2})",
                "bad:1: format_version is 2, known is 1"},
        Hostile{"NoJson", line_with("\"ended\"").insert(header().size(), "x"),
                "bad:2: is not JSON"},
        Hostile{"AList", header() + "[]\n" + started(), "bad:2: must hold a JSON object"},
        Hostile{"TwoHeaders", header() + header(), "bad:2: time_ns is missing"},
        Hostile{"UnknownWord", line_with("\"dance\""), "bad:2: what \"dance\" is unknown"},
        Hostile{"NoWord", line_with("7"), "bad:2: what must be text, is number"},
        Hostile{
            "UnknownStep",
            line_with(R"("event","step":"fly","event":"press","action":"ignore","next":"done")"),
            "bad:2: step \"fly\" is unknown"},
        Hostile{"WrongType", line_with(R"("registration","level":"L4","attempt":"two")"),
                "bad:2: attempt must be a number, is string"},
        Hostile{"Infinite", line_with(R"("registration","level":"L4","attempt":1,"rmse_mm":1e999)"),
                "bad:2: holds a number that is too large"},
        Hostile{"NotANumber", line_with(R"("registration","level":"L4","attempt":1,"rmse_mm":NaN)"),
                "bad:2: is not JSON"},
        Hostile{"NegativeCount", line_with(R"("rod","side":"left","heads":-1)"),
                "bad:2: heads is negative"},
        Hostile{"NoSide", line_with(R"("head","side":"up")"), "bad:2: side is \"up\""},
        Hostile{"NothingToAccept", line_with(R"("accepted","level":"L4")"),
                "bad:2: level has no registration that could be accepted"},
        Hostile{"NothingToDrop", line_with(R"("check point dropped","level":"L4")"),
                "bad:2: level has no check point"},
        Hostile{"LongLine", header() + std::string(2'000'000, ' ') + "{}\n" + started(),
                "bad:2: 2000002 bytes long, limit 1048576"},
        Hostile{"TimeGoesBack",
                header() + started() + "{\"time_ns\":39000000000,\"what\":\"ended\"}\n",
                "bad:3: time_ns goes back by 61.0 s, limit 60 s"},
        Hostile{"NoTime", header() + "{\"time_ns\":1e300,\"what\":\"ended\"}\n",
                "bad:2: time_ns is not a time"},
        Hostile{"AfterTheEnd", line_with("\"ended\""), "bad:3: stands after the end"}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(JournalReader, TakesNoMoreLevelsThanASpineCanHave) {
  std::string many = header();
  for (int i = 0; i < 101; ++i) {
    many += R"({"time_ns":1,"what":"screw","side":"left","level":")" + std::to_string(i) + "\"}\n";
  }
  const auto read = read_journal_text(many, "bad");
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr("bad:102: level is the 101st, limit 100"));
}

}  // namespace
}  // namespace orthonav::engine::journal_reader_test
