#include "engine/vulkan/pipeline_cache.h"

#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

namespace rimline {

namespace {

// In the byte order of the machine, as the driver's data.
struct FileHeader {
    std::array<char, 8> magic;
    std::uint64_t size_bytes;  // Of the driver's data.
    std::uint64_t checksum;    // Of the driver's data.
};
constexpr std::array k_magic{'R', 'I', 'M', 'P', 'I', 'P', 'E', '1'};
constexpr std::uintmax_t k_max_file_bytes = std::uintmax_t{1} << 28;

// FNV-1a of 64 bits.
std::uint64_t checksum(std::span<const std::byte> data) noexcept {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::byte byte : data)
        hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3u;
    return hash;
}

std::string name_of(const VkPhysicalDeviceProperties& properties) {
    constexpr const char* k_digits = "0123456789abcdef";
    std::string name = "pipelines-";
    for (const std::uint8_t byte : properties.pipelineCacheUUID) {
        name += k_digits[byte >> 4];
        name += k_digits[byte & 15];
    }
    return name + ".bin";
}

std::vector<std::byte> read_file(const std::filesystem::path& path) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size > k_max_file_bytes) return {};
    std::vector<std::byte> bytes(size);
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) return {};
    return bytes;
}

// Replaces the file at once, so that no program ever reads a part of it.
void replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::error_code ignored;
    std::filesystem::create_directories(path.parent_path(), ignored);
    const std::filesystem::path draft = path.string() + "." + std::to_string(getpid());
    std::ofstream file(draft, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    file.close();
    if (file)
        std::filesystem::rename(draft, path, ignored);
    else
        std::filesystem::remove(draft, ignored);
}

VkPhysicalDeviceProperties properties_of(const DeviceContext& context) {
    VkPhysicalDeviceProperties properties;
    context.vk->GetPhysicalDeviceProperties(context.physical_device, &properties);
    return properties;
}

}  // namespace

std::vector<std::byte> pipeline_file_of(std::span<const std::byte> driver_data) {
    const FileHeader header{k_magic, driver_data.size(), checksum(driver_data)};
    std::vector<std::byte> file(sizeof header + driver_data.size());
    std::memcpy(file.data(), &header, sizeof header);
    if (!driver_data.empty())
        std::memcpy(file.data() + sizeof header, driver_data.data(), driver_data.size());
    return file;
}

std::span<const std::byte> driver_data_of(std::span<const std::byte> file,
                                          const VkPhysicalDeviceProperties& properties) noexcept {
    FileHeader header;
    VkPipelineCacheHeaderVersionOne driver;
    if (file.size() < sizeof header + sizeof driver) return {};
    std::memcpy(&header, file.data(), sizeof header);
    const std::span<const std::byte> data = file.subspan(sizeof header);
    if (header.magic != k_magic || header.size_bytes != data.size() ||
        header.checksum != checksum(data))
        return {};
    std::memcpy(&driver, data.data(), sizeof driver);
    const bool is_ours =
        driver.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
        driver.vendorID == properties.vendorID && driver.deviceID == properties.deviceID &&
        std::memcmp(driver.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
    return is_ours ? data : std::span<const std::byte>{};
}

PipelineCache::PipelineCache(const DeviceContext& context, const std::filesystem::path& folder)
    : context_(context) {
    const VkPhysicalDeviceProperties properties = properties_of(context);
    file_ = folder / name_of(properties);
    read_ = read_file(file_);
    const std::span<const std::byte> data = driver_data_of(read_, properties);
    if (data.empty()) read_.clear();
    const VkPipelineCacheCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                                         .initialDataSize = data.size(),
                                         .pInitialData = data.data()};
    VkPipelineCache cache = VK_NULL_HANDLE;
    vk_check(context.vk->CreatePipelineCache(context.device, &info, nullptr, &cache),
             "vkCreatePipelineCache");
    cache_ = {context, cache};
}

PipelineCache::~PipelineCache() {
    try {
        save();
    } catch (...) {
        // Without memory there is no file.
    }
}

void PipelineCache::save() const {
    std::size_t size = 0;
    if (context_.vk->GetPipelineCacheData(context_.device, cache_, &size, nullptr) != VK_SUCCESS)
        return;
    std::vector<std::byte> data(size);
    if (context_.vk->GetPipelineCacheData(context_.device, cache_, &size, data.data()) !=
        VK_SUCCESS)
        return;
    const std::vector<std::byte> file = pipeline_file_of(std::span(data).first(size));
    if (file != read_) replace_file(file_, file);
}

}  // namespace rimline
