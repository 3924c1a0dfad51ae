#include <tuple>

#include "engine/case/case_file.h"
#include "tests/fuzz/input_file.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::fuzz {
namespace {

/// A box.
constexpr const char* kModel =
    "v -30 -20 -15\nv 30 -20 -15\nv -30 40 -15\nv 30 40 -15\n"
    "v -30 -20 15\nv 30 -20 15\nv -30 40 15\nv 30 40 15\n"
    "f 1 3 4\nf 1 4 2\nf 5 6 8\nf 5 8 7\nf 1 2 6\nf 1 6 5\n"
    "f 3 7 8\nf 3 8 4\nf 1 5 7\nf 1 7 3\nf 2 4 8\nf 2 8 6\n";
constexpr const char* kPlan =
    R"({"units": "mm", "frame": "LPS", "screws": [
        {"side": "left", "entry": [20, 40, 0], "target": [20, 0, 0], "radius": 2.5}]})";

/// A folder with a model and a plan that a case may name.
class CaseFolder {
 public:
  CaseFolder() {
    std::ignore = folder_.with("bone.obj", kModel);
    std::ignore = folder_.with("plan.json", kPlan);
  }
  [[nodiscard]] Result<engine::Case> with_case(const std::string& text) const {
    std::ignore = folder_.with("case.json", text);
    return engine::load_case(folder_.path().string());
  }

 private:
  test::TemporaryFolder folder_;
};

}  // namespace

/// `case.json` of a folder.
void fuzz_case(std::span<const std::uint8_t> input) {
  static const CaseFolder folder;
  const auto loaded = folder.with_case(text_of(input));
  if (!loaded) {
    insist_one_line(loaded.error());
    return;
  }
  insist(!loaded->levels.empty());
  for (const engine::CaseLevel& level : loaded->levels) {
    insist(!level.label.empty() && !level.mesh.triangles.empty());
  }
}

}  // namespace orthonav::fuzz
