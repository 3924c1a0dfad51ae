#include "engine/case/prepared_parts_file.h"

#include <zlib.h>

#include <bit>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "base/printed.h"

namespace orthonav::engine {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");
static_assert(sizeof(Vec3) == 3 * sizeof(double) && std::is_trivially_copyable_v<Vec3>);

constexpr std::string_view kMagic = "ORTHONAV-MODEL\r\n";
constexpr std::uint32_t kLayout = 1;

/// Only numbers, without gaps between them: the same in the file as in memory.
struct Header {
  char magic[16] = {};
  std::uint32_t layout = kLayout;
  std::uint32_t preparation = nav::kPreparationVersion;
  std::uint32_t vertices_crc = 0;
  std::uint32_t triangles_crc = 0;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint64_t reachable = 0;
  std::uint64_t closest = 0;
  std::uint64_t distances = 0;
};
static_assert(sizeof(Header) == 72);
constexpr std::size_t kCrcBytes = sizeof(std::uint32_t);

std::uint32_t crc_of(const void* bytes, std::size_t size) {
  return static_cast<std::uint32_t>(
      crc32_z(crc32_z(0, nullptr, 0), static_cast<const Bytef*>(bytes), size));
}

template <class T>
void append(std::string& out, std::span<const T> numbers) {
  out.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

/// Moves `from` past the bytes that were read.
template <class T>
std::vector<T> take(std::string_view& from, std::uint64_t count) {
  std::vector<T> numbers(count);
  const std::size_t size = count * sizeof(T);
  if (size > 0) {
    std::memcpy(numbers.data(), from.data(), size);
  }
  from.remove_prefix(size);
  return numbers;
}

Status check(const Header& header, std::size_t size, const MeshKey& key) {
  if (std::string_view(header.magic, sizeof header.magic) != kMagic) {
    return Error{"is not a prepared model"};
  }
  if (header.layout != kLayout || header.preparation != nav::kPreparationVersion) {
    return Error{"is of version " + std::to_string(header.layout) + "." +
                 std::to_string(header.preparation) + ", current is " + std::to_string(kLayout) +
                 "." + std::to_string(nav::kPreparationVersion)};
  }
  if (MeshKey{header.vertices, header.triangles, header.vertices_crc, header.triangles_crc} !=
      key) {
    return Error{"is of another mesh"};
  }
  // Each is checked on its own first, so that the sum can't overflow.
  if (header.reachable > size || header.closest > size || header.distances > size ||
      sizeof(Header) + header.reachable * sizeof(std::uint32_t) + header.closest * sizeof(Vec3) +
              header.distances * sizeof(float) + kCrcBytes !=
          size) {
    return Error{"is damaged: not as long as it says"};
  }
  return {};
}

}  // namespace

MeshKey MeshKey::of(const nav::TriangleMesh& mesh) {
  return {mesh.vertices_m.size(), mesh.triangles.size(),
          crc_of(mesh.vertices_m.data(), mesh.vertices_m.size() * sizeof(Vec3)),
          crc_of(mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]))};
}

std::string MeshKey::text() const { return printed("%08x%08x", vertices_crc, triangles_crc); }

std::string encoded(const MeshKey& key, const nav::PreparedParts& parts) {
  Header header;
  std::memcpy(header.magic, kMagic.data(), sizeof header.magic);
  header.vertices_crc = key.vertices_crc;
  header.triangles_crc = key.triangles_crc;
  header.vertices = key.vertices;
  header.triangles = key.triangles;
  header.reachable = parts.reachable.size();
  header.closest = parts.closest_m.size();
  header.distances = parts.distance_m.size();
  std::string out;
  append(out, std::span<const Header>(&header, 1));
  append(out, std::span<const std::uint32_t>(parts.reachable));
  append(out, std::span<const Vec3>(parts.closest_m));
  append(out, std::span<const float>(parts.distance_m));
  const std::uint32_t crc = crc_of(out.data(), out.size());
  append(out, std::span<const std::uint32_t>(&crc, 1));
  return out;
}

Result<nav::PreparedParts> decoded(std::string_view bytes, const MeshKey& key) {
  if (bytes.size() < sizeof(Header) + kCrcBytes || bytes.size() > kMaxPartsBytes) {
    return Error{"is damaged: " + std::to_string(bytes.size()) + " bytes long"};
  }
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (const Status s = check(header, bytes.size(), key); !s) {
    return s.error();
  }
  std::uint32_t crc = 0;
  std::memcpy(&crc, bytes.data() + bytes.size() - kCrcBytes, kCrcBytes);
  if (crc != crc_of(bytes.data(), bytes.size() - kCrcBytes)) {
    return Error{"is damaged: its checksum is wrong"};
  }
  bytes.remove_prefix(sizeof header);
  nav::PreparedParts parts;
  parts.reachable = take<std::uint32_t>(bytes, header.reachable);
  parts.closest_m = take<Vec3>(bytes, header.closest);
  parts.distance_m = take<float>(bytes, header.distances);
  return parts;
}

}  // namespace orthonav::engine
