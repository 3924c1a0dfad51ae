#include "engine/io/records.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Logs of operations: what is read is what writing it again gives.
void fuzz_operation_log(std::span<const std::uint8_t> input) {
  const std::string bytes(input.begin(), input.end());
  const auto read = engine::read_records(bytes, "log");
  if (!read) {
    insist(read.error().message.find('\n') == std::string::npos);
    return;
  }
  insist(read->whole_bytes + read->dropped_bytes == bytes.size());
  std::string again(read->whole_bytes > 0 ? engine::kRecordsBegin : std::string_view());
  std::uint32_t check = engine::kFirstCheck;
  for (const engine::Record& record : read->records) {
    check = engine::append_record(again, record, check);
  }
  insist(check == read->check && again == bytes.substr(0, read->whole_bytes));
}

}  // namespace orthonav::fuzz
