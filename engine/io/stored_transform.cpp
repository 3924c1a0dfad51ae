#include "engine/io/stored_transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/one_line.h"

namespace orthonav::engine {
namespace {

using Numbers = std::vector<double>;

struct Parent;
struct Node;

/// What a kind's parameters say before the centre is taken into account.
struct Motion {
  Mat3 linear;
  Vec3 translation_mm;
};

Vec3 three(const Numbers& p, std::size_t from) { return {p[from], p[from + 1], p[from + 2]}; }

Result<Motion> from_matrix(const Numbers& p, const Numbers& /*fixed*/) {
  return Motion{{{{{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}}}}, three(p, 9)};
}

/// itk::Euler3DTransform: Z·X·Y, or Z·Y·X where a fourth fixed parameter says so.
Result<Motion> from_euler(const Numbers& p, const Numbers& fixed) {
  const Mat3 x = rotation_from_vector({p[0], 0, 0});
  const Mat3 y = rotation_from_vector({0, p[1], 0});
  const Mat3 z = rotation_from_vector({0, 0, p[2]});
  const bool zyx = fixed.size() == 4 && fixed[3] != 0.0;
  return Motion{zyx ? z * y * x : z * x * y, three(p, 3)};
}

/// itk::VersorRigid3DTransform keeps the vector of a unit quaternion whose w is not negative.
Result<Motion> from_versor(const Numbers& p, const Numbers& /*fixed*/) {
  // A turn by 180° in numbers that were rounded.
  constexpr double kRounding = 1e-6;
  const Vec3 v = three(p, 0);
  const double length = v.norm();
  if (!(length <= 1.0 + kRounding)) {
    return Error{"has a versor of length " + std::to_string(length) + ", limit 1"};
  }
  if (length >= 1.0) {
    return Motion{rotation_from_quaternion({v.x / length, v.y / length, v.z / length, 0.0}),
                  three(p, 3)};
  }
  return Motion{rotation_from_quaternion({v.x, v.y, v.z, std::sqrt(1.0 - length * length)}),
                three(p, 3)};
}

Result<Motion> from_similarity(const Numbers& p, const Numbers& fixed) {
  auto motion = from_versor(p, fixed);
  if (motion) {
    const double scale = p[6];
    Mat3& m = motion->linear;
    m = Mat3::from_columns(scale * m.column(0), scale * m.column(1), scale * m.column(2));
  }
  return motion;
}

struct RigidKind {
  std::string_view name;
  std::size_t parameters;
  std::size_t most_fixed;
  Result<Motion> (*motion)(const Numbers& parameters, const Numbers& fixed);
};
constexpr std::array<RigidKind, 5> kKinds = {{{"AffineTransform", 12, 3, from_matrix},
                                              {"MatrixOffsetTransformBase", 12, 3, from_matrix},
                                              {"Euler3DTransform", 6, 4, from_euler},
                                              {"VersorRigid3DTransform", 6, 3, from_versor},
                                              {"Similarity3DTransform", 7, 3, from_similarity}}};

const RigidKind* kind_named(std::string_view name) {
  for (const std::string_view numbers : {"_double_3_3", "_float_3_3"}) {
    if (name.ends_with(numbers)) {
      name.remove_suffix(numbers.size());
      const auto* const found = std::find_if(kKinds.begin(), kKinds.end(),
                                             [&](const RigidKind& k) { return k.name == name; });
      return found == kKinds.end() ? nullptr : found;
    }
  }
  return nullptr;
}

Status check_count(const char* what, std::size_t count, std::size_t least, std::size_t most) {
  if (count >= least && count <= most) {
    return {};
  }
  return Error{"has " + std::to_string(count) + " " + what + ", must have " +
               std::to_string(least)};
}

Status check_finite(const Numbers& numbers, const char* what) {
  const bool finite = std::all_of(numbers.begin(), numbers.end(),
                                  [](double number) { return std::isfinite(number); });
  return finite ? Status{} : Status{Error{std::string("has ") + what + " that are not finite"}};
}

Status check_numbers(const RigidKind& kind, const StoredTransform& stored) {
  constexpr std::size_t kCentre = 3;
  if (Status s =
          check_count("parameters", stored.parameters.size(), kind.parameters, kind.parameters);
      !s) {
    return s;
  }
  if (Status s =
          check_count("fixed parameters", stored.fixed_parameters.size(), kCentre, kind.most_fixed);
      !s) {
    return s;
  }
  if (Status s = check_finite(stored.parameters, "parameters"); !s) {
    return s;
  }
  return check_finite(stored.fixed_parameters, "fixed parameters");
}

}  // namespace

Status check_kind(const std::string& kind) {
  constexpr std::size_t kShown = 60;
  if (kind_named(kind) != nullptr) {
    return {};
  }
  return Error{"is \"" + one_line(kind.substr(0, kShown)) +
               "\", must be an AffineTransform, MatrixOffsetTransformBase, Euler3DTransform, "
               "VersorRigid3DTransform or Similarity3DTransform of three dimensions"};
}

Result<NodeFromParent> node_from_parent(const StoredTransform& stored) {
  // What a landmark registration and rounding to four or five digits leave.
  constexpr double kMostShear = 1e-4;
  constexpr double kMetresPerMillimetre = 1e-3;
  if (Status s = check_kind(stored.kind); !s) {
    return s.error();
  }
  const RigidKind& kind = *kind_named(stored.kind);
  if (Status s = check_numbers(kind, stored); !s) {
    return s.error();
  }
  const auto motion = kind.motion(stored.parameters, stored.fixed_parameters);
  if (!motion) {
    return motion.error();
  }
  // First the rotation, then the offset, so that rounded numbers still turn about the centre.
  const auto rotation = Transform<Node, Parent>::checked(motion->linear, {}, kMostShear);
  if (!rotation) {
    return rotation.error();
  }
  const Vec3 centre_mm = three(stored.fixed_parameters, 0);
  const Vec3 offset_mm = motion->translation_mm + centre_mm - rotation->rotation() * centre_mm;
  if (!offset_mm.is_finite()) {
    return Error{"has a translation that is not finite"};
  }
  return NodeFromParent{rotation->rotation(), kMetresPerMillimetre * offset_mm};
}

StoredTransform stored_from(const NodeFromParent& motion) {
  StoredTransform stored{"AffineTransform_double_3_3", {}, {0, 0, 0}};
  for (int row = 0; row < 3; ++row) {
    const Vec3 r = motion.rotation.row(row);
    stored.parameters.insert(stored.parameters.end(), {r.x, r.y, r.z});
  }
  const Vec3 t_mm = 1e3 * motion.translation_m;
  stored.parameters.insert(stored.parameters.end(), {t_mm.x, t_mm.y, t_mm.z});
  return stored;
}

}  // namespace orthonav::engine
