#include "engine/scan/itk_voxels.h"

#include "engine/scan/itk_under_clang.h"

#include <itkImageIOBase.h>

#include <cstring>

namespace orthonav::engine {
namespace {

using itk::IOComponentEnum;

template <class T>
void append_as_floats(const std::vector<char>& bytes, std::vector<float>& values) {
  const std::size_t count = bytes.size() / sizeof(T);
  values.reserve(values.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    T value{};
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    values.push_back(static_cast<float>(value));
  }
}

Status append(IOComponentEnum type, const std::vector<char>& bytes, std::vector<float>& values) {
  switch (type) {
    case IOComponentEnum::UCHAR:
      append_as_floats<unsigned char>(bytes, values);
      return {};
    case IOComponentEnum::CHAR:
      append_as_floats<signed char>(bytes, values);
      return {};
    case IOComponentEnum::USHORT:
      append_as_floats<unsigned short>(bytes, values);
      return {};
    case IOComponentEnum::SHORT:
      append_as_floats<short>(bytes, values);
      return {};
    case IOComponentEnum::UINT:
      append_as_floats<unsigned int>(bytes, values);
      return {};
    case IOComponentEnum::INT:
      append_as_floats<int>(bytes, values);
      return {};
    case IOComponentEnum::ULONG:
    case IOComponentEnum::ULONGLONG:
      append_as_floats<std::uint64_t>(bytes, values);
      return {};
    case IOComponentEnum::LONG:
    case IOComponentEnum::LONGLONG:
      append_as_floats<std::int64_t>(bytes, values);
      return {};
    case IOComponentEnum::FLOAT:
      append_as_floats<float>(bytes, values);
      return {};
    case IOComponentEnum::DOUBLE:
      append_as_floats<double>(bytes, values);
      return {};
    default:
      return Error{"voxels of an unknown type"};
  }
}

}  // namespace

Status read_voxels(itk::ImageIOBase& io, std::vector<float>& values) {
  const unsigned dimensions = io.GetNumberOfDimensions();
  itk::ImageIORegion region(dimensions);
  for (unsigned d = 0; d < dimensions; ++d) {
    region.SetIndex(d, 0);
    region.SetSize(d, io.GetDimensions(d));
  }
  io.SetIORegion(region);
  std::vector<char> bytes(static_cast<std::size_t>(io.GetImageSizeInBytes()));
  io.Read(bytes.data());
  return append(io.GetComponentType(), bytes, values);
}

std::string itk_problem(const std::exception& error) {
  const auto* from_itk = dynamic_cast<const itk::ExceptionObject*>(&error);
  // What ITK says ends with the file and line of its source, and begins with an address.
  std::string what = from_itk != nullptr ? from_itk->GetDescription() : error.what();
  what = what.substr(0, what.find('\n'));
  if (const auto object = what.find("): "); object != std::string::npos) {
    what.erase(0, object + 3);  // "ITK ERROR: GDCMImageIO(0x...): "
  }
  return what.empty() ? "unknown format" : what;
}

}  // namespace orthonav::engine
