#pragma once

// A pool of queries of one type, and their results.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

class QueryPool {
public:
    /// No pool: for devices that have no use for one.
    QueryPool() = default;
    /// `count` queries of `type`, with a name (debug_names.h). Throws what vk_check() does.
    QueryPool(const DeviceContext& context, VkQueryType type, std::uint32_t count,
              const std::string& name);

    VkQueryPool handle() const noexcept { return pool_; }
    explicit operator bool() const noexcept { return pool_.get() != VK_NULL_HANDLE; }

    /// Records the reset of all queries, before their first use and between uses.
    void record_reset(Commands commands) const;

    /// Reads the results of the first `results.size()` queries, 32 or 64 bits each. Waits for them. Throws
    /// what vk_check() does.
    void read(std::span<std::uint32_t> results) const;
    void read(std::span<std::uint64_t> results) const;
    /// The same without waiting. False, with undefined results, where one of them is not there.
    bool read_if_there(std::span<std::uint64_t> results) const noexcept;

private:
    const DeviceFunctions* vk_ = nullptr;
    std::uint32_t count_ = 0;
    OwnedQueryPool pool_;
};

}  // namespace rimline
