#include "tests/engine/scan/itk_transform.h"

#ifdef __clang__
// As in engine/scan/volume_reader.cpp.
#define ITK_COMPILER_DETECTION_H
#define ITK_NOEXCEPT noexcept
#define ITK_NOEXCEPT_EXPR(X) noexcept(X)
#endif
#include <itkHDF5TransformIO.h>
#include <itkTransform.h>
#include <itkTransformFactoryBase.h>
#include <itkTxtTransformIO.h>

namespace orthonav::test {
namespace {

template <class Number>
using Transform3 = itk::Transform<Number, 3, 3>;

template <class Number>
typename itk::TransformIOBaseTemplate<Number>::Pointer io_for(const std::string& path) {
  typename itk::TransformIOBaseTemplate<Number>::Pointer io;
  if (path.ends_with(".h5")) {
    io = itk::HDF5TransformIOTemplate<Number>::New();
  } else {
    io = itk::TxtTransformIOTemplate<Number>::New();
  }
  io->SetFileName(path);
  return io;
}

template <class Array>
Array array_of(const std::vector<double>& numbers) {
  Array array(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    array[i] = static_cast<typename Array::ValueType>(numbers[i]);
  }
  return array;
}

template <class Number>
bool written(const std::string& path, const std::string& kind,
             const std::vector<double>& parameters, const std::vector<double>& fixed) {
  itk::TransformFactoryBase::RegisterDefaultTransforms();
  const itk::LightObject::Pointer made = itk::ObjectFactoryBase::CreateInstance(kind.c_str());
  auto* const transform = dynamic_cast<Transform3<Number>*>(made.GetPointer());
  if (transform == nullptr) {
    return false;
  }
  transform->SetFixedParameters(array_of<typename Transform3<Number>::FixedParametersType>(fixed));
  transform->SetParameters(array_of<typename Transform3<Number>::ParametersType>(parameters));
  const auto io = io_for<Number>(path);
  typename itk::TransformIOBaseTemplate<Number>::ConstTransformListType list;
  list.push_back(transform);
  io->SetTransformList(list);
  io->Write();
  return true;
}

}  // namespace

bool itk_writes(const std::string& path, const std::string& kind,
                const std::vector<double>& parameters,
                const std::vector<double>& fixed_parameters) {
  try {
    return kind.find("_float_") == std::string::npos
               ? written<double>(path, kind, parameters, fixed_parameters)
               : written<float>(path, kind, parameters, fixed_parameters);
  } catch (const itk::ExceptionObject&) {
    return false;
  }
}

std::optional<Vec3> itk_takes(const std::string& path, Vec3 point_mm) {
  try {
    const auto io = io_for<double>(path);
    io->Read();
    if (io->GetTransformList().size() != 1) {
      return std::nullopt;
    }
    const auto* const transform =
        dynamic_cast<const Transform3<double>*>(io->GetTransformList().front().GetPointer());
    if (transform == nullptr) {
      return std::nullopt;
    }
    Transform3<double>::InputPointType from;
    for (int i = 0; i < 3; ++i) {
      from[static_cast<unsigned>(i)] = point_mm[i];
    }
    const auto to = transform->TransformPoint(from);
    return Vec3{to[0], to[1], to[2]};
  } catch (const itk::ExceptionObject&) {
    return std::nullopt;
  }
}

}  // namespace orthonav::test
