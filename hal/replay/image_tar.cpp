#include "hal/replay/image_tar.h"

#include <archive.h>
#include <archive_entry.h>
#include <sys/types.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "hal/replay/layout.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

constexpr std::uint64_t kTarBlockBytes = 512;

struct FreeArchive {
  void operator()(archive* a) const { archive_read_free(a); }
};
using ArchiveReader = std::unique_ptr<archive, FreeArchive>;

std::string error_of(archive* a) {
  const char* text = archive_error_string(a);
  return text ? text : "unknown error";
}

std::string printable(const std::string& name) {
  std::string shown;
  for (const char c : name.substr(0, 60)) shown += c >= 32 && c < 127 ? c : '?';
  return shown;
}

/// Reads the fields of a PGM header: blanks and comments before each, one blank after the last.
class PgmHeader {
 public:
  explicit PgmHeader(std::string_view bytes) : bytes_(bytes) {}
  bool magic() {
    position_ = 2;
    return bytes_.substr(0, 2) == "P5";
  }
  std::optional<std::int64_t> number() {
    skip_blanks();
    const std::size_t begin = position_;
    while (position_ < bytes_.size() && is(&isdigit)) ++position_;
    if (begin == position_ || position_ - begin > 9) return std::nullopt;
    return parse_integer(bytes_.substr(begin, position_ - begin));
  }
  /// Bytes up to the first pixel.
  std::optional<std::size_t> end() {
    if (position_ >= bytes_.size() || !is(&isspace)) return std::nullopt;
    return position_ + 1;
  }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;

  bool is(int (*kind)(int)) const {
    return kind(static_cast<unsigned char>(bytes_[position_])) != 0;
  }
  void skip_blanks() {
    while (position_ < bytes_.size() && (is(&isspace) || bytes_[position_] == '#')) {
      if (bytes_[position_] == '#')
        while (position_ < bytes_.size() && bytes_[position_] != '\n') ++position_;
      else
        ++position_;
    }
  }
};

}  // namespace

Result<ImageTar> ImageTar::open(const std::filesystem::path& path, ImageLayout layout) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) return file_error(path, "no such file");
  if (!std::filesystem::is_regular_file(status)) return file_error(path, "is not a file");
  ImageTar tar;
  tar.path_ = path;
  tar.layout_ = std::move(layout);
  tar.file_.reset(std::fopen(path.c_str(), "rb"));
  if (!tar.file_) return file_error(path, "cannot be opened");
  if (Status indexed = tar.index(); !indexed) return indexed.error();
  return tar;
}

Status ImageTar::index() {
  std::error_code code;
  const std::uint64_t file_size = std::filesystem::file_size(path_, code);
  if (code) return file_error(path_, "cannot be read: " + code.message());
  const ArchiveReader reader(archive_read_new());
  archive_read_support_format_tar(reader.get());
  if (archive_read_open_filename(reader.get(), path_.c_str(), 64 * 1024) != ARCHIVE_OK)
    return file_error(path_, "is no tar archive: " + error_of(reader.get()));
  std::uint64_t end = 0;
  archive_entry* entry = nullptr;
  int answer = ARCHIVE_OK;
  while ((answer = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK) {
    const auto offset = static_cast<std::uint64_t>(archive_filter_bytes(reader.get(), 0));
    const auto size = static_cast<std::uint64_t>(archive_entry_size(entry));
    const char* name = archive_entry_pathname(entry);
    const bool plain = archive_entry_filetype(entry) == AE_IFREG &&
                       archive_entry_sparse_count(entry) == 0 &&
                       archive_entry_hardlink(entry) == nullptr;
    if (Status status = index_member(name ? name : "", plain, offset, size, file_size); !status)
      return status;
    end = (offset + size + kTarBlockBytes - 1) / kTarBlockBytes * kTarBlockBytes;
  }
  if (answer != ARCHIVE_EOF)
    return file_error(
        path_, "after " + std::to_string(members_.size()) + " images: " + error_of(reader.get()));
  if (Status status = check_end(end, file_size); !status) return status;
  const auto by_time = [](const ImageMember& a, const ImageMember& b) { return a.ticks < b.ticks; };
  std::stable_sort(members_.begin(), members_.end(), by_time);
  const auto same = [](const ImageMember& a, const ImageMember& b) { return a.ticks == b.ticks; };
  const auto last = std::unique(members_.begin(), members_.end(), same);
  repeated_ = members_.end() - last;
  members_.erase(last, members_.end());
  return {};
}

/// Of "<prefix><digits>.pgm".
std::optional<std::int64_t> ImageTar::ticks_in(std::string_view name) const {
  constexpr std::string_view kEnding = ".pgm";
  if (!name.starts_with(layout_.prefix) || !name.ends_with(kEnding) ||
      name.size() <= layout_.prefix.size() + kEnding.size())
    return std::nullopt;
  name.remove_prefix(layout_.prefix.size());
  name.remove_suffix(kEnding.size());
  const bool digits =
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  return digits ? parse_integer(name) : std::nullopt;
}

Status ImageTar::index_member(const char* name_text, bool plain, std::uint64_t offset,
                              std::uint64_t size, std::uint64_t file_size) {
  const std::string name(name_text);
  const std::string member = "member \"" + printable(name) + "\"";
  const auto ticks = ticks_in(name);
  if (!plain || !ticks)
    return file_error(path_, member + " is no image named " + layout_.prefix + "<ticks>.pgm");
  if (offset > file_size || size > file_size - offset)
    return file_error(path_, member + " is cut off: the archive is truncated at " +
                                 std::to_string(file_size) + " bytes");
  const auto header = pgm_header_bytes(name, offset, size);
  if (!header) return header.error();
  members_.push_back({*ticks, offset + *header});
  return {};
}

Result<std::uint64_t> ImageTar::pgm_header_bytes(const std::string& name, std::uint64_t offset,
                                                 std::uint64_t size) {
  const std::string member = "member \"" + printable(name) + "\" ";
  std::array<char, 256> bytes;
  const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(size, bytes.size()));
  if (!read_at(offset, bytes.data(), count)) return file_error(path_, member + "cannot be read");
  PgmHeader header(std::string_view(bytes.data(), count));
  if (!header.magic()) return file_error(path_, member + "is no binary PGM (P5)");
  const auto width = header.number();
  const auto height = header.number();
  const auto maximum = header.number();
  const auto end = header.end();
  if (!width || !height || !maximum || !end)
    return file_error(path_, member + "has a broken PGM header");
  if (*width != kImageWidthPx || *height != kImageHeightPx)
    return file_error(path_, member + "is " + std::to_string(*width) + "x" +
                                 std::to_string(*height) + " px, must be 640x480");
  if (*maximum != 255)
    return file_error(path_,
                      member + "has maximum grey " + std::to_string(*maximum) + ", must be 255");
  if (size != *end + kImageBytes)
    return file_error(path_, member + "holds " + std::to_string(size) + " bytes, must be " +
                                 std::to_string(*end + kImageBytes));
  return static_cast<std::uint64_t>(*end);
}

Status ImageTar::check_end(std::uint64_t end, std::uint64_t file_size) {
  if (members_.empty()) return file_error(path_, "holds no image");
  if (end + kTarBlockBytes > file_size)
    return file_error(path_, "has no end mark after " + std::to_string(members_.size()) +
                                 " images: the archive is truncated or was not finished");
  std::array<char, 4096> bytes;
  for (std::uint64_t at = end; at < file_size;) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), file_size - at));
    if (!read_at(at, bytes.data(), count)) return file_error(path_, "cannot be read to its end");
    const auto stray = std::find_if(bytes.data(), bytes.data() + count, [](char c) { return c; });
    if (stray != bytes.data() + count)
      return file_error(path_,
                        "goes on at byte " +
                            std::to_string(at + static_cast<std::uint64_t>(stray - bytes.data())) +
                            " after its end mark: a header is damaged");
    at += count;
  }
  return {};
}

bool ImageTar::read_at(std::uint64_t offset, void* bytes, std::size_t count) {
  return fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) == 0 &&
         std::fread(bytes, 1, count, file_.get()) == count;
}

Status ImageTar::read(const ImageMember& member, GreyImage& image) {
  image.width_px = kImageWidthPx;
  image.height_px = kImageHeightPx;
  image.pixels.resize(kImageBytes);
  if (read_at(member.pixels_offset, image.pixels.data(), kImageBytes)) return {};
  return file_error(path_, "image " + std::to_string(member.ticks) + ".pgm cannot be read");
}

}  // namespace orthonav::replay
