#include "tests/tools/faults/failing_disk.h"

#include <cstdlib>
#include <sstream>
#include <string_view>

#include "tests/support/temporary_folder.h"

namespace orthonav::test {
namespace {

void put(const char* name, const std::string& value) { setenv(name, value.c_str(), 1); }

}  // namespace

bool disk_can_fail() { return std::string_view(ORTHONAV_SANITIZED).empty(); }

bool every_fault_is_tried() { return std::getenv("ORTHONAV_EVERY_FAULT") != nullptr; }

void fail_disk(const std::string& folder, const DiskFault& fault, const std::string& list) {
  put("LD_PRELOAD", ORTHONAV_FAILING_CALLS);
  put("FAILING_CALLS_FOLDER", folder);
  put("FAILING_CALLS_LIST", list);
  put("FAILING_CALLS_KIND", fault.kind);
  put("FAILING_CALLS_NAME", fault.name);
  put("FAILING_CALLS_AT", std::to_string(fault.at));
  put("FAILING_CALLS_WITH", std::to_string(fault.problem));
  put("FAILING_CALLS_LASTING", fault.lasting ? "1" : "0");
}

std::vector<DiskCall> listed_calls(const std::string& list) {
  std::istringstream in(content_of(list));
  std::vector<DiskCall> calls;
  for (DiskCall call; in >> call.kind && std::getline(in >> std::ws, call.path);) {
    calls.push_back(call);
  }
  return calls;
}

}  // namespace orthonav::test
