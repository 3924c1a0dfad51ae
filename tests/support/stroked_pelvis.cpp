#include "tests/support/stroked_pelvis.h"

#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "tests/support/test_data.h"

namespace orthonav::test {
namespace {

constexpr double kMm = 1e-3;

std::string unpacked(const std::filesystem::path& path) {
  std::string out;
  std::string part(1 << 16, '\0');
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) {
    return out;
  }
  for (int read = 0; (read = gzread(file, part.data(), static_cast<unsigned>(part.size()))) > 0;) {
    out.append(part, 0, static_cast<std::size_t>(read));
  }
  gzclose(file);
  return out;
}

/// Three numbers a point; the files separate them by spaces or commas.
std::vector<Vec3> points_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<Vec3> points;
  char comma = ' ';
  for (Vec3 p; file >> p.x;) {
    for (double* number : {&p.y, &p.z}) {
      if ((file >> std::ws).peek() == ',') {
        file >> comma;
      }
      file >> *number;
    }
    points.push_back(kMm * p);
  }
  return points;
}

/// A legacy VTK file of triangles, as text.
nav::TriangleMesh mesh_of(const std::string& vtk) {
  nav::TriangleMesh mesh;
  std::istringstream in(vtk.substr(vtk.find("POINTS")));
  std::string word;
  std::size_t count = 0;
  in >> word >> count >> word;
  mesh.vertices_m.resize(count);
  for (Vec3& v : mesh.vertices_m) {
    in >> v.x >> v.y >> v.z;
    v = kMm * v;
  }
  in >> word >> count >> word;
  mesh.triangles.resize(count);
  for (auto& t : mesh.triangles) {
    in >> word >> t[0] >> t[1] >> t[2];
  }
  return mesh;
}

/// Closes each open loop by triangles about its middle.
void close_cuts(nav::TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      edges[{t[k], t[(k + 1) % 3]}] = true;
    }
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [edge, is] : edges) {
    if (edges.count({edge.second, edge.first}) == 0) {
      next[edge.second] = edge.first;
    }
  }
  while (!next.empty()) {
    std::vector<std::uint32_t> loop{next.begin()->first};
    Vec3 sum;
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      sum += mesh.vertices_m[at->first];
      loop.push_back(at->second);
      next.erase(at);
    }
    const auto middle = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.push_back(sum / static_cast<double>(loop.size() - 1));
    for (std::size_t i = 0; i + 1 < loop.size(); ++i) {
      mesh.triangles.push_back({loop[i], loop[i + 1], middle});
    }
  }
}

}  // namespace

std::optional<StrokedPelvis> stroked_pelvis() {
  const std::filesystem::path folder = test_data("real/ucl-mphy0026-pelvis");
  if (!std::filesystem::exists(folder)) {
    return std::nullopt;
  }
  StrokedPelvis out;
  out.mesh = nav::main_part(mesh_of(unpacked(folder / "pelvis_cropped_decimated.vtk.gz"))).mesh;
  close_cuts(out.mesh);
  for (const Vec3& p : points_of(folder / "Tracker_Surface_Scan.txt")) {
    out.strokes.push_back({p});
  }
  out.posts_in_model_m = points_of(folder / "pelvis_cropped_ct_fiducial_markers.txt");
  out.posts_in_world_m = points_of(folder / "Tracker_Fiducial_Markers.txt");
  return out;
}

}  // namespace orthonav::test
