#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/session/session.h"
#include "hal/igtl/message.h"

namespace orthonav::tools {

/// "PointerToReference": only the letters and digits of `from`, the first in upper case and the
/// others in lower case, so that there is no "To" in it; cut so that the whole fits into 20 bytes.
[[nodiscard]] std::string igtl_device(const std::string& from, const std::string& to);

/// Whether this tool would be sent under the name of one before it, whose name is alike as far as
/// 20 bytes hold it: it is not sent, or a receiver would show one tool in two places.
[[nodiscard]] bool igtl_name_is_taken(std::span<const nav::ToolGeometry> tools, std::size_t tool,
                                      const std::string& to);

/// A time as OpenIGTLink stamps it.
[[nodiscard]] std::uint64_t igtl_stamp(Timestamp time);

/// A pose in OpenIGTLink's form, mm.
[[nodiscard]] igtl::TransformValues igtl_values(const Mat3& rotation, Vec3 translation_m);

/// The messages for every pair: a TRANSFORM for each tool measured in this pair and for each
/// registered and accepted level, and the numbers of the guidance as a STRING.
///
/// Tools have their origin at their tip and their marker's axes. `LABELModel` is the model in RAS
/// and millimetres, as in 3D Slicer. All are relative to `Reference` if a patient reference is in
/// use, otherwise to `World`, the headset's map. Tools that are not measured are left out, since
/// version 1 can't mark a pose as old.
[[nodiscard]] std::vector<std::uint8_t> igtl_frame(const engine::Session& session,
                                                   const engine::Guidance& guidance);

/// Only the levels of that.
[[nodiscard]] std::vector<std::uint8_t> igtl_models(const engine::Guidance& guidance);

/// The step, the status line, and which tools are lost.
[[nodiscard]] std::vector<std::uint8_t> igtl_status(const engine::Session& session,
                                                    const engine::Guidance& guidance);

/// What became of something that a client sent, as a STRING `CommandAnswer`.
[[nodiscard]] std::vector<std::uint8_t> igtl_answer(const nlohmann::ordered_json& answer,
                                                    std::uint64_t stamp);

/// Each screw of a level in its model's frame: a POINT with entry and target (radius in the field
/// for it) and a POLYDATA of its cylinder.
[[nodiscard]] std::vector<std::uint8_t> igtl_screws(const std::string& label,
                                                    std::span<const nav::ScrewPlan> screws,
                                                    Timestamp time);
/// Those of the plans in use.
[[nodiscard]] std::vector<std::uint8_t> igtl_screws(std::span<const engine::LevelState> levels,
                                                    Timestamp time);

}  // namespace orthonav::tools
