#include "tools/orthonav/shared/case_source.h"

#include <cstdio>

#include "engine/phantom/phantom.h"
#include "engine/scan/transform_file.h"
#include "engine/scan/volume_file.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {

Result<engine::Case> load_checked_case(const std::string& folder, engine::CaseUse use) {
  if (!folder.empty()) {
    auto subject = engine::load_case(folder, use, engine::load_transform);
    if (subject && !subject->unusual.empty()) {
      subject->notes.push_back(folder + ": unusual spine: " + subject->unusual);
    }
    if (subject) {
      for (const std::string& note : subject->notes) {
        print_warning(note);
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

Result<engine::Volume> load_scan(const std::string& path, const std::string& series) {
  auto volume = engine::load_volume(path, series);
  if (volume) {
    for (const std::string& note : volume->notes) {
      std::fprintf(stderr, "orthonav: %s: %s\n", path.c_str(), note.c_str());
    }
  }
  return volume;
}

}  // namespace orthonav::tools
