#include "hal/replay/image_tar.h"

#include <archive.h>
#include <archive_entry.h>
#include <sys/types.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <string>
#include <string_view>

#include "base/check.h"
#include "hal/replay/layout.h"
#include "hal/replay/png_picture.h"
#include "hal/replay/text.h"

namespace orthonav::replay {
namespace {

constexpr std::uint64_t kTarBlockBytes = 512;

struct FreeArchive {
  void operator()(archive* a) const { archive_read_free(a); }
};
using ArchiveReader = std::unique_ptr<archive, FreeArchive>;

std::uint64_t in_blocks(std::uint64_t bytes) {
  return (bytes + kTarBlockBytes - 1) / kTarBlockBytes * kTarBlockBytes;
}

std::string error_of(archive* a) {
  const char* text = archive_error_string(a);
  return text ? text : "unknown error";
}

/// Passes on the members until one is refused or extends past the file's end; returns libarchive's
/// last result.
template <class Take>
Result<int> for_each_member(archive* reader, std::uint64_t file_size, const Take& take) {
  archive_entry* entry = nullptr;
  int answer = ARCHIVE_OK;
  while ((answer = archive_read_next_header(reader, &entry)) == ARCHIVE_OK) {
    const auto offset = static_cast<std::uint64_t>(archive_filter_bytes(reader, 0));
    const auto size = static_cast<std::uint64_t>(archive_entry_size(entry));
    const char* name = archive_entry_pathname(entry);
    const bool plain = archive_entry_filetype(entry) == AE_IFREG &&
                       archive_entry_sparse_count(entry) == 0 &&
                       archive_entry_hardlink(entry) == nullptr;
    if (offset > file_size || size > file_size - offset) {
      break;
    }
    if (const Status taken = take(name ? name : "", plain, offset, size); !taken) {
      return taken.error();
    }
  }
  return answer;
}

std::string printable(const std::string& name) {
  std::string shown;
  for (const char c : name.substr(0, 60)) {
    shown += c >= 32 && c < 127 ? c : '?';
  }
  return shown;
}

std::string size_text(std::int64_t width_px, std::int64_t height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

/// Sorts by time and removes repeated times; returns how many were removed.
std::int64_t sort_unique(std::vector<ImageMember>& members) {
  const auto by_time = [](const ImageMember& a, const ImageMember& b) { return a.ticks < b.ticks; };
  std::stable_sort(members.begin(), members.end(), by_time);
  const auto same = [](const ImageMember& a, const ImageMember& b) { return a.ticks == b.ticks; };
  const auto last = std::unique(members.begin(), members.end(), same);
  const std::int64_t repeated = members.end() - last;
  members.erase(last, members.end());
  return repeated;
}

}  // namespace

Result<ImageTar> ImageTar::open(const std::filesystem::path& path, ImageLayout layout) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) {
    return file_error(path, "no such file", ErrorCode::kNotFound);
  }
  if (!std::filesystem::is_regular_file(status)) {
    return file_error(path, "is not a file");
  }
  ImageTar tar;
  tar.path_ = path;
  tar.layout_ = std::move(layout);
  tar.file_.reset(std::fopen(path.c_str(), "rb"));
  if (!tar.file_) {
    return file_error(path, "cannot be opened", ErrorCode::kIo);
  }
  if (Status indexed = tar.index(); !indexed) {
    return indexed.error();
  }
  return tar;
}

Status ImageTar::index() {
  std::error_code code;
  const std::uint64_t file_size = std::filesystem::file_size(path_, code);
  if (code) {
    return file_error(path_, "cannot be read: " + code.message(), ErrorCode::kIo);
  }
  if (file_size == 0) {
    return no_whole_image(file_size);  // libarchive does not recognize it
  }
  const ArchiveReader reader(archive_read_new());
  archive_read_support_format_tar(reader.get());
  if (archive_read_open_filename(reader.get(), path_.c_str(), 64 * 1024) != ARCHIVE_OK) {
    return file_error(path_, "is not a tar archive: " + error_of(reader.get()));
  }
  const auto answer =
      for_each_member(reader.get(), file_size,
                      [&](const char* name, bool plain, std::uint64_t offset, std::uint64_t size) {
                        const Status indexed = index_member(name, plain, offset, size);
                        if (indexed) {
                          whole_bytes_ = in_blocks(offset + size);
                        }
                        return indexed;
                      });
  if (!answer) {
    return answer.error();
  }
  const bool is_cut = *answer == ARCHIVE_OK || whole_bytes_ + kTarBlockBytes > file_size;
  if (is_cut) {
    cut_ = path_.filename().string() + " is cut off at byte " + std::to_string(file_size) +
           ", after " + std::to_string(members_.size()) + " whole images";
  } else if (*answer != ARCHIVE_EOF) {
    return file_error(
        path_, "after " + std::to_string(members_.size()) + " images: " + error_of(reader.get()));
  }
  if (Status status = check_end(file_size); !status) {
    return status;
  }
  repeated_ = sort_unique(members_) + sort_unique(brightness_);
  return {};
}

/// Parses "<prefix><digits>.pgm", or "<prefix><digits>_ab.pgm" or "<prefix><digits>.png" if the
/// layout has such images.
std::optional<ImageTar::Name> ImageTar::parsed(std::string_view name) const {
  constexpr std::size_t kEndingBytes = 4;
  constexpr std::string_view kBrightness = "_ab";
  const bool png = layout_.pixels == PixelKind::kGrey8 && name.ends_with(".png");
  if (!name.starts_with(layout_.prefix) || (!png && !name.ends_with(".pgm")) ||
      name.size() <= layout_.prefix.size() + kEndingBytes) {
    return std::nullopt;
  }
  name.remove_prefix(layout_.prefix.size());
  name.remove_suffix(kEndingBytes);
  const bool brightness = layout_.with_brightness && name.ends_with(kBrightness);
  if (brightness) {
    name.remove_suffix(kBrightness.size());
  }
  const bool digits =
      std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const auto ticks = digits ? parse_integer(name) : std::nullopt;
  return ticks ? std::optional(Name{*ticks, brightness, png}) : std::nullopt;
}

Status ImageTar::index_member(const char* name_text, bool plain, std::uint64_t offset,
                              std::uint64_t size) {
  const std::string name(name_text);
  const std::string member = "member \"" + printable(name) + "\" ";
  const auto known = parsed(name);
  if (!plain || !known) {
    return file_error(path_, member + "is not an image named " + layout_.prefix + "<ticks>.pgm" +
                                 (layout_.pixels == PixelKind::kGrey8 ? " or <ticks>.png" : "") +
                                 (layout_.with_brightness ? " or <ticks>_ab.pgm" : ""));
  }
  const auto image = image_of(*known, offset, size);
  if (!image) {
    return file_error(path_, member + image.error().message, image.error().code);
  }
  (known->brightness ? brightness_ : members_).push_back(*image);
  return {};
}

Result<ImageMember> ImageTar::image_of(const Name& name, std::uint64_t offset, std::uint64_t size) {
  std::array<char, 256> bytes;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(size, bytes.size()));
  if (!read_at(offset, bytes.data(), count)) {
    return Error{"cannot be read", ErrorCode::kIo};
  }
  if (name.png) {
    const auto header = parse_png_header(std::string_view(bytes.data(), count));
    if (!header) {
      return header.error();
    }
    if (Status s = check_size(header->width_px, header->height_px); !s) {
      return s.error();
    }
    if (!header->grey8) {
      return Error{"is not a PNG of eight bits of grey"};
    }
    return ImageMember{name.ticks, offset, size, true};
  }
  const auto header = parse_pgm_header(std::string_view(bytes.data(), count));
  if (!header) {
    return header.error();
  }
  if (Status s = check_size(header->width_px, header->height_px); !s) {
    return s.error();
  }
  const std::int64_t maximum = layout_.pixels == PixelKind::kGrey8 ? 255 : 65535;
  if (header->maximum != maximum) {
    return Error{"has maximum grey " + std::to_string(header->maximum) + ", must be " +
                 std::to_string(maximum)};
  }
  const std::uint64_t expected = header->bytes + image_bytes();
  if (size != expected) {
    return Error{"holds " + std::to_string(size) + " bytes, must be " + std::to_string(expected)};
  }
  return ImageMember{name.ticks, offset + header->bytes, image_bytes()};
}

/// The first image decides if the layout does not state a size.
Status ImageTar::check_size(std::int64_t width_px, std::int64_t height_px) {
  if (layout_.width_px == 0) {
    const auto fits = [](std::int64_t side) {
      return side >= kMinDepthSidePx && side <= kMaxDepthSidePx;
    };
    if (!fits(width_px) || !fits(height_px)) {
      return Error{"is " + size_text(width_px, height_px) + " px, each side must be " +
                   std::to_string(kMinDepthSidePx) + " to " + std::to_string(kMaxDepthSidePx)};
    }
    layout_.width_px = static_cast<int>(width_px);
    layout_.height_px = static_cast<int>(height_px);
  }
  if (width_px != layout_.width_px || height_px != layout_.height_px) {
    return Error{"is " + size_text(width_px, height_px) + " px, must be " +
                 size_text(layout_.width_px, layout_.height_px)};
  }
  return {};
}

std::size_t ImageTar::image_bytes() const {
  const std::size_t a_pixel = layout_.pixels == PixelKind::kGrey8 ? 1 : 2;
  return a_pixel * static_cast<std::size_t>(layout_.width_px) *
         static_cast<std::size_t>(layout_.height_px);
}

std::uint64_t ImageTar::end_of(const ImageMember& member) const {
  return in_blocks(member.offset + member.bytes);
}

Error ImageTar::no_whole_image(std::uint64_t file_size) const {
  return file_error(path_, "holds no whole image: is cut off at byte " + std::to_string(file_size));
}

Status ImageTar::check_end(std::uint64_t file_size) {
  if (members_.empty()) {
    return cut_.empty() ? file_error(path_, "holds no image") : no_whole_image(file_size);
  }
  if (!cut_.empty()) {
    return {};
  }
  std::array<char, 4096> bytes;
  for (std::uint64_t at = whole_bytes_; at < file_size;) {
    const auto count =
        static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), file_size - at));
    if (!read_at(at, bytes.data(), count)) {
      return file_error(path_, "cannot be read to its end", ErrorCode::kIo);
    }
    const auto stray = std::find_if(bytes.data(), bytes.data() + count, [](char c) { return c; });
    if (stray != bytes.data() + count) {
      return file_error(path_,
                        "goes on at byte " +
                            std::to_string(at + static_cast<std::uint64_t>(stray - bytes.data())) +
                            " after its end mark: a header is damaged");
    }
    at += count;
  }
  return {};
}

bool ImageTar::read_at(std::uint64_t offset, void* bytes, std::size_t count) {
  return fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) == 0 &&
         std::fread(bytes, 1, count, file_.get()) == count;
}

template <class Value>
Status ImageTar::read_pixels(const ImageMember& member, PlainImage<Value>& image) {
  image.width_px = layout_.width_px;
  image.height_px = layout_.height_px;
  image.pixels.resize(image_bytes() / sizeof(Value));
  if (read_at(member.offset, image.pixels.data(), image_bytes())) {
    return {};
  }
  return file_error(path_, "image " + std::to_string(member.ticks) + ".pgm cannot be read",
                    ErrorCode::kIo);
}

Status ImageTar::read(const ImageMember& member, GreyImage& image) {
  ORTHONAV_CHECK(layout_.pixels == PixelKind::kGrey8);
  if (!member.png) {
    return read_pixels(member, image);
  }
  const std::string name = "image " + std::to_string(member.ticks) + ".png ";
  encoded_.resize(static_cast<std::size_t>(member.bytes));
  if (!read_at(member.offset, encoded_.data(), encoded_.size())) {
    return file_error(path_, name + "cannot be read", ErrorCode::kIo);
  }
  image.width_px = layout_.width_px;
  image.height_px = layout_.height_px;
  image.pixels.resize(image_bytes());
  const Status decoded = decode_png(encoded_, image);
  return decoded ? Status() : file_error(path_, name + "is damaged: " + decoded.error().message);
}

Status ImageTar::read(const ImageMember& member, DepthImage& image) {
  ORTHONAV_CHECK(layout_.pixels != PixelKind::kGrey8);
  if (Status s = read_pixels(member, image); !s) {
    return s;
  }
  static_assert(std::endian::native == std::endian::little);
  if (layout_.pixels == PixelKind::kBigEndian16) {
    for (std::uint16_t& pixel : image.pixels) {
      pixel = static_cast<std::uint16_t>(pixel << 8U | pixel >> 8U);
    }
  }
  return {};
}

}  // namespace orthonav::replay
