#pragma once

#include <functional>
#include <string>

#include "base/result.h"
#include "engine/case/case.h"
#include "engine/case/plan_file.h"
#include "engine/io/tfm_file.h"

namespace orthonav::engine {

/// Reads a model in the unit and frame that its plan declares, with the plan's screws on it.
Result<CaseLevel> load_level(const std::string& model, const Plan& plan,
                             std::string* note = nullptr);

/// Reads the transform file at that path.
using TransformReader = std::function<Result<StoredTransform>(const std::string& path)>;

/// Reads a case folder: `case.json` with `{"name", "units"?, "levels": [{"label", "model", "plan"?,
/// "spine_from_model"?}]}`, and the models and plans that it names. A model is read in the unit and
/// frame that its plan declares, or, without a plan, in the case's unit and LPS, unless the model's
/// file declares its own axes. `spine_from_model` (4×4 by rows, mm unless `units` says m) is in the
/// same axes as the model; or it is the name of a transform file of 3D Slicer under which the model
/// lies there (always mm and LPS), which `transforms` reads. If no level has one, models that do
/// not overlap are taken as they are (one scan), and models that overlap are stacked in the order
/// of the file, the first on top. Files outside the folder are refused.
Result<Case> load_case(const std::string& folder, CaseUse use = CaseUse::kOperation,
                       const TransformReader& transforms = load_tfm);

}  // namespace orthonav::engine
