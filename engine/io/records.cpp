#include "engine/io/records.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/check.h"
#include "base/number_bytes.h"
#include "engine/io/crc32c.h"

namespace orthonav::engine {
namespace {

constexpr std::size_t kLengthBytes = 4;
constexpr std::size_t kCheckBytes = 4;
constexpr std::size_t kHeadBytes = kLengthBytes + kCheckBytes + 8 + 2 + 2;

std::uint32_t check_of(std::string_view length, std::string_view rest, std::uint32_t before) {
  std::string chained;
  put(chained, before);
  return crc32c(rest, crc32c(length, crc32c(chained)));
}

/// The record at the start of `bytes`, and its check; nothing if it is incomplete.
std::optional<Record> whole_record(std::string_view bytes, std::uint64_t number,
                                   std::uint32_t& check) {
  if (bytes.size() < kHeadBytes) {
    return std::nullopt;
  }
  const std::string_view length = bytes.substr(0, kLengthBytes);
  std::string_view head = bytes;
  const std::size_t payload_bytes = take<std::uint32_t>(head);
  const auto stated = take<std::uint32_t>(head);
  if (payload_bytes > kMaxPayloadBytes || payload_bytes > bytes.size() - kHeadBytes) {
    return std::nullopt;
  }
  const std::size_t checked = kHeadBytes - kLengthBytes - kCheckBytes + payload_bytes;
  if (check_of(length, head.substr(0, checked), check) != stated) {
    return std::nullopt;
  }
  Record record;
  record.number = take<std::uint64_t>(head);
  record.type = take<std::uint16_t>(head);
  record.version = take<std::uint16_t>(head);
  record.payload = head.substr(0, payload_bytes);
  if (record.number != number) {
    return std::nullopt;
  }
  check = stated;
  return record;
}

}  // namespace

std::uint32_t append_record(std::string& out, const Record& record, std::uint32_t check_before) {
  ORTHONAV_CHECK(record.payload.size() <= kMaxPayloadBytes && "a record is too long");
  std::string length;
  put(length, static_cast<std::uint32_t>(record.payload.size()));
  std::string rest;
  put(rest, record.number);
  put(rest, record.type);
  put(rest, record.version);
  rest += record.payload;
  const std::uint32_t check = check_of(length, rest, check_before);
  out += length;
  put(out, check);
  out += rest;
  return check;
}

Result<RecordsRead> read_records(std::string_view bytes, const std::string& name) {
  const std::size_t beginning = std::min(bytes.size(), kRecordsBegin.size());
  if (bytes.substr(0, beginning) != kRecordsBegin.substr(0, beginning)) {
    return Error{name + ": is not a file of records of an operation"};
  }
  RecordsRead read;
  read.check = kFirstCheck;
  if (bytes.size() < kRecordsBegin.size()) {
    read.dropped_bytes = bytes.size();
    return read;
  }
  read.whole_bytes = kRecordsBegin.size();
  while (auto record =
             whole_record(bytes.substr(read.whole_bytes), read.records.size() + 1, read.check)) {
    read.whole_bytes += kHeadBytes + record->payload.size();
    read.records.push_back(std::move(*record));
  }
  read.dropped_bytes = bytes.size() - read.whole_bytes;
  return read;
}

}  // namespace orthonav::engine
