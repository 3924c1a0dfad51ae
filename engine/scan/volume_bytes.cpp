#include "engine/scan/volume_bytes.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "base/number_bytes.h"
#include "base/write_all.h"

namespace orthonav::engine {
namespace {

static_assert(std::is_trivially_copyable_v<VolumeGrid>);

void put_text(std::string& bytes, const std::string& text) {
  put(bytes, std::uint64_t{text.size()});
  bytes += text;
}

std::string take_text(std::string_view& bytes) {
  const auto size = take<std::uint64_t>(bytes);
  std::string text(bytes.substr(0, size));
  bytes.remove_prefix(text.size());
  return text;
}

}  // namespace

bool write_volume(int file, const Result<Volume>& volume) {
  std::string head;
  put(head, volume.ok());
  if (!volume) {
    put(head, volume.error().code);
    put_text(head, volume.error().message);
    return write_all(file, head) == 0;
  }
  put(head, volume->grid);
  put(head, std::uint64_t{volume->layers});
  put(head, std::uint64_t{volume->fields.size()});
  for (const auto& [name, value] : volume->fields) {
    put_text(head, name);
    put_text(head, value);
  }
  put(head, std::uint64_t{volume->notes.size()});
  for (const std::string& note : volume->notes) {
    put_text(head, note);
  }
  put(head, std::uint64_t{volume->values.size()});
  return write_all(file, head) == 0 &&
         write_all(file, {reinterpret_cast<const char*>(volume->values.data()),
                          volume->values.size() * sizeof(float)}) == 0;
}

Result<Volume> volume_of(std::string_view bytes) {
  if (!take<bool>(bytes)) {
    const auto code = take<ErrorCode>(bytes);
    return Error{take_text(bytes), code};
  }
  Volume volume;
  volume.grid = take<VolumeGrid>(bytes);
  volume.layers = take<std::uint64_t>(bytes);
  for (auto fields = take<std::uint64_t>(bytes); fields > 0; --fields) {
    const std::string name = take_text(bytes);
    volume.fields[name] = take_text(bytes);
  }
  for (auto notes = take<std::uint64_t>(bytes); notes > 0; --notes) {
    volume.notes.push_back(take_text(bytes));
  }
  const auto count = take<std::uint64_t>(bytes);
  if (bytes.size() != count * sizeof(float)) {
    return Error{"its voxels did not all arrive from its reader", ErrorCode::kIo};
  }
  volume.values.resize(count);
  std::memcpy(volume.values.data(), bytes.data(), bytes.size());
  return volume;
}

bool write_series(int file, const std::vector<SeriesSummary>& series) {
  std::string bytes;
  put(bytes, std::uint64_t{series.size()});
  for (const SeriesSummary& each : series) {
    for (const std::string* text : {&each.uid, &each.description, &each.modality, &each.problem}) {
      put_text(bytes, *text);
    }
    put(bytes, each.slices);
    put(bytes, each.size);
    put(bytes, each.spacing_m);
    put(bytes, each.tilt_deg);
  }
  return write_all(file, bytes) == 0;
}

std::vector<SeriesSummary> series_of(std::string_view bytes) {
  std::vector<SeriesSummary> series;
  for (auto count = take<std::uint64_t>(bytes); count > 0; --count) {
    SeriesSummary each;
    for (std::string* text : {&each.uid, &each.description, &each.modality, &each.problem}) {
      *text = take_text(bytes);
    }
    each.slices = take<int>(bytes);
    each.size = take<std::array<int, 2>>(bytes);
    each.spacing_m = take<std::array<double, 3>>(bytes);
    each.tilt_deg = take<double>(bytes);
    series.push_back(std::move(each));
  }
  return series;
}

}  // namespace orthonav::engine
