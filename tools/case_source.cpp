#include "tools/case_source.h"

#include "engine/phantom/phantom.h"
#include "engine/scan/transform_file.h"

namespace orthonav::tools {

Result<engine::Case> load_checked_case(const std::string& folder, engine::CaseUse use) {
  if (!folder.empty()) {
    return engine::load_case(folder, use, engine::load_transform);
  }
  engine::Case spine = engine::phantom();
  if (const auto problems = spine.check(); !problems.empty()) {
    return Error{"built-in phantom: " + problems.front()};
  }
  return spine;
}

}  // namespace orthonav::tools
