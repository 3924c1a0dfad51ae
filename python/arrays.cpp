#include "python/arrays.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/printed.h"

namespace orthonav::python {
namespace {

std::string text_of(const py::object& value) { return py::str(value).cast<std::string>(); }

std::string shape_text(Shape shape) {
  std::string text = "(";
  for (const py::ssize_t length : shape) {
    text += text.size() > 1 ? ", " : "";
    text += length < 0 ? "N" : std::to_string(length);
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

bool has_shape(const py::array& array, Shape shape) {
  return static_cast<std::size_t>(array.ndim()) == shape.size() &&
         std::equal(shape.begin(), shape.end(), array.shape(),
                    [](py::ssize_t wanted, py::ssize_t is) { return wanted < 0 || wanted == is; });
}

/// An array of this shape, of one of these kinds of numbers (NumPy's dtype.kind).
py::array array_from(const py::object& value, const std::string& name, Shape shape,
                     const std::string& kinds, const std::string& wanted) {
  const auto array = py::array::ensure(value);
  if (!array || kinds.find(array.dtype().kind()) == std::string::npos) {
    PyErr_Clear();
    throw Refused(name + ": " + (array ? "holds " + text_of(array.dtype()) : "is not an array") +
                  ", must be an array of " + wanted);
  }
  if (!has_shape(array, shape)) {
    throw Refused(name + ": has shape " + text_of(array.attr("shape")) + ", must be " +
                  shape_text(shape));
  }
  return array;
}

template <class Number>
std::vector<Number> copied(const py::array& array, const std::string& name) {
  const auto rows = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!rows) {
    PyErr_Clear();
    throw Refused(name + ": its numbers can't be read");
  }
  return {rows.data(), rows.data() + rows.size()};
}

template <class Number>
py::array filled(const Number* numbers, std::vector<py::ssize_t> shape) {
  return py::array_t<Number>(std::move(shape), numbers);
}

}  // namespace

void succeed(const Status& status) {
  if (!status) {
    throw Refused(status.error().message);
  }
}

std::vector<double> numbers_from(const py::object& value, const std::string& name, Shape shape,
                                 Nan nan) {
  const auto numbers = copied<double>(array_from(value, name, shape, "fiu", "real numbers"), name);
  for (const double number : numbers) {
    if (!std::isfinite(number) && !(nan == Nan::kMeansNothing && std::isnan(number))) {
      throw Refused(name + ": holds " + std::to_string(number) + ", must be finite");
    }
  }
  return numbers;
}

double number_from(double value, const std::string& name) {
  if (!std::isfinite(value)) {
    throw Refused(name + ": is " + std::to_string(value) + ", must be finite");
  }
  return value;
}

Vec3 vec3_from(const py::object& value, const std::string& name) {
  const auto numbers = numbers_from(value, name, {3});
  return {numbers[0], numbers[1], numbers[2]};
}

std::vector<Vec3> vec3s_from(const py::object& value, const std::string& name) {
  const auto numbers = numbers_from(value, name, {-1, 3});
  std::vector<Vec3> vectors;
  vectors.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    vectors.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
  return vectors;
}

std::vector<std::array<std::uint32_t, 3>> triangles_from(const py::object& value,
                                                         const std::string& name) {
  const auto corners =
      copied<std::int64_t>(array_from(value, name, {-1, 3}, "iu", "whole numbers"), name);
  std::vector<std::array<std::uint32_t, 3>> triangles(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < 0 || corners[i] > std::numeric_limits<std::uint32_t>::max()) {
      throw Refused(name + ": holds " + std::to_string(corners[i]) + ", which is not an index");
    }
    triangles[i / 3][i % 3] = static_cast<std::uint32_t>(corners[i]);
  }
  return triangles;
}

GreyImage grey_from(const py::object& value, const std::string& name) {
  const auto array = array_from(value, name, {-1, -1}, "u", "uint8");
  if (array.itemsize() != 1) {
    throw Refused(name + ": holds " + text_of(array.dtype()) + ", must be an array of uint8");
  }
  if (std::max(array.shape(0), array.shape(1)) > std::numeric_limits<int>::max()) {
    throw Refused(name + ": is too large for an image");
  }
  GreyImage image;
  image.width_px = static_cast<int>(array.shape(1));
  image.height_px = static_cast<int>(array.shape(0));
  image.pixels = copied<std::uint8_t>(array, name);
  return image;
}

std::array<double, 16> matrix_from(const py::object& value, const std::string& name,
                                   double farthest_m) {
  const auto numbers = numbers_from(value, name, {4, 4});
  std::array<double, 16> matrix{};
  std::copy(numbers.begin(), numbers.end(), matrix.begin());
  if (matrix[12] != 0.0 || matrix[13] != 0.0 || matrix[14] != 0.0 || matrix[15] != 1.0) {
    throw Refused(name + ": its last row must be 0 0 0 1");
  }
  const double shift_m = std::hypot(matrix[3], matrix[7], matrix[11]);
  if (!(shift_m <= farthest_m)) {
    throw Refused(
        name + ": " +
        printed("shifts by %.6g m, limit %g m (is it in millimetres?)", shift_m, farthest_m));
  }
  return matrix;
}

py::array array_of(const double* numbers, std::vector<py::ssize_t> shape) {
  return filled(numbers, std::move(shape));
}
py::array array_of(Vec3 v) {
  const std::array<double, 3> numbers = {v.x, v.y, v.z};
  return filled(numbers.data(), {3});
}
py::array array_of(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  for (const Vec3& v : vectors) {
    numbers.insert(numbers.end(), {v.x, v.y, v.z});
  }
  return filled(numbers.data(), {static_cast<py::ssize_t>(vectors.size()), 3});
}
py::array array_of(const PoseCovariance& covariance) { return filled(covariance.data(), {6, 6}); }
py::array array_of(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return filled(corners.data(), {static_cast<py::ssize_t>(triangles.size()), 3});
}
py::array array_of(const GreyImage& image) {
  return filled(image.pixels.data(), {image.height_px, image.width_px});
}
py::tuple arrays_of(const nav::TriangleMesh& mesh) {
  return py::make_tuple(array_of(mesh.vertices_m), array_of(mesh.triangles));
}

}  // namespace orthonav::python
