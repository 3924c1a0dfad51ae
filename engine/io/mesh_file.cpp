#include "engine/io/mesh_file.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <utility>

#include "base/file_code.h"
#include "engine/io/atomic_file.h"
#include "engine/io/json_document.h"
#include "engine/io/ply_file.h"
#include "engine/io/polygon.h"
#include "engine/io/slicer_markups.h"

namespace orthonav::engine {
namespace {

constexpr std::uintmax_t kMaxFileBytes = 256u << 20u;
constexpr std::size_t kStlHeaderBytes = 80;
constexpr std::size_t kCommentBytes = 4096;  ///< within which Slicer's comment is in PLY and OBJ

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Status readable(const std::string& path) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem)) {
    return Error{path + ": is a folder, not a file"};
  }
  const std::uintmax_t size = std::filesystem::file_size(path, problem);
  if (problem || !std::ifstream(path)) {
    return Error{path + ": cannot be opened", code_of_unopened(path)};
  }
  if (size == 0) {
    return Error{path + ": is empty"};
  }
  if (size > kMaxFileBytes) {
    return Error{path + ": larger than " + std::to_string(kMaxFileBytes >> 20u) + " MiB"};
  }
  const std::string extension = extension_of(path);
  if (extension != ".stl" && extension != ".ply" && extension != ".obj") {
    if (Status s = check_no_scene(path, "save its model as .stl"); !s) {
      return s;
    }
    const bool vtk = extension == ".vtk" || extension == ".vtp" || extension == ".vtu";
    return Error{path + ": must be an STL, PLY or OBJ file" +
                 (vtk ? "; 3D Slicer and ParaView save a model as such" : "")};
  }
  return {};
}

/// Appends one of assimp's meshes, without merging corners. assimp's own triangulation of faces
/// ends the program if corners coincide or lie on a line.
Status append(const aiMesh& part, nav::TriangleMesh& mesh) {
  const std::size_t first = mesh.vertices_m.size();
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& v = part.mVertices[i];
    mesh.vertices_m.push_back({v.x, v.y, v.z});
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (const Status added = add_face({face.mIndices, face.mNumIndices}, first, mesh); !added) {
      return added;
    }
  }
  return {};
}

/// Opens only this one file, because an OBJ may name others (mtllib) anywhere on the machine.
class OneFile : public Assimp::DefaultIOSystem {
 public:
  explicit OneFile(std::string path) : path_(std::move(path)) {}
  [[nodiscard]] bool Exists(const char* file) const override {
    return file == path_ && DefaultIOSystem::Exists(file);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return file == path_ ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  std::string path_;
};

/// A library's message as one line.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

Result<nav::TriangleMesh> imported(const std::string& path) {
  try {
    Assimp::Importer importer;
    importer.SetIOHandler(new OneFile(path));  // the importer owns it
    const aiScene* scene = importer.ReadFile(path, 0);
    if (scene == nullptr) {
      return Error{path + ": cannot be read (" + one_line(importer.GetErrorString()) + ")"};
    }
    nav::TriangleMesh mesh;
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
      if (const Status appended = append(*scene->mMeshes[i], mesh); !appended) {
        return Error{path + ": " + appended.error().message};
      }
    }
    return mesh;
  } catch (const std::exception& error) {
    return Error{path + ": cannot be read (" + one_line(error.what()) + ")"};
  }
}

/// Not with assimp, which crashes or never returns on a damaged PLY file.
Result<nav::TriangleMesh> from_ply(const std::string& path) {
  const auto text = read_text(path, kMaxFileBytes);
  if (!text) {
    return text.error();
  }
  auto file = read_ply(*text, path);
  if (!file) {
    return file.error();
  }
  nav::TriangleMesh mesh;
  mesh.vertices_m = std::move(file->vertices);
  std::span<const std::uint32_t> corners = file->corners;
  for (const std::uint32_t count : file->corner_counts) {
    if (const Status added = add_face(corners.first(count), 0, mesh); !added) {
      return Error{path + ": " + added.error().message};
    }
    corners = corners.subspan(count);
  }
  return mesh;
}

/// The word after `SPACE=` near the file's beginning.
std::optional<std::string> declared_space(const std::string& path) {
  constexpr std::string_view kKey = "SPACE=";
  std::string head(extension_of(path) == ".stl" ? kStlHeaderBytes : kCommentBytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  std::size_t at = head.find(kKey);
  // Only as a word of its own: COLORSPACE= says nothing about axes.
  while (at != std::string::npos && at > 0 &&
         std::isalnum(static_cast<unsigned char>(head[at - 1])) != 0) {
    at = head.find(kKey, at + 1);
  }
  if (at == std::string::npos) {
    return std::nullopt;
  }
  const auto first = head.begin() + static_cast<std::ptrdiff_t>(at + kKey.size());
  return std::string(first, std::find_if_not(first, head.end(),
                                             [](unsigned char c) { return std::isalpha(c) != 0; }));
}

void put(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

void put_mm(std::string& bytes, Vec3 v_m) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto mm = static_cast<float>(v_m[axis] * 1e3);
    put(bytes, &mm, sizeof mm);
  }
}

}  // namespace

std::optional<Axes> declared_axes(const std::string& path) {
  const auto word = declared_space(path);
  return word ? axes_from(*word) : std::nullopt;
}

Result<nav::TriangleMesh> load_mesh(const std::string& path, double metres_per_unit, Axes axes,
                                    std::string* note, nav::Bone bone) {
  if (Status status = readable(path); !status) {
    return status.error();
  }
  if (const auto space = declared_space(path); space && !axes_from(*space)) {
    return Error{path + ": SPACE is \"" + *space + "\", must be LPS or RAS"};
  }
  Result<nav::TriangleMesh> apart = extension_of(path) == ".ply" ? from_ply(path) : imported(path);
  if (!apart) {
    return apart;
  }
  // Files repeat a vertex for each of its triangles with the same digits, so exactly equal ones are
  // merged.
  nav::TriangleMesh mesh = nav::welded(*apart);
  const Axes used = declared_axes(path).value_or(axes);
  for (Vec3& v : mesh.vertices_m) {
    v = to_lps(v, used) * metres_per_unit;
  }
  nav::MainPart main = nav::main_part(std::move(mesh));
  Result<nav::TriangleMesh> checked = nav::checked_bone(std::move(main.mesh), bone);
  if (!checked) {
    return Error{path + ": " + checked.error().message};
  }
  if (note != nullptr && main.left_out > 0) {
    *note =
        path + ": " + std::to_string(main.left_out) +
        (main.left_out == 1 ? " part apart from the bone was" : " parts apart from the bone were") +
        " left out (islands or cavities)";
  }
  return checked;
}

Status save_stl(const std::string& path, const nav::TriangleMesh& mesh) {
  std::string bytes = "orthonav, mm, SPACE=LPS";
  bytes.resize(kStlHeaderBytes, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  put(bytes, &count, sizeof count);
  for (const auto& triangle : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[triangle[0]];
    const Vec3 b = mesh.vertices_m[triangle[1]];
    const Vec3 c = mesh.vertices_m[triangle[2]];
    const Vec3 normal = (b - a).cross(c - a);
    const double length = normal.norm();
    // In the format's millimetres a unit normal is a thousandth of a metre.
    put_mm(bytes, length > 0 ? normal * (1e-3 / length) : Vec3{});
    for (const Vec3& corner : {a, b, c}) {
      put_mm(bytes, corner);
    }
    bytes.append(2, '\0');
  }
  return write_file(path, bytes);
}

}  // namespace orthonav::engine
