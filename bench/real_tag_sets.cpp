#include "bench/real_tag_sets.h"

#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <opencv2/calib3d.hpp>

#include "engine/io/grey_image_file.h"
#include "engine/io/text_fields.h"

namespace orthonav::bench {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const char* name) { return fs::path(ORTHONAV_SHARED_DIR) / "real" / name; }

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> all;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string kind = entry.path().extension();
    if (kind == ".png" || kind == ".jpg") {
      all.push_back(entry.path());
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

GreyImage picture(const fs::path& path) {
  auto image = engine::load_grey(path.string());
  if (!image) {
    std::fprintf(stderr, "%s\n", image.error().message.c_str());
    std::exit(2);
  }
  return std::move(*image);
}

GreyImage part(const GreyImage& whole, int from_px, int width_px) {
  GreyImage out;
  out.width_px = width_px;
  out.height_px = whole.height_px;
  for (int row = 0; row < whole.height_px; ++row) {
    const auto begin = whole.pixels.begin() + row * whole.width_px + from_px;
    out.pixels.insert(out.pixels.end(), begin, begin + width_px);
  }
  return out;
}

GreyImage grey_like(const GreyImage& image) {
  GreyImage out = image;
  std::fill(out.pixels.begin(), out.pixels.end(), std::uint8_t{128});
  return out;
}

CameraModel model_of(const BrownConrady& lens) {
  return CameraModel::from_brown_conrady(lens).value();
}

/// Mean distance of tags that are neighbours in a row, over that of the board's.
double measured_scale(const BoardPictures& set) {
  const auto poses =
      poses_by_corners(set, corners_in(set, corner_methods(set.board.family).front().find));
  double sum = 0.0;
  double count = 0.0;
  for (const TagPoses& frame : poses) {
    for (const auto& [id, pose] : frame) {
      const auto next = frame.find(id + 1);
      if ((id + 1) % set.board.columns != 0 && next != frame.end()) {
        sum += (next->second.translation() - pose.translation()).norm();
        count += 1.0;
      }
    }
  }
  return sum / count / set.board.pitch_m;
}

struct Row {
  double time_s = 0.0;
  Transform<World, Marker> pose;
};

/// timestamp [ns],x,y,z,qx,qy,qz,qw
std::vector<Row> motion_capture(const fs::path& path) {
  std::vector<Row> rows;
  gzFile file = gzopen(path.c_str(), "rb");
  char line[512];
  while (file != nullptr && gzgets(file, line, sizeof line) != nullptr) {
    const auto fields = engine::split(std::string_view(line, std::strcspn(line, "\n")), ',');
    std::vector<double> n;
    for (const std::string& field : fields) {
      if (const auto number = engine::number_from(field)) {
        n.push_back(*number);
      }
    }
    if (n.size() == 8) {
      rows.push_back(
          {n[0] * 1e-9, {rotation_from_quaternion({n[4], n[5], n[6], n[7]}), {n[1], n[2], n[3]}}});
    }
  }
  if (file != nullptr) {
    gzclose(file);
  }
  if (rows.size() < 2) {
    std::fprintf(stderr, "%s: no poses\n", path.c_str());
    std::exit(2);
  }
  return rows;
}

/// Between the two rows around this time.
Transform<World, Marker> at(const std::vector<Row>& rows, double time_s) {
  auto after = std::lower_bound(rows.begin() + 1, rows.end() - 1, time_s,
                                [](const Row& row, double t) { return row.time_s < t; });
  const Row& a = *(after - 1);
  const Row& b = *after;
  const double part = (time_s - a.time_s) / (b.time_s - a.time_s);
  const Vec3 turn = vector_from_rotation(b.pose.rotation() * a.pose.rotation().transposed());
  return {rotation_from_vector(part * turn) * a.pose.rotation(),
          a.pose.translation() + part * (b.pose.translation() - a.pose.translation())};
}

/// The lens that fits all corners best (Brown-Conrady with two radial terms, as the data's own).
BrownConrady fitted_lens(const TagBoard& board, const std::vector<TagsSeen>& seen, int width_px,
                         int height_px) {
  std::vector<std::vector<cv::Point3f>> object;
  std::vector<std::vector<cv::Point2f>> image;
  const auto in_tag = nav::corners_in_marker(board.tag_m);
  for (const TagsSeen& frame : seen) {
    if (frame.size() < 8) {
      continue;
    }
    object.emplace_back();
    image.emplace_back();
    for (const auto& [id, corners] : frame) {
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 p = board.centre_m(id) + in_tag[k];
        object.back().emplace_back(static_cast<float>(p.x), static_cast<float>(p.y), 0.0F);
        image.back().emplace_back(static_cast<float>(corners[k].x - 0.5),
                                  static_cast<float>(corners[k].y - 0.5));
      }
    }
  }
  cv::Mat matrix, d, r, t;
  const double rms_px =
      cv::calibrateCamera(object, image, {width_px, height_px}, matrix, d, r, t, cv::CALIB_FIX_K3);
  std::printf("Lens fitted to %zu pictures, RMS %.2f px.\n\n", image.size(), rms_px);
  const auto* k = d.ptr<double>();
  return {width_px,
          height_px,
          matrix.at<double>(0, 0),
          matrix.at<double>(1, 1),
          matrix.at<double>(0, 2) + 0.5,
          matrix.at<double>(1, 2) + 0.5,
          k[0],
          k[1],
          k[2],
          k[3]};
}

StereoFrame frame_of_one(GreyImage image) {
  StereoFrame frame;
  frame.world_from_rig.emplace();
  frame.right = grey_like(image);
  frame.left = std::move(image);
  return frame;
}

}  // namespace

std::optional<BoardPictures> stereo_pairs() {
  const fs::path folder = folder_of("moms-apriltag-stereo");
  if (!fs::exists(folder)) {
    return std::nullopt;
  }
  BoardPictures set;
  set.board = {"tag36h10", 0.019, 5, 4, 1.25 * 0.019, false};
  set.stereo = true;
  // stereo_calibration.yml beside the pictures, of OpenCV: its first pixel's centre is at 0.
  set.calibration.left =
      model_of({1280, 720, 1044.5236451290393, 1044.2801055597943, 621.5902017931837,
                370.15585401660445, 0.10809264716410431, -0.5305293257113939, 0.0006731260548910308,
                0.00042847809229870583, 0.626574475672984});
  set.calibration.right =
      model_of({1280, 720, 1043.0122035287404, 1043.0250067825048, 626.9776216675244,
                369.4329990521149, 0.10762957192373761, -0.5400135694972634, 0.0014543130841707021,
                -0.003082294347815281, 0.6809680599996282});
  Mat3 rotation;
  rotation[0] = {0.9999979346530108, 0.001410711591520548, -0.0014630729709468374};
  rotation[1] = {-0.0014118028381422663, 0.9999987258223323, -0.0007450949322743513};
  rotation[2] = {0.0014620199926742056, 0.0007471589639675356, 0.9999986521246035};
  set.calibration.right_from_rig =
      Transform<RightCamera, Rig>::checked(
          rotation, {-0.03161597528765391, -0.0002484641985773174, 0.0002006925472451905})
          .value();
  for (const fs::path& path : pictures_in(folder)) {
    const GreyImage both = picture(path);
    StereoFrame frame;
    frame.world_from_rig.emplace();
    frame.left = part(both, 0, both.width_px / 2);
    frame.right = part(both, both.width_px / 2, both.width_px / 2);
    set.frames.push_back(std::move(frame));
  }
  set.board.scale(measured_scale(set));
  return set;
}

std::optional<CapturedPictures> captured_pictures() {
  const fs::path folder = folder_of("chutsu-yac-mocap-aprilgrid");
  if (!fs::exists(folder)) {
    return std::nullopt;
  }
  CapturedPictures out;
  BoardPictures& set = out.pictures;
  set.board = {"tag36h11b2", 0.088, 6, 6, 1.3 * 0.088, true};
  const std::vector<Row> body = motion_capture(folder / "body0/data.csv.gz");
  const std::vector<Row> target = motion_capture(folder / "target0/data.csv.gz");
  std::vector<TagsSeen> seen;
  const FindTags find = corner_methods(set.board.family).front().find;
  for (const fs::path& path : pictures_in(folder / "cam0/data")) {
    set.frames.push_back(frame_of_one(picture(path)));
    seen.push_back(find(set.frames.back().left));
    out.world_from_body.push_back(at(body, std::stod(path.stem()) * 1e-9));
  }
  const auto& middle = target[target.size() / 2].pose;
  out.world_from_target = {middle.rotation(), middle.translation()};
  const GreyImage& first = set.frames.front().left;
  set.calibration =
      calibration_of_one(model_of(fitted_lens(set.board, seen, first.width_px, first.height_px)));
  return out;
}

std::optional<TurnedTag> turned_tag() {
  const fs::path folder = folder_of("duckietown-rotation");
  if (!fs::exists(folder)) {
    return std::nullopt;
  }
  TurnedTag out;
  out.id = 76;
  BoardPictures& set = out.pictures;
  set.board = {"tag36h11", 0.065, out.id + 1, 1, 0.1, true};
  // test_info.yaml beside the pictures.
  set.calibration = calibration_of_one(
      model_of({1056, 792, 329.8729619143081, 332.94611303946357, 528.5, 396.5}));
  for (const fs::path& path : pictures_in(folder)) {
    const std::string name = path.stem();
    out.turned_deg.push_back(std::stod(name.substr(name.rfind('_') + 1)));
    set.frames.push_back(frame_of_one(picture(path)));
  }
  return out;
}

}  // namespace orthonav::bench
