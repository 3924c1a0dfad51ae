#include "tests/support/sample_recording.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace orthonav::test {
namespace {

// FILETIME ticks in nanoseconds do not fit into 64 bits: the sample's clock starts near its start.
constexpr std::int64_t kEpochTicks = 132'000'000'000'000'000 - 10'000'000;

const std::string kFolder = std::string(ORTHONAV_SHARED_DIR) + "/recordings/streamrecorder-sample/";

std::string contents(const std::string& name) {
  std::ifstream file(kFolder + name, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<double> numbers(std::string line) {
  for (char& c : line) {
    if (c == ',') {
      c = ' ';
    }
  }
  std::istringstream text(line);
  std::vector<double> values;
  for (double v = 0.0; text >> v;) {
    values.push_back(v);
  }
  return values;
}

template <class A, class B>
Transform<A, B> transform(const double* v) {
  std::array<double, 16> a;
  std::copy(v, v + 16, a.begin());
  return Transform<A, B>::from_row_major(a).value();
}

CameraModel camera(const std::string& name) {
  const std::string bytes = contents(name);
  std::vector<Vec2> table(640 * 480);
  for (std::size_t i = 0; i < table.size(); ++i) {
    std::array<float, 3> ray;
    std::memcpy(ray.data(), bytes.data() + 12 * i, 12);
    table[i] = {static_cast<double>(ray[0]) / static_cast<double>(ray[2]),
                static_cast<double>(ray[1]) / static_cast<double>(ray[2])};
  }
  return CameraModel::from_lookup(640, 480, std::move(table)).value();
}

std::map<std::int64_t, GreyImage> images(const std::string& name) {
  const std::string tar = contents(name);
  std::map<std::int64_t, GreyImage> found;
  for (std::size_t at = 0; at + 512 <= tar.size() && tar[at] != 0;) {
    const std::size_t size = std::stoull(tar.substr(at + 124, 11), nullptr, 8);
    GreyImage image(640, 480);
    const char* pixels = tar.data() + at + 512 + size - image.pixels.size();
    std::copy(pixels, pixels + image.pixels.size(), reinterpret_cast<char*>(image.pixels.data()));
    found.emplace(std::stoll(tar.substr(at, 100)), std::move(image));
    at += 512 + (size + 511) / 512 * 512;
  }
  return found;
}

std::vector<TruthRow> truth_rows() {
  std::istringstream text(contents("truth.csv"));
  std::vector<TruthRow> rows;
  std::string line;
  std::getline(text, line);
  while (std::getline(text, line)) {
    const std::vector<double> v = numbers(line);
    rows.push_back({from_ticks_100ns(std::stoll(line) - kEpochTicks),
                    static_cast<int>(v[1]),
                    {rotation_from_quaternion({v[5], v[6], v[7], v[8]}), {v[2], v[3], v[4]}},
                    v[9] != 0.0});
  }
  return rows;
}

std::vector<nav::ToolGeometry> sample_tools() {
  nav::ToolGeometry pointer{"pointer", nav::ToolRole::kPointer, {"tag36h11", 3, 0.04}, {}, {}};
  pointer.tip_in_marker = {{0.0, -0.15, 0.0}};
  pointer.axis_in_marker = {{0.0, 1.0, 0.0}};
  nav::ToolGeometry patient{"patient", nav::ToolRole::kReference, {"tag36h11", 17, 0.04}, {}, {}};
  patient.axis_in_marker = {{0.0, 1.0, 0.0}};
  return {pointer, patient};
}

}  // namespace

const TruthRow* SampleRecording::find(Timestamp time, int id) const {
  for (const TruthRow& row : truth) {
    if (row.time == time && row.id == id) {
      return &row;
    }
  }
  return nullptr;
}

std::optional<SampleRecording> load_sample() {
  if (!std::filesystem::exists(kFolder + "truth.csv")) {
    return std::nullopt;
  }
  SampleRecording sample;
  sample.calibration = {
      camera("VLC LF_lut.bin"), camera("VLC RF_lut.bin"),
      transform<LeftCamera, Rig>(numbers(contents("VLC LF_extrinsics.txt")).data()),
      transform<RightCamera, Rig>(numbers(contents("VLC RF_extrinsics.txt")).data())};
  auto left = images("VLC LF.tar");
  auto right = images("VLC RF.tar");
  std::istringstream poses(contents("VLC LF_rig2world.txt"));
  for (std::string line; std::getline(poses, line);) {
    const std::int64_t ticks = std::stoll(line);
    StereoFrame frame;
    frame.sequence = static_cast<std::int64_t>(sample.frames.size());
    frame.time = from_ticks_100ns(ticks - kEpochTicks);
    frame.left = left.at(ticks);
    frame.right = right.at(ticks);
    frame.world_from_rig = transform<World, Rig>(numbers(line).data() + 1);
    sample.frames.push_back(std::move(frame));
  }
  sample.truth = truth_rows();
  sample.tools = sample_tools();
  return sample;
}

}  // namespace orthonav::test
