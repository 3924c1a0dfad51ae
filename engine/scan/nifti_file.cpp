#include "engine/scan/nifti_file.h"

#include <nifti2_io.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "base/printed.h"
#include "engine/scan/whole_file.h"

namespace orthonav::engine {
namespace {

/// What the header says, of either version.
struct Header {
  std::array<std::int64_t, 8> dim{};
  std::array<double, 8> pixdim{};
  int qform_code = 0;
  int sform_code = 0;
  std::array<double, 3> quaternion{};  ///< b, c, d
  std::array<double, 3> offset{};      ///< of the qform
  std::array<std::array<double, 4>, 3> srow{};
  double slope = 0.0;
  double inter = 0.0;
  int datatype = 0;
  int units = 0;
  std::int64_t voxels_begin = 0;
  std::string magic;
};

template <class Stored>
Header header_from(const Stored& h) {
  Header out;
  for (std::size_t i = 0; i < 8; ++i) {
    out.dim[i] = h.dim[i];
    out.pixdim[i] = double{h.pixdim[i]};
  }
  out.qform_code = h.qform_code;
  out.sform_code = h.sform_code;
  out.quaternion = {double{h.quatern_b}, double{h.quatern_c}, double{h.quatern_d}};
  out.offset = {double{h.qoffset_x}, double{h.qoffset_y}, double{h.qoffset_z}};
  for (std::size_t i = 0; i < 4; ++i) {
    out.srow[0][i] = double{h.srow_x[i]};
    out.srow[1][i] = double{h.srow_y[i]};
    out.srow[2][i] = double{h.srow_z[i]};
  }
  out.slope = double{h.scl_slope};
  out.inter = double{h.scl_inter};
  out.datatype = h.datatype;
  out.units = XYZT_TO_SPACE(static_cast<int>(h.xyzt_units));
  out.voxels_begin = static_cast<std::int64_t>(h.vox_offset);
  out.magic = std::string(h.magic, h.magic + 3);
  return out;
}

/// The header as it stands in the file, without the library's repairs.
std::optional<Header> header_in(const std::string& path) {
  int version = -1;
  const std::unique_ptr<void, decltype(&std::free)> stored(
      ::nifti_read_header(path.c_str(), &version, 0), &std::free);
  if (!stored || version < 0 || version > 2) {
    return std::nullopt;
  }
  return version == 2 ? header_from(*static_cast<const nifti_2_header*>(stored.get()))
                      : header_from(*static_cast<const nifti_1_header*>(stored.get()));
}

/// Index to place, RAS as in the file: the columns of a voxel's three steps, and the first voxel.
struct Form {
  std::array<Vec3, 3> step;
  Vec3 origin;

  [[nodiscard]] Vec3 place(Vec3 index) const {
    return origin + index.x * step[0] + index.y * step[1] + index.z * step[2];
  }
};

Form sform_of(const Header& h) {
  const auto column = [&](std::size_t i) { return Vec3{h.srow[0][i], h.srow[1][i], h.srow[2][i]}; };
  return {{column(0), column(1), column(2)}, column(3)};
}

/// "Method 2" of nifti1.h.
Result<Form> qform_of(const Header& h) {
  const auto [b, c, d] = h.quaternion;
  const double rest = 1.0 - (b * b + c * c + d * d);
  if (!(rest > -1e-5)) {
    return Error{"its qform is no rotation (quatern_b, _c, _d are longer than 1)"};
  }
  const double a = std::sqrt(std::max(rest, 0.0));
  const double length = std::sqrt(a * a + b * b + c * c + d * d);
  const Mat3 rotation = rotation_from_quaternion({b / length, c / length, d / length, a / length});
  const double mirrored = h.pixdim[0] < 0.0 ? -1.0 : 1.0;
  return Form{{h.pixdim[1] * rotation.column(0), h.pixdim[2] * rotation.column(1),
               mirrored * h.pixdim[3] * rotation.column(2)},
              {h.offset[0], h.offset[1], h.offset[2]}};
}

bool plausible(const Header& h) {
  constexpr double kMost = 1e9;  // of any unit, many times a hospital
  const auto all = [](const auto& numbers) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [](double x) { return std::abs(x) <= kMost; });
  };
  return all(std::span(h.pixdim).first(4)) && all(h.quaternion) && all(h.offset) &&
         std::all_of(h.srow.begin(), h.srow.end(), all) && std::isfinite(h.slope) &&
         std::isfinite(h.inter);
}

double longest_between(const Form& a, const Form& b, const std::array<int, 3>& size) {
  double longest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at = [&](int axis) {
      return (corner & (1 << axis)) != 0 ? double(size[static_cast<std::size_t>(axis)] - 1) : 0.0;
    };
    const Vec3 index{at(0), at(1), at(2)};
    longest = std::max(longest, (a.place(index) - b.place(index)).norm());
  }
  return longest;
}

/// The form to use: the only one that is stated, or the sform where both say the same. A qform
/// cannot shear: beside an sform that is sheared within the limit it may be off by that much.
Result<Form> one_form(const Header& h, const std::array<int, 3>& size, double metres) {
  constexpr double kSame_m = 1e-4;
  if (h.qform_code <= 0 && h.sform_code <= 0) {
    return Error{
        "states no orientation (qform_code and sform_code are 0): left and right are undefined; "
        "export it again with one, as dcm2niix and 3D Slicer do"};
  }
  const int code = h.sform_code > 0 ? h.sform_code : h.qform_code;
  if (code >= NIFTI_XFORM_TALAIRACH) {
    return Error{
        printed("is in the space of a template (%s %d), not the patient's; export it in "
                "scanner coordinates",
                h.sform_code > 0 ? "sform_code" : "qform_code", code)};
  }
  const auto qform = qform_of(h);
  if (h.qform_code > 0 && !qform) {
    return qform.error();
  }
  if (h.sform_code <= 0) {
    return *qform;
  }
  const Form sform = sform_of(h);
  double shear_m = 0.0;
  if (const double shear = shear_rad(sform.step); shear <= kMaxShear_rad) {
    shear_m = shear * metres * longest_between(sform, {{}, sform.origin}, size);
  }
  if (h.qform_code > 0) {
    const double apart_m = metres * longest_between(sform, *qform, size);
    if (!(apart_m <= kSame_m + 2.0 * shear_m)) {
      double turned = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        turned = std::max(turned, angle_between_rad(sform.step[i], qform->step[i]));
      }
      return Error{
          printed("its sform and qform disagree, by up to %.1f mm and %.2f°: one of them "
                  "is wrong; export it again, or set the code of the wrong one to 0",
                  apart_m * 1e3, turned * kDegreesPerRadian)};
    }
  } else if (shear_rad(sform.step) <= kMaxShear_rad) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double stated = std::abs(h.pixdim[i + 1]), step = sform.step[i].norm();
      if (stated > 0.0 && !(std::abs(step / stated - 1.0) <= 0.01)) {
        return Error{
            printed("its voxels are %.4g wide by pixdim and %.4g by its sform", stated, step)};
      }
    }
  }
  return sform;
}

Result<double> metres_of(int units) {
  switch (units) {
    case NIFTI_UNITS_METER:
      return 1.0;
    case NIFTI_UNITS_MICRON:
      return 1e-6;
    case NIFTI_UNITS_MM:
    case NIFTI_UNITS_UNKNOWN:  // what writers that know only mm leave
      return 1e-3;
    default:
      return Error{"states an unknown unit (xyzt_units " + std::to_string(units) + ")"};
  }
}

Result<VolumeGrid> grid_of(const Header& h, std::vector<std::string>& notes) {
  if (!plausible(h)) {
    return Error{"its header holds a spacing, orientation or scaling that is not a number"};
  }
  bool flat = h.dim[0] < 3 || h.dim[0] > 7;
  for (std::int64_t d = 4; d <= std::min<std::int64_t>(h.dim[0], 7); ++d) {
    flat = flat || h.dim[static_cast<std::size_t>(d)] != 1;
  }
  if (flat) {
    return Error{"has " + std::to_string(h.dim[0]) + " dimensions, must have 3"};
  }
  std::array<int, 3> size{};
  for (std::size_t i = 0; i < 3; ++i) {
    size[i] = static_cast<int>(std::clamp<std::int64_t>(h.dim[i + 1], 0, 1 << 30));
  }
  const auto metres = metres_of(h.units);
  if (!metres) {
    return metres.error();
  }
  const auto form = one_form(h, size, *metres);
  if (!form) {
    return form.error();
  }
  const auto lps_m = [&](Vec3 ras) { return *metres * Vec3{-ras.x, -ras.y, ras.z}; };
  auto grid = squared_grid(size, {lps_m(form->step[0]), lps_m(form->step[1]), lps_m(form->step[2])},
                           lps_m(form->origin), notes);
  if (!grid && h.units != NIFTI_UNITS_MM) {
    const char* unit = h.units == NIFTI_UNITS_METER    ? "metres"
                       : h.units == NIFTI_UNITS_MICRON ? "micrometres"
                                                       : "no unit";
    return Error{grid.error().message + " (the header states " + unit +
                 "; where its numbers are mm, set xyzt_units to mm)"};
  }
  return grid;
}

template <class T>
void append_scaled(const nifti_image& image, double slope, double inter,
                   std::vector<float>& values) {
  const auto* stored = static_cast<const T*>(image.data);
  const auto count = static_cast<std::size_t>(image.nvox);
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    double value = slope * static_cast<double>(stored[i]) + inter;
    // The header's floats are exact to seven digits: a label times 0.1 is meant to be whole.
    const double whole = std::round(value);
    if (std::abs(value - whole) <= 1e-6 * std::max(1.0, std::abs(value))) {
      value = whole;
    }
    values.push_back(static_cast<float>(value));
  }
}

Status append(const nifti_image& image, const Header& h, std::vector<float>& values) {
  // "If the scl_slope field is nonzero, then each voxel value should be scaled" (nifti1.h).
  const double slope = h.slope == 0.0 ? 1.0 : h.slope;
  const double inter = h.slope == 0.0 ? 0.0 : h.inter;
  switch (image.datatype) {
    case NIFTI_TYPE_UINT8:
      append_scaled<std::uint8_t>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_INT8:
      append_scaled<std::int8_t>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_UINT16:
      append_scaled<std::uint16_t>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_INT16:
      append_scaled<std::int16_t>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_UINT32:
      append_scaled<std::uint32_t>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_INT32:
      append_scaled<std::int32_t>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_UINT64:
      append_scaled<std::uint64_t>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_INT64:
      append_scaled<std::int64_t>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_FLOAT32:
      append_scaled<float>(image, slope, inter, values);
      return {};
    case NIFTI_TYPE_FLOAT64:
      append_scaled<double>(image, slope, inter, values);
      return {};
    default:
      return Error{std::string("its voxels are ") + ::nifti_datatype_string(image.datatype) +
                   ", must be whole numbers or floats"};
  }
}

}  // namespace

Result<Volume> read_nifti(const std::string& path) {
  ::nifti_set_debug_level(0);  // problems are returned; the library must not print
  const auto header = header_in(path);
  if (!header) {
    return Error{"is not a NIfTI file"};
  }
  if (header->magic != "n+1" && header->magic != "n+2") {
    return Error{header->magic.starts_with("ni")
                     ? "its voxels are in another file (.img); save the scan as one .nii"
                     : "is an ANALYZE file, which has no orientation; save the scan as NIfTI"};
  }
  Volume volume;
  auto grid = grid_of(*header, volume.notes);
  if (!grid) {
    return grid.error();
  }
  volume.grid = *grid;
  int bytes_a_voxel = 0, swap = 0;
  ::nifti_datatype_sizes(header->datatype, &bytes_a_voxel, &swap);
  const auto bytes =
      static_cast<std::uint64_t>(volume.grid.voxels()) * static_cast<std::uint64_t>(bytes_a_voxel);
  if (Status s = check_long_enough(path, bytes); !s) {
    return s.error();
  }
  if (Status s = check_whole(
          path,
          static_cast<std::uint64_t>(std::max<std::int64_t>(header->voxels_begin, 0)) + bytes);
      !s) {
    return s.error();
  }
  const std::unique_ptr<nifti_image, decltype(&::nifti_image_free)> image(
      ::nifti_image_read(path.c_str(), 1), &::nifti_image_free);
  if (!image || image->data == nullptr ||
      static_cast<std::size_t>(image->nvox) != volume.grid.voxels()) {
    return Error{"its voxels can't be read"};
  }
  if (Status s = append(*image, *header, volume.values); !s) {
    return s.error();
  }
  return volume;
}

}  // namespace orthonav::engine
