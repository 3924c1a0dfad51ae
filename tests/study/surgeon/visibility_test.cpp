#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <set>

#include "hal/sim/cameras/hololens2.h"
#include "hal/sim/cameras/room_renderer.h"
#include "tests/study/surgeon/fake_engine.h"

namespace orthonav::sim {
namespace {

/// Ids of the tags that an ordinary detector finds in an image.
class TagFinder {
 public:
  TagFinder() : family_(tag36h11_create()), detector_(apriltag_detector_create()) {
    apriltag_detector_add_family(detector_, family_);
    detector_->quad_decimate = 1.0F;
  }
  ~TagFinder() {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }
  TagFinder(const TagFinder&) = delete;
  TagFinder& operator=(const TagFinder&) = delete;

  std::set<int> find(GreyImage& image) {
    image_u8_t view{image.width_px, image.height_px, image.width_px, image.pixels.data()};
    zarray_t* found = apriltag_detector_detect(detector_, &view);
    std::set<int> ids;
    for (int i = 0; i < zarray_size(found); ++i) {
      apriltag_detection_t* detection = nullptr;
      zarray_get(found, i, static_cast<void*>(&detection));
      ids.insert(detection->id);
    }
    apriltag_detections_destroy(found);
    return ids;
  }

 private:
  apriltag_family_t* family_;
  apriltag_detector_t* detector_;
};

void write_pgm(const GreyImage& image, const std::string& path) {
  std::ofstream file(path, std::ios::binary);
  file << "P5 " << image.width_px << ' ' << image.height_px << " 255\n";
  file.write(reinterpret_cast<const char*>(image.pixels.data()),
             static_cast<std::streamsize>(image.pixels.size()));
}

struct Count {
  int seen = 0;
  int looked = 0;
  [[nodiscard]] double fraction() const { return looked > 0 ? 1.0 * seen / looked : 0.0; }
};

/// Renders a moment every now and then of an operation and counts how often both cameras' images
/// show the tag of the tool that the step is done with.
std::map<std::string, Count> count_tags(const TestCase& test_case, std::uint64_t seed) {
  SimOptions options;
  options.seed = seed;
  options.surgeon = ScriptedSurgeon::bring;
  options.render = false;
  auto headset = SimHeadset::open(test_case.room, options);
  EXPECT_TRUE(headset.ok());
  FakeEngine engine(**headset, test_case);
  const StereoCalibration cameras = hololens2_calibration();
  const auto renderer = RoomRenderer::create(test_case.room, options.error_model);
  TagFinder finder;
  GreyImage image;
  std::map<std::string, Count> counts;
  StepOnDisplay last;
  int in_step = 0;
  const char* dump = std::getenv("ORTHONAV_DUMP");
  engine.on_frame = [&](const StereoFrame& frame, const StepOnDisplay& at) {
    in_step = at == last ? in_step + 1 : 0;
    last = at;
    // Three seconds pass before a tool that was swapped is in use.
    const bool digitizes = at.step == Step::kDigitize;
    const bool used = digitizes || at.step == Step::kGuide;
    const int every = digitizes ? 240 : 60;
    if (!used || in_step < 150 || in_step % every != 0) {
      return;
    }
    const RoomState state = (*headset)->state();
    const int id = digitizes ? 3 : 5;
    renderer->render({&state, 1}, cameras.left, cameras.left_from_rig,
                     static_cast<std::uint64_t>(frame.sequence), image);
    const bool left = finder.find(image).contains(id);
    if (dump) {
      write_pgm(image, std::string(dump) + "/" + std::to_string(frame.sequence) + ".pgm");
    }
    renderer->render({&state, 1}, cameras.right,
                     {cameras.right_from_rig.rotation(), cameras.right_from_rig.translation()},
                     static_cast<std::uint64_t>(frame.sequence) + 1, image);
    const bool right = finder.find(image).contains(id);
    const std::string step = name_of(at);
    Count& count = counts[step];
    ++count.looked;
    if (left && right) {
      ++count.seen;
    }
    if (dump && !(left && right)) {
      std::printf("missed %s at %d\n", step.c_str(), static_cast<int>(frame.sequence));
    }
  };
  EXPECT_GT(engine.run(), 0);
  return counts;
}

TEST(Visibility, SurgeonKeepsTheTagInUseInBothImages) {
  const auto test_case = visible_human_case({"L4"});
  if (!test_case) {
    GTEST_SKIP() << "needs tests/data/anatomy";
  }
  const auto counts = count_tags(*test_case, 1);
  ASSERT_EQ(counts.size(), 3U) << "a digitization and two screws";
  for (const auto& [step, count] : counts) {
    std::printf("%s: %d of %d\n", step.c_str(), count.seen, count.looked);
    EXPECT_GT(count.fraction(), 0.95) << step;
  }
}

}  // namespace
}  // namespace orthonav::sim
