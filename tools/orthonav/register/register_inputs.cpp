#include "tools/orthonav/register/register_inputs.h"

#include <memory>

#include "engine/case/likely_mistakes.h"
#include "engine/case/operation_plan.h"
#include "engine/case/plan_file.h"
#include "engine/case/points_file.h"
#include "engine/io/mesh_file.h"
#include "tools/orthonav/shared/case_source.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

using engine::Axes;

/// A model's unit is that of its plan. Without a plan it is the given unit, or millimetres if only
/// then it has the size of a vertebra: digitized points in metres with a model in millimetres are
/// common.
Result<nav::TriangleMesh> load_model(const RegisterArguments& arguments,
                                     const std::optional<engine::Plan>& plan, Axes axes) {
  std::string note;
  const auto in_unit = [&](double metres_per_unit) {
    return engine::load_mesh(arguments.model, metres_per_unit, axes, &note,
                             arguments.any_bone ? nav::Bone::kAny : nav::Bone::kVertebra);
  };
  auto mesh = in_unit(plan ? plan->metres_per_unit : arguments.units == "m" ? 1.0 : 1e-3);
  if (!mesh && !plan && arguments.units == "m") {
    if (auto in_millimetres = in_unit(1e-3)) {
      mesh = std::move(in_millimetres);
    }
  }
  if (mesh && !note.empty()) {
    print_warning(note);
  }
  return mesh;
}

Status load_points(const RegisterArguments& arguments, RegisterInputs& inputs) {
  const auto file = engine::load_points(arguments.points);
  if (!file) {
    return file.error();
  }
  const double given_m = arguments.units == "m" ? 1.0 : 1e-3;
  inputs.frame.points_unit_m = file->metres_per_unit.value_or(given_m);
  inputs.points_axes = file->axes;
  std::vector<Vec3> places_m;
  for (const Vec3& p : file->points) {
    inputs.points.push_back({inputs.frame.points_unit_m * p});
    places_m.push_back(inputs.frame.points_unit_m * p);
  }
  const Status scale = engine::check_scale(places_m, file->metres_per_unit.has_value());
  return scale ? Status{} : Status{Error{arguments.points + ": " + scale.error().message}};
}

Status load_single_level(const RegisterArguments& arguments, RegisterInputs& inputs) {
  std::optional<engine::Plan> plan;
  if (!arguments.plans.empty()) {
    auto file = engine::load_plan(arguments.plans);
    if (!file) {
      return file.error();
    }
    plan = std::move(*file);
    inputs.level.label = plan->level;
  }
  const Axes axes = !arguments.frame.empty() ? *engine::axes_from(arguments.frame)
                    : plan                   ? plan->axes
                                             : Axes::kLps;
  auto mesh = load_model(arguments, plan, axes);
  if (!mesh) {
    return mesh.error();
  }
  if (plan) {
    auto screws = engine::screws_on(*mesh, *plan);
    if (!screws) {
      return screws.error();
    }
    inputs.level.screws = std::move(*screws);
  }
  if (!plan && !arguments.any_bone) {  // whose screws say which way it faces
    if (const auto canal = engine::has_canal(*mesh); !canal) {
      return Error{arguments.model + ": " + canal.error().message};
    }
  }
  inputs.frame.model_axes = engine::declared_axes(arguments.model).value_or(axes);
  auto model = nav::VertebraModel::prepare(
      *mesh, arguments.any_bone ? nav::Bone::kAny : nav::Bone::kVertebra);
  if (!model) {
    return Error{arguments.model + ": " + model.error().message};
  }
  inputs.level.model = std::move(*model);
  return {};
}

/// A loaded case has its models in LPS, whatever the axes of its files.
Status load_level_of_case(const RegisterArguments& arguments, RegisterInputs& inputs) {
  const auto source = load_checked_case(arguments.case_folder);
  if (!source) {
    return source.error();
  }
  auto operation = engine::plan_operation(*source, {arguments.level});
  if (!operation) {
    return Error{"--level: " + operation.error().message};
  }
  inputs.level = std::move(operation->levels.front());
  return {};
}

Status check_together(const RegisterArguments& a) {
  if (a.model.empty() && a.level.empty()) {
    return Error{a.case_folder.empty() ? "register: --model or --level is required"
                                       : "register: --case needs --level"};
  }
  if (!a.model.empty() && !(a.level.empty() && a.case_folder.empty())) {
    return Error{"register: --model excludes --case and --level"};
  }
  if (a.model.empty() && !a.plans.empty()) {
    return Error{"register: --plan needs --model"};
  }
  if (a.model.empty() && !a.frame.empty()) {
    return Error{"register: --frame needs --model"};
  }
  if (a.any_bone && (a.model.empty() || !a.plans.empty())) {
    return Error{"register: --any-bone needs --model, and excludes --plan, which is of a vertebra"};
  }
  if (a.any_bone && a.method != "best") {
    return Error{"--any-bone: only the method best registers another bone than a vertebra"};
  }
  if (a.model_sd_mm && a.method != "best") {
    return Error{
        "--model-sd-mm: only the method best takes a difference of the model into account"};
  }
  if (a.tip_radius_mm > 0.0 && a.method != "best") {
    return Error{"--tip-radius-mm: only the method best takes a ball tip into account"};
  }
  return {};
}

}  // namespace

Result<RegisterInputs> load_register_inputs(
    const RegisterArguments& arguments,
    const std::function<Status(const RegisterInputs&)>& check_points) {
  if (const Status s = check_together(arguments); !s) {
    return s.error();
  }
  RegisterInputs inputs;
  if (const Status s = load_points(arguments, inputs); !s) {
    return s.error();
  }
  if (const Status s = check_points(inputs); !s) {
    return s.error();
  }
  const Status level = arguments.model.empty() ? load_level_of_case(arguments, inputs)
                                               : load_single_level(arguments, inputs);
  if (!level) {
    return level.error();
  }
  return inputs;
}

}  // namespace orthonav::tools
