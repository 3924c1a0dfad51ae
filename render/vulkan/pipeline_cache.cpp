#include "render/vulkan/pipeline_cache.h"

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "base/fnv1a.h"
#include "render/vulkan/failure.h"

namespace orthonav::render {
namespace {

/// The header before the driver's own bytes. Drivers do not check the data they are given, so it is
/// checked here.
struct FileHead {
  std::array<char, 8> magic = {'o', 'n', 'p', 'i', 'p', 'e', '0', '1'};
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
};

std::uint64_t checksum_of(const std::vector<char>& bytes) {
  return fnv1a({bytes.data(), bytes.size()});
}

/// Named after device and driver, so that several can lie side by side and a new driver starts
/// afresh.
std::string file_name(VkPhysicalDevice physical) {
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physical, &properties);
  constexpr const char* kDigits = "0123456789abcdef";
  std::string name = "pipelines-";
  for (const std::uint8_t byte : properties.pipelineCacheUUID) {
    name += kDigits[byte >> 4];
    name += kDigits[byte & 15];
  }
  return name + '-' + std::to_string(properties.vendorID) + '-' +
         std::to_string(properties.deviceID) + '-' + std::to_string(properties.driverVersion) +
         ".bin";
}

std::vector<char> read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  FileHead head;
  const FileHead expected;
  file.read(reinterpret_cast<char*>(&head), sizeof(head));
  if (!file || head.magic != expected.magic) {
    return {};
  }
  std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (bytes.size() != head.bytes || checksum_of(bytes) != head.checksum) {
    return {};
  }
  return bytes;
}

/// Writes under another name first, so that a partly written file is never read.
void write_file(const std::string& path, const std::vector<char>& bytes) {
  std::error_code ignored;
  const std::filesystem::path target(path);
  std::filesystem::create_directories(target.parent_path(), ignored);
  const std::string part = path + '.' + std::to_string(getpid());
  FileHead head;
  head.bytes = bytes.size();
  head.checksum = checksum_of(bytes);
  std::ofstream file(part, std::ios::binary);
  file.write(reinterpret_cast<const char*>(&head), sizeof(head));
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (file) {
    std::filesystem::rename(part, target, ignored);
  }
  std::filesystem::remove(part, ignored);
}

}  // namespace

std::string user_cache_folder() {
  const auto value = [](const char* name) {
    const char* found = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): it is never set here
    return std::string(found != nullptr ? found : "");
  };
  // The XDG specification says that a relative folder is to be ignored.
  const std::string folder = value("XDG_CACHE_HOME");
  if (folder.starts_with('/')) {
    return folder + "/orthonav";
  }
  const std::string home = value("HOME");
  return home.starts_with('/') ? home + "/.cache/orthonav" : "";
}

PipelineCache::PipelineCache(const Device& device, VkPhysicalDevice physical,
                             const std::string& folder)
    : device_(device.get()) {
  std::vector<char> bytes;
  if (!folder.empty()) {
    path_ = folder + '/' + file_name(physical);
    bytes = read_file(path_);
  }
  VkPipelineCacheCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = bytes.size();
  info.pInitialData = bytes.data();
  VkPipelineCache cache = VK_NULL_HANDLE;
  check(vkCreatePipelineCache(device_, &info, nullptr, &cache), "pipeline cache");
  cache_ = PipelineCacheHandle(device_, cache);
  read_bytes_ = bytes.size();
}

PipelineCache::~PipelineCache() {
  try {
    save();
  } catch (const std::exception&) {  // the next start merely compiles again
  }
}

void PipelineCache::save() const {
  if (path_.empty()) {
    return;
  }
  std::size_t count = 0;
  if (vkGetPipelineCacheData(device_, cache_.get(), &count, nullptr) != VK_SUCCESS) {
    return;
  }
  if (count == read_bytes_) {
    return;
  }
  std::vector<char> bytes(count);
  if (vkGetPipelineCacheData(device_, cache_.get(), &count, bytes.data()) != VK_SUCCESS) {
    return;
  }
  bytes.resize(count);
  write_file(path_, bytes);
}

}  // namespace orthonav::render
