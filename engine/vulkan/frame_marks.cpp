#include "engine/vulkan/frame_marks.h"

#include <atomic>

#include "engine/vulkan/barrier.h"

namespace rimline {

FrameMarks::FrameMarks(const DeviceContext& context, std::uint32_t slots)
    : marks_(context, sizeof(std::uint32_t) * slots, BufferPlace::readback, "frame marks") {
    std::memset(marks_.mapped(), 0, marks_.size());
}

void FrameMarks::record(Commands commands, std::uint32_t slot, std::uint64_t frame_number) const {
    constexpr StageAccess k_everything{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                       VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
    constexpr StageAccess k_filling{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                    VK_ACCESS_2_TRANSFER_WRITE_BIT};
    record_barrier(commands, k_everything, k_filling);
    commands->CmdFillBuffer(commands, marks_.handle(), sizeof(std::uint32_t) * slot,
                            sizeof(std::uint32_t), static_cast<std::uint32_t>(frame_number));
    record_barrier(commands, k_filling, {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

bool FrameMarks::has(std::uint32_t slot, std::uint64_t frame_number) const noexcept {
    auto& mark = reinterpret_cast<std::uint32_t*>(marks_.mapped())[slot];
    return std::atomic_ref(mark).load(std::memory_order_acquire) ==
           static_cast<std::uint32_t>(frame_number);
}

}  // namespace rimline
