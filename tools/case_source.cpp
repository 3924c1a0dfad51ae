#include "tools/case_source.h"

#include <cstdio>

#include "engine/phantom/phantom.h"
#include "engine/scan/transform_file.h"

namespace orthonav::tools {

Result<engine::Case> load_checked_case(const std::string& folder, engine::CaseUse use) {
  if (!folder.empty()) {
    auto subject = engine::load_case(folder, use, engine::load_transform);
    if (subject && !subject->unusual.empty()) {
      subject->notes.push_back(folder + ": unusual spine: " + subject->unusual);
    }
    if (subject) {
      for (const std::string& note : subject->notes) {
        std::fprintf(stderr, "orthonav: warning: %s\n", note.c_str());
      }
    }
    return subject;
  }
  engine::Case spine = engine::phantom();
  if (const auto problems = spine.check(); !problems.empty()) {
    return Error{"built-in phantom: " + problems.front()};
  }
  return spine;
}

}  // namespace orthonav::tools
