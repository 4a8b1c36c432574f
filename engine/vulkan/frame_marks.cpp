#include "engine/vulkan/frame_marks.h"

#include <atomic>

#include "engine/vulkan/barrier.h"

namespace rimline {

FrameMarks::FrameMarks(const DeviceContext& context, std::uint32_t slots)
    : marks_(context, sizeof(std::uint32_t) * slots, BufferPlace::readback, "frame marks") {
    std::memset(marks_.mapped(), 0, marks_.size());
}

void FrameMarks::record(Commands commands, std::uint32_t slot, std::uint64_t frame_number) const {
    constexpr StageAccess k_filling{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                    VK_ACCESS_2_TRANSFER_WRITE_BIT};
    // The last stages of all that a frame has: draws, dispatches and copies. A source stage stands for those before it
    // in the pipeline too, so that draws are waited for as a whole. Of memory only the mark itself matters.
    constexpr StageAccess k_frame{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT |
                                      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT |
                                      VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
                                      VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | k_filling.stages,
                                  k_filling.access};
    record_barrier(commands, k_frame, k_filling);
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
