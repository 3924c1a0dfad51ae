#include "engine/io/pose_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "nav/tracking/pivot.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"

namespace orthonav::engine::pose_file_test {
namespace {

using test::error_of;
using test::is_ok;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

PoseFileOptions in_mm() {
  PoseFileOptions options;
  options.metres_per_unit = 1e-3;
  return options;
}

/// At x = 10, y = -20, z = 1000 mm, turned by 90° about z.
void expect_the_pose(const Transform<World, Marker>& pose) {
  EXPECT_LT((pose.translation() - Vec3{0.01, -0.02, 1.0}).norm(), 1e-12);
  EXPECT_LT((pose.rotation().column(0) - Vec3{0, 1, 0}).norm(), 1e-6);
}

/// As Excel's "Unicode text".
std::string utf16(const std::string& ascii) {
  std::string bytes = "\xFF\xFE";
  for (const char c : ascii) {
    bytes += {c, '\0'};
  }
  return bytes;
}

class PoseFiles : public ::testing::Test {
 protected:
  Result<PoseFile> read(const std::string& text, const PoseFileOptions& options = {}) const {
    return load_poses(folder_.with("poses", text), options);
  }
  test::TemporaryFolder folder_;
};

TEST_F(PoseFiles, AreReadInEveryNotation) {
  PoseFileOptions named = in_mm();
  named.columns = {"x", "y", "z", "qx", "qy", "qz", "qw"};
  const std::vector<std::pair<std::string, PoseFileOptions>> cases = {
      {"timestamp_100ns,id,px,py,pz,qx,qy,qz,qw,origin,sigma_mm,residual_px,cameras\n"
       "10000000,3,0.01,-0.02,1,0,0,0.707106781,0.707106781,measured,0.1,0,2\n",
       {}},
      {"x_mm;y_mm;z_mm;qw;qx;qy;qz\n10;-20;1000;0.7071068;0;0;0.7071068\n", {}},
      {"\xEF\xBB\xBFx_mm;y_mm;z_mm;qw;qx;qy;qz\r\n10,0;-20;1000;0,7071068;0;0;0,7071068\r\n", {}},
      {utf16("x_mm\ty_mm\tz_mm\tqw\tqx\tqy\tqz\n10,0\t-20\t1000\t0,7071068\t0\t0\t0,7071068\n"),
       {}},
      {"10,0;-20;1000;0;0;0,7071068;0,7071068\n", named},
      {"tx\tty\ttz\tqx\tqy\tqz\tq0\r\n10\t-20\t1000\t0\t0\t0.7071068\t0.7071068\t\r\n", in_mm()},
      {" 10 -20 1000 0 0 0.7071068\t0.7071068 \n", named},
      {"m00,m01,m02,m03_m,m10,m11,m12,m13_m,m20,m21,m22,m23_m\n0,-1,0,0.01,1,0,0,-0.02,0,0,1,1\n",
       {}},
      {"0 -1 0 10 1 0 0 -20 0 0 1 1000 0 0 0 1\n", in_mm()},
      {"0 -1 0 10\n1 0 0 -20\n0 0 1 1000\n0 0 0 1\n", in_mm()},
      {"NRRD0004\ntype: uchar\nsizes: 0 0 1\nSeq_Frame0000_StylusToTrackerTransform:=0 -1 0 10 1 0 "
       "0 "
       "-20 0 0 1 1000 0 0 0 1 \nSeq_Frame0000_StylusToTrackerTransformStatus:=OK\n\nSeq_Frame0",
       {}}};
  for (const auto& [text, options] : cases) {
    const auto file = read(text, options);
    ASSERT_TRUE(is_ok(file)) << text;
    ASSERT_THAT(file->world_from_marker, SizeIs(1)) << text;
    expect_the_pose(file->world_from_marker[0]);
  }
}

constexpr const char* kNdi =
    "Tools,ToolInfo,Frame#,PortHandle,Face#,TransformStatus,Q0,Qx,Qy,Qz,Tx,Ty,Tz,Error,#Markers,"
    "Status,Tx,Ty,Tz,ToolInfo,Frame#,PortHandle,Face#,TransformStatus,Q0,Qx,Qy,Qz,Tx,Ty,Tz,Error\n"
    "2,a,7,Port:1,0,OK,0.7071,0,0,0.7071,10,-20,1000,0.1,1,OK,1,2,3,b,7,Port:2,0,Missing,,,,,,,,\n"
    "2,a,8,Port:1,0,Missing,,,,,,,,,1,OK,1,2,3,b,8,Port:2,0,OK,1,0,0,0,5,6,7,0.1\n"
    "2,a,9,Port:1,0,OK,0.7071,0,0,0.7071,10,-20,1000,0.1,1,OK,1,2,3,b,9,Port:2,0,OK,1,0,0,0,5,6,7,"
    "0.1\n";

TEST_F(PoseFiles, OfNdiHaveToolsSideBySide) {
  PoseFileOptions options;
  options.pose = "Port:1";
  options.rate_hz = 50.0;
  const auto file = read(kNdi, options);
  ASSERT_TRUE(is_ok(file));
  EXPECT_EQ(file->format, "NDI CSV");
  EXPECT_EQ(file->missing, 1u);
  EXPECT_THAT(file->times_s, ElementsAre(0.0, 0.04));
  ASSERT_THAT(file->world_from_marker, SizeIs(2));
  expect_the_pose(file->world_from_marker[1]);
  EXPECT_THAT(error_of(read(kNdi)), HasSubstr("has poses of Port:1, Port:2: name one (--pose)"));
  options.pose = "Port:3";
  EXPECT_THAT(error_of(read(kNdi, options)),
              HasSubstr("no pose is of 'Port:3' (there are: Port:1"));
}

TEST_F(PoseFiles, OfSequencesAreRelatedToOtherTransforms) {
  const std::string header =
      "ObjectType = Image\nNDims = 3\n"
      "Seq_Frame0000_ReferenceToTrackerTransform = 1 0 0 100 0 1 0 0 0 0 1 0 0 0 0 1\n"
      "Seq_Frame0000_ReferenceToTrackerTransformStatus = OK\n"
      "Seq_Frame0000_StylusToTrackerTransform = 0 -1 0 110 1 0 0 -20 0 0 1 1000 0 0 0 1\n"
      "Seq_Frame0000_StylusToTrackerTransformStatus = OK\nSeq_Frame0000_Timestamp = 2.5\n"
      "Seq_Frame0001_ReferenceToTrackerTransform = 1 0 0 100 0 1 0 0 0 0 1 0 0 0 0 1\n"
      "Seq_Frame0001_ReferenceToTrackerTransformStatus = INVALID\n"
      "Seq_Frame0001_StylusToTrackerTransform = 0 -1 0 110 1 0 0 -20 0 0 1 1000 0 0 0 1\n"
      "Seq_Frame0001_StylusToTrackerTransformStatus = OK\nSeq_Frame0001_Timestamp = 2.6\n"
      "ElementDataFile = LOCAL\n\1\2\3";
  PoseFileOptions options;
  options.pose = "StylusToReference";
  const auto file = read(header, options);
  ASSERT_TRUE(is_ok(file));
  EXPECT_EQ(file->missing, 1u);
  EXPECT_THAT(file->times_s, ElementsAre(2.5));
  ASSERT_THAT(file->world_from_marker, SizeIs(1));
  expect_the_pose(file->world_from_marker[0]);
  EXPECT_THAT(error_of(read(header)),
              HasSubstr("has ReferenceToTracker, StylusToTracker: name the tool's (--pose)"));
  options.pose = "ProbeToTracker";
  EXPECT_THAT(error_of(read(header, options)), HasSubstr("no transform is ProbeToTracker"));
}

TEST_F(PoseFiles, AreTakenByTheToolsTag) {
  const std::string text =
      "time_s,id,x_m,y_m,z_m,qx,qy,qz,qw\n1,3,0.01,-0.02,1,0,0,0.7071068,0.7071068\n"
      "1,17,0,0,0,0,0,0,1\n";
  PoseFileOptions options;
  options.tag = 3;
  const auto file = read(text, options);
  ASSERT_TRUE(is_ok(file));
  ASSERT_THAT(file->world_from_marker, SizeIs(1));
  expect_the_pose(file->world_from_marker[0]);
}

TEST_F(PoseFiles, AreRefusedInOneLineWhereSomethingIsOpen) {
  PoseFileOptions metres;
  metres.metres_per_unit = 1.0;
  PoseFileOptions with_rate = in_mm();
  with_rate.rate_hz = 10.0;
  PoseFileOptions with_columns = in_mm();
  with_columns.columns = {"x", "y"};
  struct Case {
    std::string text;
    PoseFileOptions options;
    std::string expected;
  };
  const std::vector<Case> cases = {
      {"", {}, "is empty"},
      {"x,y,z,qx,qy,qz,qw\n1,2,3,0,0,0,1\n", {}, "does not state its unit of length"},
      {"x_mm,y_mm,z_mm,qx,qy,qz,qw\n1,2,3,0,0,0,1\n", metres, "another unit is given"},
      {"x_mm,y_m,z_mm,qx,qy,qz,qw\n1,2,3,0,0,0,1\n", {}, "in mm and in m"},
      {"time_s,x,y,z,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n", with_rate, "--rate-hz has no place"},
      {"x,y,z,roll,pitch,yaw\n1,2,3,0,0,0\n", in_mm(), "do not name a position"},
      {"1 2 3 0 0 0 1\n", in_mm(), "7 columns without names, name them (--columns"},
      {"1 2 3 0 0 0 1\n", with_columns, "has 7 columns, but 2 are named"},
      {"x,y,z,qx,qy,qz,qw\n1,2,3,0,0,0,1\n1,2,3,0,0,0,2\n", in_mm(),
       "line 3: the quaternion's length is 2.0000, must be 1"},
      {"x,y,z,qx,qy,qz,qw\n1,2,nan,0,0,0,1\n", in_mm(), "line 2: 'nan' in column 3"},
      {"x,y,z,qx,qy,qz,qw\n1,2,3,0\n", in_mm(), "line 2: has 4 columns, column 5 is needed"},
      {"1 0 0 0 0 1 0 0 0 0 1 0 10 20 30 1\n", in_mm(), "last row of the matrix is not 0 0 0 1"},
      {"1 0 0 0 0 1 0 0 0 0 2 0 0 0 0 1\n", in_mm(), "line 1: transform is not rigid"},
      {"1 0 0 0\n0 1 0 0\n", in_mm(), "ends within a matrix"},
      {"time_s,x,y,z,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n1e300,1,2,3,0,0,0,1\n", in_mm(),
       "times are more than 1000000 s apart"},
      {"ObjectType = Image\nSeq_Frame1e99_AToBTransform = 1 0\n",
       {},
       "line 2: a field of no frame"},
      {"x,y,z,qx,qy,qz,qw\n1e9,2,3,0,0,0,1\n", in_mm(), "line 2: 1e+06 m away, limit 1000 m"},
      {"MATLAB 5.0 MAT-file, Platform: GLNXA64", {}, "a MATLAB file is not read"},
      {std::string("\x89PNG\0\0", 6), {}, "is neither text nor a sequence"},
      {"ObjectType = Image\nElementDataFile = LOCAL\n", {}, "a sequence without transforms"},
      {"ObjectType = Image\nSeq_Frame0000_AToBTransform = 1 0\n",
       {},
       "line 2: AToBTransform has 2"},
      {"ObjectType = Image\nSeq_Frame0000_AToBTransform = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"
       "Seq_Frame0000_AToBTransformStatus = INVALID\n",
       {},
       "no pose in it was measured"},
  };
  for (const Case& c : cases) {
    const std::string message = error_of(read(c.text, c.options));
    EXPECT_THAT(message, HasSubstr(c.expected)) << c.text;
    EXPECT_THAT(message, HasSubstr(folder_.file("poses")));
  }
  EXPECT_THAT(error_of(load_poses(folder_.file("none"))), HasSubstr("cannot be opened"));
}

// Repeated pivots of one tool by others' trackers: their tips differ as the pivots state.

Mat3 inverse(const Mat3& m) {
  const Vec3 a = m.row(0);
  const Vec3 b = m.row(1);
  const Vec3 c = m.row(2);
  const double scale = 1.0 / m.determinant();
  return Mat3::from_columns(scale * b.cross(c), scale * c.cross(a), scale * a.cross(b));
}

/// Of the tips about their weighted mean: three degrees of freedom for each pivot but one.
double chi_square(const std::vector<std::vector<Transform<World, Marker>>>& pivots) {
  nav::PivotOptions options;
  options.max_tip_sigma_m = 0.002;          // six seconds each tell no more
  std::vector<std::pair<Vec3, Mat3>> tips;  ///< and inverse covariance
  Mat3 weights{};
  Vec3 weighted;
  for (const auto& poses : pivots) {
    const auto found = nav::pivot_calibration(poses, options);
    EXPECT_TRUE(is_ok(found));
    if (!found) {
      continue;
    }
    tips.emplace_back(found->tip_in_marker.v, inverse(found->tip_covariance_m2));
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        weights[r][c] += tips.back().second[r][c];
      }
    }
    weighted += tips.back().second * tips.back().first;
  }
  const Vec3 mean = inverse(weights) * weighted;
  double sum = 0.0;
  for (const auto& [tip, weight] : tips) {
    sum += (tip - mean).dot(weight * (tip - mean));
  }
  return sum;
}

std::vector<Transform<World, Marker>> part(const PoseFile& file, std::size_t from, std::size_t to) {
  const auto at = [&](std::size_t i) {
    return file.world_from_marker.begin() + static_cast<std::ptrdiff_t>(i);
  };
  return {at(from), at(to)};
}

TEST(PivotsByOthers, OfAnElectromagneticTrackerDifferAsStated) {
  const auto path = test::test_data(
      "real/pluslibdata-eight-landmarks/"
      "EightLandmarkPointsTrackedForPhantomRegistration.igs.mha");
  if (!std::filesystem::exists(path)) {
    GTEST_SKIP() << "needs shared/real";
  }
  // The frames in which the stylus turned in each landmark.
  constexpr std::pair<std::size_t, std::size_t> kTurning[] = {{88, 165},  {176, 254}, {272, 356},
                                                              {363, 452}, {528, 612}, {624, 712},
                                                              {728, 820}, {834, 922}};
  for (const char* frame : {"StylusToTracker", "StylusToReference"}) {
    PoseFileOptions options;
    options.pose = frame;
    const auto file = load_poses(path, options);
    ASSERT_TRUE(is_ok(file));
    ASSERT_THAT(file->world_from_marker, SizeIs(1000));
    std::vector<std::vector<Transform<World, Marker>>> pivots;
    for (const auto& [from, to] : kTurning) {
      pivots.push_back(part(*file, from, to));
    }
    // 95 % of chi-square with 21 degrees of freedom.
    EXPECT_LT(chi_square(pivots), 32.7) << frame;
  }
}

PoseFileOptions of_zivy() {
  PoseFileOptions options;
  options.metres_per_unit = 1e-3;
  options.columns = {"x", "y", "z", "qx", "qy", "qz", "qw"};
  return options;
}

TEST(PivotsByOthers, OfAnOpticalTrackerDifferAsStated) {
  const auto folder = test::test_data("real/zivy-lsqrrecipes-pivot");
  if (!std::filesystem::exists(folder)) {
    GTEST_SKIP() << "needs shared/real";
  }
  const auto clean = load_poses(folder / "pivotCalibrationData.txt", of_zivy());
  const auto spoilt = load_poses(folder / "pivotCalibrationDataWithOutliers.txt", of_zivy());
  ASSERT_TRUE(is_ok(clean));
  ASSERT_TRUE(is_ok(spoilt));
  ASSERT_THAT(clean->world_from_marker, SizeIs(481));
  const auto whole = nav::pivot_calibration(clean->world_from_marker);
  ASSERT_TRUE(is_ok(whole));
  // Least squares by those who published the poses.
  constexpr double kSameM = 0.00005;
  EXPECT_LT((whole->tip_in_marker.v - Vec3{-0.01778, 0.00111, -0.15687}).norm(), kSameM);

  std::vector<std::vector<Transform<World, Marker>>> sixths;
  for (std::size_t i = 0; i < 6; ++i) {
    sixths.push_back(part(*clean, 80 * i, 80 * (i + 1)));
  }
  // 95 % of chi-square with 15 and with 3 degrees of freedom.
  EXPECT_LT(chi_square(sixths), 25.0);
  EXPECT_LT(chi_square({clean->world_from_marker, spoilt->world_from_marker}), 7.8);

  // The last 144 poses of the second recording are no pivoting.
  const auto robust = nav::pivot_calibration(spoilt->world_from_marker);
  const auto without = nav::pivot_calibration(part(*spoilt, 0, 336));
  ASSERT_TRUE(is_ok(robust));
  ASSERT_TRUE(is_ok(without));
  EXPECT_LT((robust->tip_in_marker - without->tip_in_marker).norm(), kSameM);
}

}  // namespace
}  // namespace orthonav::engine::pose_file_test
