#pragma once

#include <optional>
#include <string>

#include "base/result.h"
#include "engine/io/patient_axes.h"
#include "nav/geometry/mesh.h"

namespace orthonav::engine {

/// The axes that a mesh file itself declares: `SPACE=LPS` or `SPACE=RAS` in an STL header or a
/// comment, as written by 3D Slicer. Also nothing for unknown axes (`load_mesh` refuses them).
[[nodiscard]] std::optional<Axes> declared_axes(const std::string& path);

/// Reads a bone from STL, PLY or OBJ (by the extension) into metres and LPS axes: corners at
/// the same place become one vertex, triangles that collapse are dropped, of several parts the main
/// one stays (`nav::main_part`), then `nav::checked_bone` decides. `axes` applies unless the
/// file itself declares its axes, which must be LPS or RAS. `note`: a line on what was left out;
/// untouched where nothing was.
Result<nav::TriangleMesh> load_mesh(const std::string& path, double metres_per_unit,
                                    Axes axes = Axes::kLps, std::string* note = nullptr,
                                    nav::Bone bone = nav::Bone::kVertebra);

/// Writes a binary STL in millimetres and LPS, marked `SPACE=LPS`.
Status save_stl(const std::string& path, const nav::TriangleMesh& mesh);

}  // namespace orthonav::engine
