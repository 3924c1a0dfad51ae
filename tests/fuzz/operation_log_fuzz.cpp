#include <algorithm>

#include "engine/io/records.h"
#include "engine/report/session_report.h"
#include "engine/session/log/logged_operation.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {
namespace {

/// Reads the records as an operation: it may be refused in one line; an accepted one has a report
/// and can be resumed.
void insist_on_operation(const std::vector<engine::Record>& records) {
  auto operation = engine::LoggedOperation::from(records, "log");
  if (!operation) {
    insist_one_line(operation.error());
    return;
  }
  insist(operation->first_time.has_value() == operation->last_time.has_value());
  const bool says_nan = std::any_of(records.begin(), records.end(), [](const auto& record) {
    return record.payload.find("nan") != std::string::npos;
  });
  insist(says_nan || engine::session_page(*operation, "log").find("nan") == std::string::npos);
  insist(!engine::session_json(*operation).empty());
  operation->reopen();
  for (const engine::LevelState& level : operation->state.levels) {
    insist(!level.accepted || level.registration.has_value());
  }
}

}  // namespace

/// Logs of operations: writing what was read gives the same. The checksums keep changed bytes from
/// the parsers inside, so the input is also taken as a record of each type.
void fuzz_operation_log(std::span<const std::uint8_t> input) {
  const std::string bytes(input.begin(), input.end());
  const auto read = engine::read_records(bytes, "log");
  if (!read) {
    insist_one_line(read.error());
  } else {
    insist(read->whole_bytes + read->dropped_bytes == bytes.size());
    std::string again(read->whole_bytes > 0 ? engine::kRecordsBegin : std::string_view());
    std::uint32_t check = engine::kFirstCheck;
    for (const engine::Record& record : read->records) {
      check = engine::append_record(again, record, check);
    }
    insist(check == read->check && again == bytes.substr(0, read->whole_bytes));
    insist_on_operation(read->records);
  }
  const std::size_t end = bytes.find('\n');
  if (end == std::string::npos) {
    return;
  }
  // A first line that begins an operation, then one record.
  constexpr std::uint16_t kVersion = engine::kOperationRecordVersion;
  const engine::Record first{1, 1, kVersion, bytes.substr(0, end)};
  for (std::uint16_t type = 2; type <= engine::kOperationRecords; ++type) {
    insist_on_operation({first, {2, type, kVersion, bytes.substr(end + 1)}});
  }
}

}  // namespace orthonav::fuzz
