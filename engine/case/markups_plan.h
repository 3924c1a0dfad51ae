#pragma once

#include <span>
#include <string>

#include "base/result.h"
#include "engine/case/plan_file.h"
#include "engine/io/slicer_markups.h"

namespace orthonav::engine {

/// Writes screws as lines of 3D Slicer (`.mrk.json`, markups schema 1.0.3, millimetres, LPS): point
/// 0 the entry, point 1 the target, the name "L4 left diameter=6.5", since 3D Slicer keeps names
/// when it saves; the reason why a screw may break through goes into the description. `load_plan`
/// reads the same screws back. Refuses a path that does not end in `.mrk.json`.
Status save_markups_plan(const std::string& path, const std::string& level,
                         std::span<const nav::ScrewPlan> screws);

/// The plan in a markups file, not yet checked; see load_plan. `name` stands for the file in
/// messages.
Result<Plan> plan_from_markups(const Result<MarkupsFile>& file, const std::string& name);

}  // namespace orthonav::engine
