#include "engine/vulkan/query_pool.h"

#include "engine/vulkan/debug_names.h"

namespace rimline {

QueryPool::QueryPool(const DeviceContext& context, VkQueryType type, std::uint32_t count,
                     const std::string& name)
    : vk_(context.vk.get()), count_(count) {
    const VkQueryPoolCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = type, .queryCount = count};
    VkQueryPool pool = VK_NULL_HANDLE;
    vk_check(context.vk->CreateQueryPool(context.device, &info, nullptr, &pool),
             "vkCreateQueryPool");
    pool_ = {context, pool};
    set_name(*context.vk, VK_OBJECT_TYPE_QUERY_POOL, pool, name);
}

void QueryPool::record_reset(Commands commands) const {
    commands->CmdResetQueryPool(commands, pool_, 0, count_);
}

void QueryPool::read(std::span<std::uint32_t> results) const {
    vk_check(vk_->GetQueryPoolResults(
                 vk_->device, pool_, 0, static_cast<std::uint32_t>(results.size()),
                 results.size_bytes(), results.data(), sizeof results[0], VK_QUERY_RESULT_WAIT_BIT),
             "vkGetQueryPoolResults");
}

void QueryPool::read(std::span<std::uint64_t> results) const {
    vk_check(
        vk_->GetQueryPoolResults(vk_->device, pool_, 0, static_cast<std::uint32_t>(results.size()),
                                 results.size_bytes(), results.data(), sizeof results[0],
                                 VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
}

bool QueryPool::read_if_there(std::span<std::uint64_t> results) const noexcept {
    return vk_->GetQueryPoolResults(vk_->device, pool_, 0,
                                    static_cast<std::uint32_t>(results.size()),
                                    results.size_bytes(), results.data(), sizeof(std::uint64_t),
                                    VK_QUERY_RESULT_64_BIT) == VK_SUCCESS;
}

}  // namespace rimline
