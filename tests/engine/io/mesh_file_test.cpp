#include "engine/io/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/test_data.h"
#include "tests/support/test_meshes.h"

namespace orthonav::engine {
namespace {

using orthonav::test::content_of;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kMm = 1e-3;
/// Files hold single precision: half a unit in the last place at 40 mm is 2 nm.
constexpr double kFileDigits_m = 5e-9;

std::string refusal(const std::string& path, double metres_per_unit = kMm) {
  const auto mesh = load_mesh(path, metres_per_unit);
  EXPECT_FALSE(mesh.ok());
  const std::string message = mesh.ok() ? "" : mesh.error().message;
  EXPECT_THAT(message, HasSubstr(path));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

/// The box in ascii, millimetres; `vertices` is the number that its header states.
std::string ply_box(const std::string& vertices) {
  std::string ply = "ply\nformat ascii 1.0\nelement vertex " + vertices +
                    "\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face 12\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& v : box_mesh().vertices_m) {
    ply += std::to_string(v.x / kMm) + " " + std::to_string(v.y / kMm) + " " +
           std::to_string(v.z / kMm) + "\n";
  }
  for (const auto& t : box_mesh().triangles) {
    ply += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) +
           "\n";
  }
  return ply;
}

TEST(MeshFile, LeavesIslandsAndCavitiesOutAndSaysSo) {
  const TemporaryFolder folder;
  // A box of 60 mm, a hollow of 10 mm in it, a crumb of 5 mm far to the right, and an open sheet.
  std::string obj;
  int first = 1;
  const auto box = [&](double size, double x, bool inward) {
    for (int corner = 0; corner < 8; ++corner) {
      obj += "v " + std::to_string(x + ((corner & 1) != 0 ? size : 0)) + " " +
             std::to_string((corner & 2) != 0 ? size : 0) + " " +
             std::to_string((corner & 4) != 0 ? size : 0) + "\n";
    }
    for (const std::array<int, 4>& f : std::vector<std::array<int, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
      obj += "f";
      for (std::size_t i = 0; i < 4; ++i) {
        obj += " " + std::to_string(first + f[inward ? 3 - i : i]);
      }
      obj += "\n";
    }
    first += 8;
  };
  box(5, 200, false);
  box(60, 0, false);
  box(10, 20, true);
  obj += "v -300 0 0\nv -300 400 0\nv -300 0 400\nf 25 26 27\n";
  std::string note;
  const auto mesh = load_mesh(folder.with("bone.obj", obj), kMm, Axes::kLps, &note);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_NEAR(nav::bounds_of(*mesh).centre().x, 0.030, 1e-9) << "the midline is the bone's";
  EXPECT_NEAR(nav::solid_of(*mesh).volume_m3, 0.06 * 0.06 * 0.06, 1e-9);
  EXPECT_THAT(note, HasSubstr("bone.obj: 3 parts apart from the bone were left out"));
}

TEST(MeshFile, WeldsTheCornersOfAnStl) {
  const TemporaryFolder folder;
  ASSERT_TRUE(save_stl(folder.file("box.stl"), box_mesh()).ok());
  const auto mesh = load_mesh(folder.file("box.stl"), kMm);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->vertices_m.size(), 8u) << "36 corners of 12 triangles";
  EXPECT_EQ(mesh->triangles.size(), 12u);
  EXPECT_NEAR(volume_m3(*mesh), 0.08 * 0.06 * 0.04, 1e-10);
}

TEST(MeshFile, ReadsObjAndPlyInTheUnitGiven) {
  const TemporaryFolder folder;
  const std::string obj = folder.with("box.obj", as_obj(box_mesh(), 1.0));
  const auto in_metres = load_mesh(obj, 1.0);
  ASSERT_TRUE(in_metres.ok()) << in_metres.error().message;
  EXPECT_NEAR(volume_m3(*in_metres), 0.08 * 0.06 * 0.04, 1e-9);

  const auto from_ply = load_mesh(folder.with("box.PLY", ply_box("8")), kMm);
  ASSERT_TRUE(from_ply.ok()) << from_ply.error().message;
  EXPECT_NEAR(volume_m3(*from_ply), 0.08 * 0.06 * 0.04, 1e-9);
}

TEST(MeshFile, TurnsRasHalfRoundWithoutMirroring) {
  nav::TriangleMesh box = box_mesh();
  for (Vec3& v : box.vertices_m) {
    v += Vec3{0.010, 0.020, 0.030};
  }
  const TemporaryFolder folder;
  const std::string path = folder.with("box.obj", as_obj(box, 1000.0));
  const auto lps = load_mesh(path, kMm, Axes::kLps);
  const auto ras = load_mesh(path, kMm, Axes::kRas);
  ASSERT_TRUE(lps.ok() && ras.ok());
  ASSERT_EQ(lps->vertices_m.size(), ras->vertices_m.size());
  EXPECT_GT(volume_m3(*ras), 0.0) << "still outward";
  Vec3 lps_sum;
  Vec3 ras_sum;
  for (const Vec3& v : lps->vertices_m) {
    lps_sum += v / 8.0;
  }
  for (const Vec3& v : ras->vertices_m) {
    ras_sum += v / 8.0;
  }
  EXPECT_LT((lps_sum - Vec3{0.010, 0.020, 0.030}).norm(), kFileDigits_m);
  EXPECT_LT((ras_sum - Vec3{-0.010, -0.020, 0.030}).norm(), kFileDigits_m);
}

TEST(MeshFile, BelievesTheAxesThatTheFileDeclares) {
  nav::TriangleMesh box = box_mesh();
  for (Vec3& v : box.vertices_m) {
    v += Vec3{0.010, 0, 0};
  }
  const TemporaryFolder folder;
  ASSERT_TRUE(save_stl(folder.file("box.stl"), box).ok());
  const auto mesh = load_mesh(folder.file("box.stl"), kMm, Axes::kRas);
  ASSERT_TRUE(mesh.ok());
  Vec3 sum;
  for (const Vec3& v : mesh->vertices_m) {
    sum += v / 8.0;
  }
  EXPECT_LT((sum - Vec3{0.010, 0, 0}).norm(), kFileDigits_m) << "SPACE=LPS stands in the header";
}

TEST(MeshFile, RefusesAxesThatItDoesNotKnow) {
  const TemporaryFolder folder;
  const auto obj = [&](const std::string& remark) {
    return folder.with("box.obj", "# " + remark + "\n" + as_obj(box_mesh(), 1e3));
  };
  const auto lis = load_mesh(obj("SPACE=LIS"), kMm);
  ASSERT_FALSE(lis.ok());
  EXPECT_THAT(lis.error().message, HasSubstr("box.obj: SPACE is \"LIS\", must be LPS or RAS"));
  EXPECT_FALSE(load_mesh(obj("SPACE=RASX"), kMm).ok());
  EXPECT_FALSE(load_mesh(obj("SPACE="), kMm).ok());
  EXPECT_TRUE(load_mesh(obj("SPACE=RAS;UNIT=mm"), kMm).ok());
  EXPECT_TRUE(load_mesh(obj("COLORSPACE=sRGB"), kMm).ok()) << "a word of its own";
}

/// Opening the pipe would block for ever.
TEST(MeshFile, OpensNoOtherFileThatAnObjNames) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.file("colours.mtl").c_str(), 0600), 0);
  const std::string text = "mtllib colours.mtl\n" + as_obj(box_mesh(), 1000.0);
  const auto mesh = load_mesh(folder.with("box.obj", text), kMm);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->triangles.size(), 12u);
}

TEST(MeshFile, ReadsEveryRealVertebra) {
  const auto mesh = load_mesh(test::test_data("anatomy/visible-human/L4.stl").string(), kMm);
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh->triangles.size(), 8738u);
  // A closed surface of genus 1: V - E + F = 0 with E = 3F/2.
  EXPECT_EQ(mesh->vertices_m.size() * 2, mesh->triangles.size());
}

TEST(MeshFile, RefusesMetresTakenForMillimetres) {
  const TemporaryFolder folder;
  const std::string in_metres = folder.with("m.obj", as_obj(box_mesh(), 1.0));
  EXPECT_THAT(refusal(in_metres, kMm), HasSubstr("mm"));
  const std::string in_mm = folder.with("mm.obj", as_obj(box_mesh(), 1000.0));
  EXPECT_THAT(refusal(in_mm, 1.0), HasSubstr("mm"));
}

TEST(MeshFile, RefusesAnOpenSurface) {
  nav::TriangleMesh open = box_mesh();
  open.triangles.pop_back();
  const TemporaryFolder folder;
  refusal(folder.with("open.obj", as_obj(open, 1000.0)));
}

TEST(MeshFile, RefusesVerticesThatAreNotFinite) {
  std::string text = as_obj(box_mesh(), 1000.0);
  text.replace(text.find("v "), text.find('\n', text.find("v ")) - text.find("v "), "v nan 0 0");
  const TemporaryFolder folder;
  refusal(folder.with("nan.obj", text));
}

TEST(MeshFile, RefusesWhatIsNoMesh) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.file("none.stl")), HasSubstr("cannot be opened"));
  EXPECT_EQ(load_mesh(folder.file("none.stl"), kMm).error().code, ErrorCode::kNotFound);
  EXPECT_THAT(refusal(folder.path().string()), HasSubstr("is a folder"));
  EXPECT_THAT(refusal(folder.with("empty.stl", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(folder.with("mesh.txt", "solid")), HasSubstr("STL, PLY or OBJ"));
  refusal(folder.with("noise.stl", std::string(500, 'x')));
  refusal(folder.with("noise.ply", std::string(500, 'x')));
  refusal(folder.with("no_faces.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"));
  refusal(folder.with("bad_index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"));
}

/// assimp's reader never returned from half of these and crashed over others.
TEST(MeshFile, RefusesEveryTruncationOfAPly) {
  const TemporaryFolder folder;
  const std::string whole = ply_box("8");
  for (std::size_t size = 0; size + 2 < whole.size(); size += 3) {
    refusal(folder.with("cut.ply", whole.substr(0, size)));
  }
}

TEST(MeshFile, RefusesAPlyWhoseFacesAreNotOfItsVertices) {
  const TemporaryFolder folder;
  EXPECT_THAT(refusal(folder.with("few.ply", ply_box("7"))), HasSubstr("face 0"));
  std::string ply = ply_box("8");
  const std::size_t last = ply.rfind(' ');
  EXPECT_THAT(refusal(folder.with("no_vertex.ply", ply.replace(last, std::string::npos, " 8\n"))),
              HasSubstr("face 11 names a vertex that is not there"));
  EXPECT_THAT(refusal(folder.with("negative.ply", ply.replace(last, std::string::npos, " -1\n"))),
              HasSubstr("face 11 names a vertex that is not there"));
}

TEST(MeshFile, RefusesEveryTruncationOfAnStl) {
  const TemporaryFolder folder;
  ASSERT_TRUE(save_stl(folder.file("box.stl"), box_mesh()).ok());
  const std::string whole = content_of(folder.file("box.stl"));
  ASSERT_EQ(whole.size(), 84u + 12u * 50u);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    refusal(folder.with("cut.stl", whole.substr(0, size)));
  }
}

}  // namespace
}  // namespace orthonav::engine
