#include "hal/igtl/message.h"

#include <gtest/gtest.h>
#include <igtlMessageHeader.h>
#include <igtlPointMessage.h>
#include <igtlPolyDataMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTransformMessage.h>

#include <algorithm>
#include <cstring>

#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace orthonav::igtl::message_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A message as Debian's library reads it; checks its checksum.
template <class Message>
typename Message::Pointer read_by_library(const Bytes& bytes) {
  const auto header = ::igtl::MessageHeader::New();
  header->InitPack();
  std::memcpy(header->GetPackPointer(), bytes.data(), kHeaderBytes);
  header->Unpack();
  typename Message::Pointer message = Message::New();
  message->SetMessageHeader(header);
  message->AllocatePack();
  EXPECT_EQ(bytes.size(), kHeaderBytes + static_cast<std::size_t>(message->GetPackBodySize()));
  std::memcpy(message->GetPackBodyPointer(), bytes.data() + kHeaderBytes,
              bytes.size() - kHeaderBytes);
  EXPECT_NE(message->Unpack(1) & ::igtl::MessageHeader::UNPACK_BODY, 0) << "checksum";
  return message;
}

Label label_of(::igtl::MessageBase& message) {
  unsigned int seconds = 0, fraction = 0;
  message.GetTimeStamp(&seconds, &fraction);
  return {message.GetDeviceName(), std::uint64_t{seconds} << 32u | fraction};
}

TransformValues values_of(::igtl::TransformMessage& message) {
  ::igtl::Matrix4x4 matrix;
  message.GetMatrix(matrix);
  TransformValues values{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      values[3 * column + row] = matrix[row][column];
    }
  }
  return values;
}

/// Whole messages from the library's own test data; skips where they are absent.
class SharedBytes : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) {
      GTEST_SKIP() << "needs shared/openigtlink";
    }
  }
  Bytes bytes(const std::string& name) const {
    const std::string text = orthonav::test::content_of(folder_ / name);
    return {text.begin(), text.end()};
  }
  std::filesystem::path folder_ = orthonav::test::test_data("openigtlink");
};

TEST_F(SharedBytes, TransformIsWrittenAlike) {
  const Bytes bytes = this->bytes("transform.bin");
  const auto message = read_by_library<::igtl::TransformMessage>(bytes);
  EXPECT_EQ(packed(label_of(*message), values_of(*message)), bytes);
  TransformValues other = values_of(*message);
  other[11] += 0.5F;
  EXPECT_NE(packed(label_of(*message), other), bytes) << "the control";
}

TEST_F(SharedBytes, StatusAndStringAreWrittenAlike) {
  const Bytes status = bytes("status.bin");
  const auto s = read_by_library<::igtl::StatusMessage>(status);
  EXPECT_EQ(packed(label_of(*s), {static_cast<std::uint16_t>(s->GetCode()), s->GetSubCode(),
                                  s->GetErrorName(), s->GetStatusString()}),
            status);
  const Bytes string = bytes("string.bin");
  const auto text = read_by_library<::igtl::StringMessage>(string);
  EXPECT_EQ(packed_text(label_of(*text), text->GetString()), string);
}

TEST_F(SharedBytes, PointsAreWrittenAlike) {
  const Bytes bytes = this->bytes("point.bin");
  const auto message = read_by_library<::igtl::PointMessage>(bytes);
  std::vector<PointValues> points;
  for (int i = 0; i < message->GetNumberOfPointElement(); ++i) {
    ::igtl::PointElement::Pointer element;
    message->GetPointElement(i, element);
    PointValues p;
    p.name = element->GetName();
    p.group = element->GetGroupName();
    element->GetRGBA(p.rgba.data());
    element->GetPosition(p.position_mm.data());
    p.radius_mm = element->GetRadius();
    p.owner = element->GetOwner();
    points.push_back(p);
  }
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(packed(label_of(*message), std::span<const PointValues>(points)), bytes);
}

TEST_F(SharedBytes, EveryHeaderIsReadWhateverItsVersion) {
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.path().extension() != ".bin") {
      continue;
    }
    const Bytes bytes = this->bytes(entry.path().filename().string());
    const auto header =
        parsed_header(std::span<const std::uint8_t, kHeaderBytes>(bytes.data(), kHeaderBytes));
    ASSERT_TRUE(header.ok()) << entry.path();
    const bool second = entry.path().filename().string().find("Format2") != std::string::npos;
    EXPECT_EQ(header->version, second ? 2 : 1) << entry.path();
    EXPECT_EQ(header->body_bytes, bytes.size() - kHeaderBytes) << entry.path();
  }
}

TEST(IgtlMessage, IsReadByDebiansLibraryAsItWasMeant) {
  const TransformValues values = {0, 1, 0, -1, 0, 0, 0, 0, 1, 10, -20, 30};
  const auto t = read_by_library<::igtl::TransformMessage>(
      packed({"PointerToReference", (7ULL << 32u) | 0x80000000u}, values));
  EXPECT_STREQ(t->GetDeviceName(), "PointerToReference");
  EXPECT_EQ(values_of(*t), values);
  EXPECT_EQ(label_of(*t).timestamp, (7ULL << 32u) | 0x80000000u);
  const std::vector<std::array<float, 3>> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const auto surface =
      read_by_library<::igtl::PolyDataMessage>(packed({"L4leftScrewModel", 0}, points, triangles));
  EXPECT_EQ(surface->GetPoints()->GetNumberOfPoints(), 3);
  ASSERT_EQ(surface->GetPolygons()->GetNumberOfCells(), 1u);
  igtlUint32 cell[3] = {};
  surface->GetPolygons()->GetCell(0, cell);
  EXPECT_EQ(cell[2], 2u);
}

TEST(IgtlMessage, CutsNamesAndTextsToWhatTheFieldsHold) {
  const auto t = read_by_library<::igtl::TransformMessage>(
      packed({"PointerTipToReferenceFrame", 0}, TransformValues{}));
  EXPECT_STREQ(t->GetDeviceName(), "PointerTipToReferenc") << "20 bytes";
  const auto s =
      read_by_library<::igtl::StringMessage>(packed_text({"Guidance", 0}, std::string(70000, 'x')));
  EXPECT_EQ(std::strlen(s->GetString()), 65535u);
}

TEST(IgtlMessage, RefusesHeadersOfAnythingElse) {
  Bytes bytes = packed_text({"Guidance", 0}, "text");
  const auto refused = [&] {
    return !parsed_header(std::span<const std::uint8_t, kHeaderBytes>(bytes.data(), kHeaderBytes))
                .ok();
  };
  EXPECT_FALSE(refused());
  bytes[1] = 3;
  EXPECT_FALSE(refused()) << "version 3";
  bytes[1] = 4;
  EXPECT_TRUE(refused());
  bytes[1] = 0;
  EXPECT_TRUE(refused());
  bytes[1] = 1;
  bytes[2] = 'g';
  EXPECT_TRUE(refused()) << "no type is written so";
  const std::string http = "GET / HTTP/1.1\r\nHost: localhost:18944\r\nUser-Agent: something\r\n";
  bytes.assign(http.begin(), http.end());
  EXPECT_TRUE(refused());
}

}  // namespace
}  // namespace orthonav::igtl::message_test
