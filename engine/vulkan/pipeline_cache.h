#pragma once

// A cache of compiled pipelines on disk, so that the second start of a program compiles nothing.
//
//     file: magic, size, checksum | what the driver gave, which begins with its own header
//
// A file that is damaged, of another driver or of another device is ignored and replaced. There is one file
// for each driver and device, named by the driver's UUID. Programs may share a folder: files are replaced as a
// whole, and the last one wins.

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

/// The file's bytes for what a driver gave, and back. Reading gives nothing for a file that is damaged or whose
/// driver's header does not name `properties`.
std::vector<std::byte> pipeline_file_of(std::span<const std::byte> driver_data);
std::span<const std::byte> driver_data_of(std::span<const std::byte> file,
                                          const VkPhysicalDeviceProperties& properties) noexcept;

class PipelineCache {
public:
    /// Reads the file of the context's device in `folder`, which need not exist. The context must outlive the
    /// cache. Throws what vk_check() does; whatever is wrong with files is no error.
    PipelineCache(const DeviceContext& context, const std::filesystem::path& folder);
    /// Writes the file where there is more to write than was read. Files that cannot be written are no error.
    ~PipelineCache();
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;

    VkPipelineCache handle() const noexcept { return cache_; }
    const std::filesystem::path& file() const noexcept { return file_; }

private:
    void save() const;

    const DeviceContext& context_;
    std::filesystem::path file_;
    std::vector<std::byte> read_;  // The file's bytes; empty where they were of no use.
    OwnedPipelineCache cache_;
};

}  // namespace rimline
