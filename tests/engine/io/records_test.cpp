#include "engine/io/records.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/io/crc32c.h"
#include "tests/support/is_ok.h"

namespace orthonav::engine {
namespace {

using orthonav::test::is_ok;
using ::testing::HasSubstr;

std::vector<Record> three_records() {
  return {{1, 7, 1, "first"}, {2, 7, 2, ""}, {3, 8, 1, std::string(700, '\xa5')}};
}

std::string written(const std::vector<Record>& records) {
  std::string bytes(kRecordsBegin);
  std::uint32_t check = kFirstCheck;
  for (const Record& record : records) {
    check = append_record(bytes, record, check);
  }
  return bytes;
}

TEST(Crc32c, IsThatOfTheStandard) {
  // RFC 3720, appendix B.4.
  EXPECT_EQ(crc32c(std::string(32, '\0')), 0x8a9136aau);
  EXPECT_EQ(crc32c(std::string(32, '\xff')), 0x62a8ab43u);
  EXPECT_EQ(crc32c("123456789"), 0xe3069283u);
  EXPECT_EQ(crc32c("6789", crc32c("12345")), 0xe3069283u);
}

TEST(Records, AreReadAsTheyWereWritten) {
  const std::string bytes = written(three_records());
  const auto read = read_records(bytes, "log");
  ASSERT_TRUE(is_ok(read));
  EXPECT_EQ(read->records, three_records());
  EXPECT_EQ(read->whole_bytes, bytes.size());
  EXPECT_EQ(read->dropped_bytes, 0u);
}

TEST(Records, AreAPrefixWhereverTheFileIsCut) {
  const std::string bytes = written(three_records());
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    const auto read = read_records(std::string_view(bytes).substr(0, size), "log");
    ASSERT_TRUE(is_ok(read)) << size;
    auto expected = three_records();
    expected.resize(read->records.size());
    EXPECT_EQ(read->records, expected);
    EXPECT_EQ(read->whole_bytes + read->dropped_bytes, size);
  }
}

TEST(Records, NoticeEveryChangedByte) {
  const std::string good = written(three_records());
  for (std::size_t at = kRecordsBegin.size(); at < good.size(); ++at) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x10);
    const auto read = read_records(bytes, "log");
    ASSERT_TRUE(is_ok(read));
    ASSERT_LT(read->records.size(), 3u) << "byte " << at;
    EXPECT_GT(read->dropped_bytes, 0u);
    auto expected = three_records();
    expected.resize(read->records.size());
    EXPECT_EQ(read->records, expected);
  }
}

TEST(Records, AreWholeOnlyAfterThoseBeforeThem) {
  auto other = three_records();
  other[0].payload = "FIRST";
  const std::string first = written({three_records()[0]});
  // The second record of another file, whole in itself, in the right place.
  const std::string mixed = first + written(other).substr(first.size());
  const auto read = read_records(mixed, "log");
  ASSERT_TRUE(is_ok(read));
  EXPECT_EQ(read->records.size(), 1u);
}

TEST(Records, AreNumberedWithoutAGap) {
  auto records = three_records();
  records[2].number = 4;
  EXPECT_EQ(read_records(written(records), "log")->records.size(), 2u);
}

TEST(Records, OfAnotherSortOfFileAreRefused) {
  const auto read = read_records("{\"format\": \"orthonav session\"}", "a.log");
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr("a.log: is not a file of records"));
  EXPECT_TRUE(read_records("", "a.log")->records.empty());
}

}  // namespace
}  // namespace orthonav::engine
