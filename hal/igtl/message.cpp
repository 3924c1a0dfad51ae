#include "hal/igtl/message.h"

#include <igtl_util.h>
#include <igtlPointMessage.h>
#include <igtlPolyDataMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTimeStamp.h>
#include <igtlTransformMessage.h>

#include <algorithm>

namespace orthonav::igtl {
namespace {

constexpr std::size_t kPointNameBytes = 64;
constexpr std::size_t kPointGroupBytes = 32;
constexpr std::size_t kMaxText = 65535;

std::string cut(const std::string& text, std::size_t most) { return text.substr(0, most); }

/// Header, body and checksum of a message whose values are set.
std::vector<std::uint8_t> bytes_of(::igtl::MessageBase& message, const Label& label) {
  message.SetDeviceName(cut(label.device, kNameBytes).c_str());
  message.SetTimeStamp(static_cast<unsigned int>(label.timestamp >> 32u),
                       static_cast<unsigned int>(label.timestamp & 0xffffffffu));
  message.Pack();
  const auto* first = static_cast<const std::uint8_t*>(message.GetPackPointer());
  return {first, first + message.GetPackSize()};
}

}  // namespace

std::vector<std::uint8_t> packed(const Label& label, const TransformValues& values) {
  const auto message = ::igtl::TransformMessage::New();
  ::igtl::Matrix4x4 matrix = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      matrix[row][column] = values[3 * column + row];
    }
  }
  message->SetMatrix(matrix);
  return bytes_of(*message, label);
}

std::vector<std::uint8_t> packed(const Label& label, const StatusValues& values) {
  const auto message = ::igtl::StatusMessage::New();
  message->SetCode(values.code);
  message->SetSubCode(values.subcode);
  message->SetErrorName(cut(values.name, kNameBytes - 1).c_str());
  message->SetStatusString(values.message.c_str());
  return bytes_of(*message, label);
}

std::vector<std::uint8_t> packed(const Label& label, std::span<const PointValues> values) {
  const auto message = ::igtl::PointMessage::New();
  for (const PointValues& point : values) {
    ::igtl::PointElement::Pointer element = ::igtl::PointElement::New();
    element->SetName(cut(point.name, kPointNameBytes).c_str());
    element->SetGroupName(cut(point.group, kPointGroupBytes).c_str());
    element->SetRGBA(point.rgba[0], point.rgba[1], point.rgba[2], point.rgba[3]);
    element->SetPosition(point.position_mm[0], point.position_mm[1], point.position_mm[2]);
    element->SetRadius(point.radius_mm);
    element->SetOwner(cut(point.owner, kNameBytes).c_str());
    message->AddPointElement(element);
  }
  return bytes_of(*message, label);
}

std::vector<std::uint8_t> packed(const Label& label,
                                 std::span<const std::array<float, 3>> points_mm,
                                 std::span<const Triangle> triangles) {
  const auto message = ::igtl::PolyDataMessage::New();
  const auto points = ::igtl::PolyDataPointArray::New();
  for (const auto& p : points_mm) {
    points->AddPoint(p[0], p[1], p[2]);
  }
  const auto polygons = ::igtl::PolyDataCellArray::New();
  for (Triangle t : triangles) {
    polygons->AddCell(3, t.data());
  }
  message->SetPoints(points);
  message->SetPolygons(polygons);
  return bytes_of(*message, label);
}

std::vector<std::uint8_t> packed_text(const Label& label, const std::string& text) {
  const auto message = ::igtl::StringMessage::New();
  std::string most = cut(text, kMaxText);
  message->SetString(most);
  return bytes_of(*message, label);
}

std::uint64_t checksum_of(Bytes body) {
  // crc64 takes a pointer to non-const data but only reads.
  return crc64(const_cast<std::uint8_t*>(body.data()), body.size(), 0);
}

}  // namespace orthonav::igtl
