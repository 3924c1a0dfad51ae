#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/angle.h"
#include "engine/io/json_writer.h"
#include "engine/print/board_file.h"
#include "nav/calibration/stereo_recording.h"
#include "tools/orthonav/calibrate/calibrate.h"
#include "tools/orthonav/calibrate/calibrate_stereo.h"
#include "tools/orthonav/shared/print_text.h"
#include "tools/orthonav/shared/recorded_pairs.h"

namespace orthonav::tools {
namespace {

/// The family by the detector's name, which differs for a border two cells wide.
Result<std::string> detected_family(const std::string& path, const engine::Board& board) {
  if (board.kind == engine::BoardKind::kChessboard) {
    return Error{path + ": is a chessboard, must be a board of tags"};
  }
  std::string family = board.family + (board.border_cells == 2 ? "b2" : "");
  if (board.border_cells > 2 || !nav::is_known_family(family)) {
    return Error{path + ": " + board.family + " with borders " +
                 std::to_string(board.border_cells) + " cells wide can't be detected"};
  }
  return family;
}

Result<std::vector<nav::BoardTag>> tags_of(const std::string& path) {
  const auto board = engine::load_board(path);
  if (!board) {
    return board.error();
  }
  const auto family = detected_family(path, *board);
  if (!family) {
    return family.error();
  }
  std::vector<nav::BoardTag> tags;
  for (std::size_t i = 0; i < board->ids.size(); ++i) {
    const std::vector<Vec2> corners = engine::tag_corners_m(*board, i);
    const Vec2 centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    tags.push_back(
        {{*family, board->ids[i], board->size_m}, {Mat3::identity(), {centre.x, centre.y, 0.0}}});
  }
  return tags;
}

nlohmann::ordered_json recording_json(const StereoArguments& arguments,
                                      const RecordedSightings& seen,
                                      const Result<nav::StereoRecording>& found) {
  nlohmann::ordered_json out = {{"format", "orthonav stereo calibration"},
                                {"format_version", 1},
                                {"source", "recording"},
                                {"board", arguments.board},
                                {"pairs", seen.pairs.size()}};
  if (!found) {
    add_judgement({nav::Verdict::kFail, found.error().message}, out);
    return out;
  }
  out["pairs_used"] = found->pairs;
  out["right_from_left_mm"] = engine::rows_mm(found->right_from_left.row_major());
  out["device_right_from_left_mm"] =
      engine::rows_mm(seen.calibration.right_from_left().row_major());
  out["baseline_mm"] = found->right_from_left.translation().norm() * 1e3;
  const Vec3 rotation_deg = found->rotation_rad * kDegreesPerRadian;
  const Vec3 translation_mm = found->translation_m * 1e3;
  out["turn_deg"] = {rotation_deg.x, rotation_deg.y, rotation_deg.z};
  out["turn_sigma_deg"] = found->rotation_sigma_rad * kDegreesPerRadian;
  out["shift_mm"] = {translation_mm.x, translation_mm.y, translation_mm.z};
  out["shift_sigma_mm"] = found->translation_sigma_m * 1e3;
  out["off_px"] = found->off_px;
  out["off_sigma_px"] = found->off_sigma_px;
  out["is_off"] = found->is_off;
  out["epipolar_before_px"] = found->epipolar_before_px;
  out["epipolar_after_px"] = found->epipolar_after_px;
  out["rms_px"] = found->rms_px;
  out["covered_share"] = found->covered_fraction;
  out["size_ratio"] = found->size_ratio;
  add_judgement(found->judgement, out);
  return out;
}

void print(const nav::StereoRecording& found) {
  const Vec3 rotation_deg = found.rotation_rad * kDegreesPerRadian;
  const Vec3 translation_mm = found.translation_m * 1e3;
  print_text(
      "%zu pairs, residual %.3f px RMS; across epipolar lines %.3f px RMS as the device has "
      "them, %.3f px as found\n",
      found.pairs, found.rms_px, found.epipolar_before_px, found.epipolar_after_px);
  print_text(
      "right camera turned by %.4f %.4f %.4f°, known to %.4f°; shifted by %.3f %.3f %.3f mm, "
      "known to %.3f mm\n",
      rotation_deg.x, rotation_deg.y, rotation_deg.z, found.rotation_sigma_rad * kDegreesPerRadian,
      translation_mm.x, translation_mm.y, translation_mm.z, found.translation_sigma_m * 1e3);
  print_text("baseline %.3f mm; the tags' edges measure %.4f of their size\n",
             found.right_from_left.translation().norm() * 1e3, found.size_ratio);
  print_judgement(found.judgement);
}

}  // namespace

int run_stereo_recording(const StereoArguments& arguments) {
  const auto board = tags_of(arguments.board);
  if (!board) {
    return bad_input(board.error().message);
  }
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  std::vector<nav::MarkerDefinition> tags;
  for (const nav::BoardTag& tag : *board) {
    tags.push_back(tag.definition);
  }
  const auto seen = recorded_sightings(arguments.recording, std::move(tags));
  if (!seen) {
    return bad_input(seen.error().message);
  }
  const auto found = nav::calibrate_stereo(seen->calibration, *board, seen->pairs);
  if (const Status s = arguments.json.write(recording_json(arguments, *seen, found)); !s) {
    return bad_input(s.error().message);
  }
  if (!found) {
    return refused(found.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print(*found);
  }
  return found->judgement.verdict == nav::Verdict::kFail ? refused(found->judgement.reason) : kDone;
}

}  // namespace orthonav::tools
