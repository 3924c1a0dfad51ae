#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/angle.h"
#include "base/printed.h"
#include "engine/io/grey_image_file.h"
#include "engine/io/json_writer.h"
#include "nav/calibration/stereo_board.h"
#include "tools/orthonav/calibrate/calibrate.h"
#include "tools/orthonav/calibrate/calibrate_stereo.h"
#include "tools/orthonav/calibrate/image_pairs.h"
#include "tools/orthonav/shared/count_progress.h"
#include "tools/orthonav/shared/print_text.h"

namespace orthonav::tools {
namespace {

/// What the images gave: the views of the board, and the images left over.
struct Views {
  nav::ImageSize size;
  std::vector<nav::BoardView> views;
  std::vector<ImagePair> pairs;      ///< of the views
  std::vector<std::string> skipped;  ///< images without a board or without a partner
};

Result<nav::Chessboard> board_from(const StereoArguments& arguments) {
  int columns = 0;
  int rows = 0;
  char rest = 0;
  if (std::sscanf(arguments.chessboard.c_str(), "%2dx%2d%c", &columns, &rows, &rest) != 2) {
    return Error{"--chessboard: \"" + arguments.chessboard +
                 "\" must be columns x rows of inner corners, such as 9x6"};
  }
  nav::Chessboard board{columns, rows, arguments.square_mm * 1e-3};
  if (const auto problems = board.check(); !problems.empty()) {
    return Error{problems.front()};
  }
  return board;
}

Result<std::optional<nav::BoardCorners>> corners_in(const std::string& path,
                                                    const nav::Chessboard& board,
                                                    nav::ImageSize& size) {
  const auto image = engine::load_grey(path);
  if (!image) {
    return image.error();
  }
  const nav::ImageSize own{image->width_px, image->height_px};
  if (size.width_px == 0) {
    size = own;
  }
  if (!(own == size)) {
    return Error{path + ": is " + std::to_string(own.width_px) + " x " +
                 std::to_string(own.height_px) + " px, the images before are " +
                 std::to_string(size.width_px) + " x " + std::to_string(size.height_px)};
  }
  return nav::find_chessboard(*image, board);
}

Result<Views> views_in(const StereoArguments& arguments, const nav::Chessboard& board) {
  const auto left = expanded(arguments.left);
  if (!left) {
    return left.error();
  }
  const auto right = expanded(arguments.right);
  if (!right) {
    return right.error();
  }
  const auto images = paired(*left, *right);
  if (!images) {
    return images.error();
  }
  Views found;
  found.skipped = images->alone;
  CountProgress progress("pairs of images", static_cast<std::int64_t>(images->pairs.size()));
  for (const ImagePair& pair : images->pairs) {
    const auto in_left = corners_in(pair.left, board, found.size);
    if (!in_left) {
      return in_left.error();
    }
    const auto in_right = corners_in(pair.right, board, found.size);
    if (!in_right) {
      return in_right.error();
    }
    if (!*in_left) {
      found.skipped.push_back(pair.left);
    }
    if (!*in_right) {
      found.skipped.push_back(pair.right);
    }
    if (*in_left && *in_right) {
      found.views.push_back({**in_left, **in_right});
      found.pairs.push_back(pair);
    }
    progress.add_one();
  }
  return found;
}

/// Whether an image without the board shows one of a column and a row less: somebody counted
/// squares.
bool shows_one_less(const Views& views, const nav::Chessboard& board) {
  constexpr std::size_t kMaxTried = 4;
  const nav::Chessboard less{board.columns - 1, board.rows - 1, board.square_m};
  for (std::size_t i = 0; i < std::min(kMaxTried, views.skipped.size()); ++i) {
    nav::ImageSize any;
    const auto corners = corners_in(views.skipped[i], less, any);
    if (less.check().empty() && corners && *corners) {
      return true;
    }
  }
  return false;
}

/// The coefficients of the rational model have a place of their own, so that none of them is
/// overlooked.
nlohmann::ordered_json json_of(const BrownConrady& camera) {
  nlohmann::ordered_json out = {{"width_px", camera.width_px}, {"height_px", camera.height_px},
                                {"fx_px", camera.fx_px},       {"fy_px", camera.fy_px},
                                {"cx_px", camera.cx_px},       {"cy_px", camera.cy_px}};
  nlohmann::ordered_json lens = {{"k1", camera.k1},
                                 {"k2", camera.k2},
                                 {"p1", camera.p1},
                                 {"p2", camera.p2},
                                 {"k3", camera.k3}};
  if (!camera.is_rational()) {
    out.update(lens);
    return out;
  }
  lens.update({{"k4", camera.k4}, {"k5", camera.k5}, {"k6", camera.k6}});
  out["rational"] = lens;
  return out;
}

nlohmann::ordered_json json_of(const Views& views, const nav::StereoBoardCalibration& found) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < found.views.size(); ++i) {
    const nav::BoardViewResidual& view = found.views[i];
    list.push_back({{"left", views.pairs[i].left},
                    {"right", views.pairs[i].right},
                    {"used", view.used},
                    {"left_rms_px", view.left_rms_px},
                    {"right_rms_px", view.right_rms_px},
                    {"epipolar_rms_px", view.epipolar_rms_px}});
  }
  return list;
}

nlohmann::ordered_json result_json(const StereoArguments& arguments, const Views& views,
                                   const nav::StereoBoardCalibration& found) {
  nlohmann::ordered_json out = {
      {"format", "orthonav stereo calibration"},
      {"format_version", 1},
      {"source", "images"},
      {"left", json_of(found.left)},
      {"right", json_of(found.right)},
      {"right_from_left_mm", engine::rows_mm(found.right_from_left.row_major())},
      {"baseline_mm", found.baseline_m() * 1e3},
      {"left_rms_px", found.left_rms_px},
      {"right_rms_px", found.right_rms_px},
      {"stereo_rms_px", found.stereo_rms_px},
      {"epipolar_rms_px", found.epipolar_rms_px},
      {"covered_share", found.covered_fraction},
      {"chessboard", arguments.chessboard},
      {"square_mm", arguments.square_mm},
      {"views_used", found.used}};
  if (found.sigma) {
    out["sigma"] = {{"baseline_mm", found.sigma->baseline_m * 1e3},
                    {"rotation_deg", found.sigma->rotation_rad * kDegreesPerRadian},
                    {"focal_percent", found.sigma->focal_fraction * 100},
                    {"principal_point_px", found.sigma->principal_point_px}};
  }
  add_judgement(found.judgement, out);
  out["views"] = json_of(views, found);
  out["skipped"] = views.skipped;
  return out;
}

void print_camera(const char* side, const BrownConrady& c) {
  print_text(
      "%s: focal %.3f %.3f px, principal point %.3f %.3f px, k1 %.5f k2 %.5f p1 %.6f "
      "p2 %.6f k3 %.5f\n",
      side, c.fx_px, c.fy_px, c.cx_px, c.cy_px, c.k1, c.k2, c.p1, c.p2, c.k3);
  if (c.is_rational()) {
    print_text("%s, divided by: k4 %.5f k5 %.5f k6 %.5f\n", side, c.k4, c.k5, c.k6);
  }
}

void print(const Views& views, const nav::StereoBoardCalibration& found) {
  print_text("RMS: left %.3f px, right %.3f px, stereo %.3f px, across epipolar lines %.3f px\n",
             found.left_rms_px, found.right_rms_px, found.stereo_rms_px, found.epipolar_rms_px);
  print_camera("left", found.left);
  print_camera("right", found.right);
  print_text("baseline %.3f mm", found.baseline_m() * 1e3);
  if (found.sigma) {
    print_text(", known to %.3f mm; rotation known to %.3f°, focal length to %.3f %%",
               found.sigma->baseline_m * 1e3, found.sigma->rotation_rad * kDegreesPerRadian,
               found.sigma->focal_fraction * 100);
  }
  print_text("\n");
  for (std::size_t i = 0; i < found.views.size(); ++i) {
    const nav::BoardViewResidual& view = found.views[i];
    print_text("%s %s: left %.3f px, right %.3f px, epipolar %.3f px%s\n",
               views.pairs[i].left.c_str(), views.pairs[i].right.c_str(), view.left_rms_px,
               view.right_rms_px, view.epipolar_rms_px, view.used ? "" : " (left out)");
  }
  print_judgement(found.judgement);
}

}  // namespace

int run_stereo_images(const StereoArguments& arguments) {
  const auto board = board_from(arguments);
  if (!board) {
    return bad_input(board.error().message);
  }
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  const auto views = views_in(arguments, *board);
  if (!views) {
    return bad_input(views.error().message);
  }
  if (views->views.empty() && shows_one_less(*views, *board)) {
    return bad_input(
        printed("--chessboard: no board of %dx%d inner corners is seen, but one of "
                "%dx%d is: count inner corners, not squares",
                board->columns, board->rows, board->columns - 1, board->rows - 1));
  }
  for (const std::string& name : views->skipped) {
    std::fprintf(stderr, "orthonav: skipped: %s: no board of %s, or no partner\n", name.c_str(),
                 arguments.chessboard.c_str());
  }
  const auto found = nav::calibrate_stereo(*board, views->size, views->views);
  if (!found) {
    return refused(found.error().message);
  }
  if (const Status s = arguments.json.write(result_json(arguments, *views, *found)); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    print(*views, *found);
  }
  return found->judgement.verdict == nav::Verdict::kFail ? refused(found->judgement.reason) : kDone;
}

}  // namespace orthonav::tools
