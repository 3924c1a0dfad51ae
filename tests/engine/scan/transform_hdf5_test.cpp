#include "engine/scan/transform_hdf5.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <vector>

#include "engine/scan/transform_file.h"
#include "tests/support/is_ok.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::transform_hdf5_test {
namespace {

using orthonav::test::error_of;
using orthonav::test::is_ok;
using orthonav::test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kAffine = "AffineTransform_double_3_3";
const std::vector<double> kNumbers = {1, 0, 0, 0, 0, -1, 0, 1, 0, 5, 11, 7};
const std::vector<double> kCentre = {0, 0, 0};

/// A file that is made by libhdf5 itself, piece by piece.
class Hdf5File {
 public:
  explicit Hdf5File(const std::string& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)) {}
  ~Hdf5File() { H5Fclose(file_); }
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  Hdf5File& group(const std::string& name) {
    H5Gclose(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    return *this;
  }
  /// As a text of fixed length.
  Hdf5File& text(const std::string& name, const std::string& value) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, value.size() + 1);
    write(name, type, 1, value.c_str());
    H5Tclose(type);
    return *this;
  }
  Hdf5File& numbers(const std::string& name, const std::vector<double>& values,
                    hid_t properties = H5P_DEFAULT) {
    return write(name, H5T_NATIVE_DOUBLE, values.size(), values.data(), properties);
  }
  Hdf5File& integers(const std::string& name, const std::vector<int>& values) {
    return write(name, H5T_NATIVE_INT, values.size(), values.data());
  }
  Hdf5File& link(const std::string& name, const std::string& other_file,
                 const std::string& path_there) {
    H5Lcreate_external(other_file.c_str(), path_there.c_str(), file_, name.c_str(), H5P_DEFAULT,
                       H5P_DEFAULT);
    return *this;
  }
  /// The numbered group, with the two groups above all its data.
  Hdf5File& start() { return group("/TransformGroup").group("/TransformGroup/0"); }
  /// All of one transform, in either spelling.
  Hdf5File& transform(const std::string& kind = kAffine, const std::string& spelt = "Transform") {
    return start()
        .text("/TransformGroup/0/TransformType", kind)
        .numbers("/TransformGroup/0/" + spelt + "Parameters", kNumbers)
        .numbers("/TransformGroup/0/" + spelt + "FixedParameters", kCentre);
  }

 private:
  Hdf5File& write(const std::string& name, hid_t type, hsize_t count, const void* values,
                  hid_t properties = H5P_DEFAULT) {
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t data =
        H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
    H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(data);
    H5Sclose(space);
    return *this;
  }

  hid_t file_;
};

std::string refusal(const std::string& path) {
  const std::string message = error_of(load_transform(path));
  EXPECT_THAT(message, HasSubstr(path + ": "));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
  return message;
}

TEST(TransformHdf5, ReadsBothSpellings) {
  const TemporaryFolder folder;
  for (const std::string spelt : {"Transform", "Tranform"}) {
    SCOPED_TRACE(spelt);
    const std::string path = folder.file(spelt + ".h5");
    Hdf5File(path).transform(kAffine, spelt);
    const auto read = load_transform(path);
    ASSERT_TRUE(is_ok(read));
    EXPECT_EQ(read->kind, kAffine);
    EXPECT_EQ(read->parameters, kNumbers);
    EXPECT_EQ(read->fixed_parameters, kCentre);
  }
}

TEST(TransformHdf5, RefusesWhatIsNotOneRigidTransform) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  Hdf5File(path).group("/Other");
  EXPECT_THAT(refusal(path), HasSubstr("has no /TransformGroup"));
  Hdf5File(path).group("/TransformGroup");
  EXPECT_THAT(refusal(path), HasSubstr("holds 0 transforms, must hold one"));
  Hdf5File(path).transform().group("/TransformGroup/1");
  EXPECT_THAT(refusal(path), HasSubstr("holds 2 transforms, must hold one"));
  Hdf5File(path).group("/TransformGroup").group("/TransformGroup/7");
  EXPECT_THAT(refusal(path), HasSubstr("has no /TransformGroup/0"));
  Hdf5File(path).transform("DisplacementFieldTransform_double_3_3");
  EXPECT_THAT(refusal(path), HasSubstr("is \"DisplacementFieldTransform_double_3_3\", must be"));
  Hdf5File(path).transform("two\nlines");
  EXPECT_THAT(refusal(path), HasSubstr("is \"two lines\", must be"));
}

TEST(TransformHdf5, RefusesDataOfAnotherSort) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  const std::string in = "/TransformGroup/0/";
  Hdf5File(path).start().numbers(in + "TransformType", kCentre);
  EXPECT_THAT(refusal(path), HasSubstr("/TransformGroup/0/TransformType is not text"));
  Hdf5File(path).start().text(in + "TransformType", kAffine);
  EXPECT_THAT(refusal(path), HasSubstr("has no /TransformGroup/0/TransformParameters"));
  Hdf5File(path)
      .start()
      .text(in + "TransformType", kAffine)
      .integers(in + "TransformParameters", {1, 2, 3});
  EXPECT_THAT(refusal(path), HasSubstr("TransformParameters holds no floating-point numbers"));
  Hdf5File(path)
      .start()
      .text(in + "TransformType", kAffine)
      .numbers(in + "TransformParameters", std::vector<double>(100000));
  EXPECT_THAT(refusal(path), HasSubstr("TransformParameters holds 100000 numbers, limit 64"));
  Hdf5File(path)
      .start()
      .text(in + "TransformType", kAffine)
      .numbers(in + "TransformParameters", {1, std::nan(""), 3})
      .numbers(in + "TransformFixedParameters", kCentre);
  EXPECT_THAT(refusal(path), HasSubstr("Parameters: \"nan\" is not a finite number"));
}

TEST(TransformHdf5, OpensNoOtherFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  const std::string other = folder.file("other.h5");
  Hdf5File(other).transform();
  Hdf5File(path).link("/TransformGroup", other, "/TransformGroup");
  EXPECT_THAT(refusal(path), HasSubstr("has no /TransformGroup"));
  Hdf5File(path).group("/TransformGroup").link("/TransformGroup/0", other, "/TransformGroup/0");
  EXPECT_THAT(refusal(path), HasSubstr("has no /TransformGroup/0"));

  const std::string raw = folder.with("secret.raw", std::string(96, '\0'));
  const hid_t elsewhere = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_external(elsewhere, raw.c_str(), 0, 96);
  Hdf5File(path)
      .start()
      .text("/TransformGroup/0/TransformType", kAffine)
      .numbers("/TransformGroup/0/TransformParameters", kNumbers, elsewhere)
      .numbers("/TransformGroup/0/TransformFixedParameters", kCentre);
  H5Pclose(elsewhere);
  EXPECT_THAT(refusal(path), HasSubstr("/TransformGroup/0/TransformParameters can't be read"));
}

}  // namespace
}  // namespace orthonav::engine::transform_hdf5_test
