#pragma once

#include <pybind11/numpy.h>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/tracked.h"
#include "base/transform.h"
#include "nav/geometry/mesh.h"

// Conversion of values from and to Python. Everything is copied: no array shares memory with the
// engine. Unusable arguments are refused with name, value and limit.
namespace orthonav::python {

namespace py = pybind11;

/// Becomes orthonav.Error, a ValueError.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The value, or orthonav.Error with the reason why there is none.
template <class T>
T value_of(Result<T> result) {
  if (!result) {
    throw Refused(result.error().message);
  }
  return std::move(result).value();
}
void succeed(const Status& status);

/// `shape`: -1 for any length.
using Shape = std::initializer_list<py::ssize_t>;

/// Real numbers of this shape, finite unless NaN has a meaning there.
enum class Nan { kRefused, kMeansNothing };
[[nodiscard]] std::vector<double> numbers_from(const py::object& value, const std::string& name,
                                               Shape shape, Nan nan = Nan::kRefused);
[[nodiscard]] double number_from(double value, const std::string& name);
[[nodiscard]] Vec3 vec3_from(const py::object& value, const std::string& name);
[[nodiscard]] std::vector<Vec3> vec3s_from(const py::object& value, const std::string& name);
/// Whole numbers: indices of vertices.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles_from(const py::object& value,
                                                                       const std::string& name);
/// uint8, rows by columns.
[[nodiscard]] GreyImage grey_from(const py::object& value, const std::string& name);
/// How far a pose may shift. A pose given in millimetres lies farther away than any in metres: in
/// World a headset's map spans a building, a camera lies on the rig that it belongs to.
inline constexpr double kFarthestInWorld_m = 100.0;
inline constexpr double kFarthestOnRig_m = 10.0;
/// The 16 numbers of a 4x4 matrix whose last row is 0 0 0 1.
[[nodiscard]] std::array<double, 16> matrix_from(const py::object& value, const std::string& name,
                                                 double farthest_m);

template <class A, class B>
[[nodiscard]] Transform<A, B> transform_from(const py::object& value, const std::string& name,
                                             double farthest_m = kFarthestInWorld_m) {
  const auto pose = Transform<A, B>::from_row_major(matrix_from(value, name, farthest_m));
  if (!pose) {
    throw Refused(name + ": " + pose.error().message);
  }
  return *pose;
}

[[nodiscard]] py::array array_of(const double* numbers, std::vector<py::ssize_t> shape);
[[nodiscard]] py::array array_of(Vec3 v);
[[nodiscard]] py::array array_of(const std::vector<Vec3>& vectors);
[[nodiscard]] py::array array_of(const PoseCovariance& covariance);
[[nodiscard]] py::array array_of(const std::vector<std::array<std::uint32_t, 3>>& triangles);
[[nodiscard]] py::array array_of(const GreyImage& image);
template <class A, class B>
[[nodiscard]] py::array array_of(const Transform<A, B>& a_from_b) {
  return array_of(a_from_b.row_major().data(), {4, 4});
}
/// (vertices, triangles)
[[nodiscard]] py::tuple arrays_of(const nav::TriangleMesh& mesh);

}  // namespace orthonav::python
