#include "engine/scan/transform_hdf5.h"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>

namespace orthonav::engine {
namespace {

constexpr const char* kGroup = "/TransformGroup";
constexpr const char* kFirst = "/TransformGroup/0";
constexpr const char* kKind = "TransformType";
constexpr std::initializer_list<const char*> kParameters = {"TransformParameters",
                                                            "TranformParameters"};
constexpr std::initializer_list<const char*> kFixedParameters = {"TransformFixedParameters",
                                                                 "TranformFixedParameters"};
/// More than any rigid transform has.
constexpr hssize_t kMaxNumbers = 64;
constexpr std::size_t kLongestKind = 256;
constexpr std::size_t kBlock = std::size_t{1} << 12u;

/// One of libhdf5's objects; closed with its owner.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) {
    other.id_ = H5I_INVALID_HID;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) {
      close_(id_);
    }
  }
  [[nodiscard]] hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// A file in memory, which nobody else sees.
Handle access_to_memory() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id(), kBlock, 0);
  return access;
}

/// Unless told not to, libhdf5 prints its errors and loads plugins that decompress.
void keep_quiet() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);
}

/// Whether the name stands for something in this very file.
bool is_here(hid_t parent, const char* name) {
  H5L_info_t about{};
  return H5Lexists(parent, name, H5P_DEFAULT) > 0 &&
         H5Lget_info(parent, name, &about, H5P_DEFAULT) >= 0 && about.type == H5L_TYPE_HARD;
}

/// Whether its values lie in this very file.
bool holds_its_values(hid_t data) {
  const Handle made(H5Dget_create_plist(data), H5Pclose);
  return made && H5Pget_external_count(made.id()) == 0 && H5Pget_layout(made.id()) != H5D_VIRTUAL;
}

/// The first of these names that is there.
Result<Handle> data_named(hid_t group, std::initializer_list<const char*> names) {
  for (const char* const name : names) {
    if (is_here(group, name)) {
      Handle data(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose);
      if (!data || !holds_its_values(data.id())) {
        return Error{std::string(kFirst) + "/" + name + " can't be read"};
      }
      return data;
    }
  }
  return Error{std::string("has no ") + kFirst + "/" + *names.begin()};
}

hssize_t count_in(hid_t data) {
  const Handle space(H5Dget_space(data), H5Sclose);
  return space ? H5Sget_simple_extent_npoints(space.id()) : -1;
}

Result<std::string> text_named(hid_t group, const char* name) {
  const auto data = data_named(group, {name});
  if (!data) {
    return data.error();
  }
  const Error unreadable{std::string(kFirst) + "/" + name + " is not text"};
  const Handle type(H5Dget_type(data->id()), H5Tclose);
  if (!type || H5Tget_class(type.id()) != H5T_STRING || count_in(data->id()) != 1) {
    return unreadable;
  }
  if (H5Tis_variable_str(type.id()) > 0) {
    char* read = nullptr;
    if (H5Dread(data->id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &read) < 0 ||
        read == nullptr) {
      return unreadable;
    }
    std::string text(read, ::strnlen(read, kLongestKind));
    H5free_memory(read);
    return text;
  }
  std::string text(H5Tget_size(type.id()), '\0');
  if (text.size() > kLongestKind ||
      H5Dread(data->id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) {
    return unreadable;
  }
  text.resize(::strnlen(text.data(), text.size()));
  return text;
}

Result<std::vector<double>> numbers_named(hid_t group, std::initializer_list<const char*> names) {
  const auto data = data_named(group, names);
  if (!data) {
    return data.error();
  }
  const std::string what = std::string(kFirst) + "/" + *names.begin();
  const Handle type(H5Dget_type(data->id()), H5Tclose);
  if (!type || H5Tget_class(type.id()) != H5T_FLOAT) {
    return Error{what + " holds no floating-point numbers"};
  }
  const hssize_t count = count_in(data->id());
  if (count < 0 || count > kMaxNumbers) {
    return Error{what + " holds " + std::to_string(count) + " numbers, limit " +
                 std::to_string(kMaxNumbers)};
  }
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (count > 0 &&
      H5Dread(data->id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0) {
    return Error{what + " can't be read"};
  }
  return numbers;
}

Status check_one_transform(hid_t file) {
  if (!is_here(file, kGroup)) {
    return Error{std::string("has no ") + kGroup};
  }
  const Handle group(H5Gopen2(file, kGroup, H5P_DEFAULT), H5Gclose);
  H5G_info_t about{};
  if (!group || H5Gget_info(group.id(), &about) < 0) {
    return Error{std::string(kGroup) + " can't be read"};
  }
  if (about.nlinks != 1) {
    return Error{"holds " + std::to_string(about.nlinks) + " transforms, must hold one"};
  }
  return is_here(file, kFirst) ? Status{} : Status{Error{std::string("has no ") + kFirst}};
}

Status write_data(hid_t group, const char* name, hid_t type, hsize_t count, const void* values) {
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle data(
      H5Dcreate2(group, name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (!data || H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
    return Error{std::string("HDF5 can't write ") + name, ErrorCode::kIo};
  }
  return {};
}

Status write_transform(hid_t file, const StoredTransform& transform) {
  const Handle all(H5Gcreate2(file, kGroup, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  const Handle first(H5Gcreate2(file, kFirst, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(text.id(), H5T_VARIABLE);
  const char* const kind = transform.kind.c_str();
  if (Status s = write_data(first.id(), kKind, text.id(), 1, &kind); !s) {
    return s;
  }
  const auto& fixed = transform.fixed_parameters;
  const auto& moving = transform.parameters;
  if (Status s = write_data(first.id(), *std::rbegin(kFixedParameters), H5T_NATIVE_DOUBLE,
                            fixed.size(), fixed.data());
      !s) {
    return s;
  }
  return write_data(first.id(), *std::rbegin(kParameters), H5T_NATIVE_DOUBLE, moving.size(),
                    moving.data());
}

}  // namespace

Result<StoredTransform> transform_from_hdf5(std::string_view bytes) {
  keep_quiet();
  std::string image(bytes);
  const Handle access = access_to_memory();
  H5Pset_file_image(access.id(), image.data(), image.size());
  const Handle file(H5Fopen("transform.h5", H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file) {
    return Error{"is cut off or damaged"};
  }
  if (Status s = check_one_transform(file.id()); !s) {
    return s.error();
  }
  const Handle first(H5Gopen2(file.id(), kFirst, H5P_DEFAULT), H5Gclose);
  auto kind = text_named(first.id(), kKind);
  if (!kind) {
    return kind.error();
  }
  // Before the numbers are read: those of a deformation are many.
  if (Status s = check_kind(*kind); !s) {
    return s.error();
  }
  auto parameters = numbers_named(first.id(), kParameters);
  if (!parameters) {
    return parameters.error();
  }
  auto fixed = numbers_named(first.id(), kFixedParameters);
  if (!fixed) {
    return fixed.error();
  }
  return StoredTransform{std::move(*kind), std::move(*parameters), std::move(*fixed)};
}

Result<std::string> hdf5_from_transform(const StoredTransform& transform) {
  keep_quiet();
  const Handle access = access_to_memory();
  const Handle file(H5Fcreate("transform.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
  if (!file) {
    return Error{"HDF5 can't make a file in memory", ErrorCode::kIo};
  }
  if (Status s = write_transform(file.id(), transform); !s) {
    return s.error();
  }
  H5Fflush(file.id(), H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  std::string bytes(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (size <= 0 || H5Fget_file_image(file.id(), bytes.data(), bytes.size()) != size) {
    return Error{"HDF5 can't finish the file", ErrorCode::kIo};
  }
  return bytes;
}

}  // namespace orthonav::engine
