#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace orthonav::engine {

/// One record. Type and version define the meaning of its bytes.
struct Record {
  std::uint64_t number = 0;  ///< from 1, without a gap
  std::uint16_t type = 0;
  std::uint16_t version = 0;
  std::string payload;

  bool operator==(const Record&) const = default;
};

/// The complete part of a file.
struct RecordsRead {
  std::vector<Record> records;
  std::size_t whole_bytes = 0;    ///< of the file, up to the end of the last record
  std::size_t dropped_bytes = 0;  ///< after it: incomplete, damaged, or not of this file
  std::uint32_t check = 0;        ///< of the last record
};

/// The beginning of a file of records.
inline constexpr std::string_view kRecordsBegin = "orthonav records 1\n";
/// Start value for the check of the first record.
inline constexpr std::uint32_t kFirstCheck = 0;
inline constexpr std::size_t kMaxPayloadBytes = 64u << 20u;

/// Appends a record in its file format: length of the payload (4 bytes), check (4), number (8),
/// type (2), version (2), all little-endian, then the payload. The check is the CRC-32C of the
/// previous record's check, the length, and everything after the check, so a record left in an old
/// disk block is never taken for one of this file. Returns the check.
std::uint32_t append_record(std::string& out, const Record& record, std::uint32_t check_before);

/// Reads up to the first incomplete record. Refuses a file with a different beginning; one that is
/// truncated within its beginning has no records.
Result<RecordsRead> read_records(std::string_view bytes, const std::string& name);

}  // namespace orthonav::engine
