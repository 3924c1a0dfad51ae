#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/io/json_document.h"
#include "engine/io/records.h"
#include "engine/session/log/logged_operation.h"

namespace orthonav::test {

/// How often each screw ("L4 left") was declared done in a log, by all the programs that wrote it.
inline std::map<std::string, int> screws_done(const std::vector<engine::Record>& records) {
  std::map<std::string, int> done;
  for (const engine::Record& record : records) {
    if (record.type == static_cast<std::uint16_t>(engine::OperationRecord::kScrew)) {
      const auto document = engine::JsonDocument::parse(record.payload, "screw").value();
      ++done[document.root().text("label") + " " + document.root().text("side")];
    }
  }
  return done;
}

/// The expected counts of an operation on two levels.
inline const std::map<std::string, int> kEveryScrewOnce = {
    {"L4 left", 1}, {"L4 right", 1}, {"L5 left", 1}, {"L5 right", 1}};

}  // namespace orthonav::test
