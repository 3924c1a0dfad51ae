#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/frame_loop.h"
#include "engine/guidance.h"

namespace orthonav::engine {

struct ScrewOutcome {
  nav::Side side = nav::Side::kLeft;
  bool done = false;                      ///< as the surgeon declared it
  std::optional<double> angle_error_rad;  ///< against the truth, where there is one
  std::optional<double> entry_error_m;    ///< absent too when the wire misses the bone
};

struct LevelOutcome {
  std::string label;
  bool accepted = false;
  int attempts = 0;
  std::optional<double> rmse_m;  ///< absent without an accepted registration
  std::optional<double> tre_m;   ///< mean over the entries and targets of the level's screws
  /// Root mean square error to expect at the worst of the screws' entries and targets.
  std::optional<double> predicted_tre_m;
  std::size_t points = 0;
  std::optional<double> digitization_s;
  std::vector<ScrewOutcome> screws;
};

struct RodOutcome {
  nav::Side side = nav::Side::kLeft;
  std::size_t heads = 0;
  std::optional<double> length_m;
  std::optional<double> length_error_m;  ///< template against the spline through the true heads
  std::optional<double> head_error_m;    ///< mean distance of a touched head from the true one
};

/// One operation, measured. What depends on the machine's speed stays in `loop`.
struct OperationResult {
  std::string method;
  std::uint64_t seed = 0;
  std::string case_name;
  bool completed = false;  ///< every level accepted, every screw done, the rods too
  std::vector<LevelOutcome> levels;
  std::vector<RodOutcome> rods;
  LoopReport loop;
};

/// What the session itself knows, without any truth.
[[nodiscard]] OperationResult outcome_of(std::span<const LevelState> levels,
                                         std::span<const RodState> rods, LoopReport loop);

/// report.json as docs/file-formats.md describes it: deterministic bytes for equal results.
[[nodiscard]] std::string report_json(const OperationResult& result);
/// Wall times of the run, which differ from machine to machine.
[[nodiscard]] std::string timing_json(const LoopReport& loop);

}  // namespace orthonav::engine
