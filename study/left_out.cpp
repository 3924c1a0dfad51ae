#include "study/left_out.h"

#include <algorithm>
#include <array>

namespace orthonav::engine {
namespace {

struct NamedStep {
  std::string_view name;
  void (*leave_out)(OperationOptions& options);
};

constexpr std::array<NamedStep, 9> kSteps = {{
    {"check points", [](OperationOptions& o) { o.session.steps.check_points = false; }},
    {"landmark", [](OperationOptions& o) { o.session.steps.landmark = false; }},
    {"tips", [](OperationOptions& o) { o.session.steps.tips = false; }},
    {"axis", [](OperationOptions& o) { o.session.steps.axis = false; }},
    {"tag sizes", [](OperationOptions& o) { o.correct_tag_sizes = false; }},
    {"wire", [](OperationOptions& o) { o.session.steps.wire = false; }},
    {"redo", [](OperationOptions& o) { o.session.steps.redo = false; }},
    {"numbers",
     [](OperationOptions& o) {
       if (o.sim.guidance == sim::GuidanceProfile::kClosedLoop) {
         o.sim.guidance = sim::GuidanceProfile::kNumbers;
       }
     }},
    {"reference", [](OperationOptions& o) { o.use_reference = false; }},
}};

}  // namespace

Status leave_out(std::string_view step, OperationOptions& options) {
  std::string name(step);
  std::replace(name.begin(), name.end(), '-', ' ');
  std::string known;
  for (const NamedStep& one : kSteps) {
    if (one.name == name) {
      auto& already = options.left_out;
      if (std::find(already.begin(), already.end(), name) != already.end()) {
        return Error{"'" + name + "' is left out twice"};
      }
      one.leave_out(options);
      already.push_back(name);
      return {};
    }
    known += (known.empty() ? "" : ", ") + std::string(one.name);
  }
  return Error{"'" + name + "': no step that can be left out (known: " + known + ")"};
}

std::string left_out_of(const OperationOptions& options) {
  std::string out;
  for (const std::string& step : options.left_out) {
    out += (out.empty() ? "" : ", ") + step;
  }
  return out;
}

}  // namespace orthonav::engine
