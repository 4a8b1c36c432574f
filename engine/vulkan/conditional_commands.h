#pragma once

// A frame that nobody wants any more ends early (FrameCondition, picture_target.h).

#include <vulkan/vulkan.h>

#include <optional>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/picture_target.h"
#include "silhouette/error.h"

namespace rimline {

/// Throws Error{bad_input} if there is a condition that the device cannot follow.
inline void require_condition(const DeviceContext& context,
                              const std::optional<FrameCondition>& condition) {
    if (condition && !context.features.conditional_rendering)
        throw Error(ErrorCode::bad_input,
                    "a frame with a condition needs VK_EXT_conditional_rendering, which is not "
                    "enabled (DeviceFeatures::conditional_rendering)");
}

/// Draws, dispatches and clears recorded while it lives depend on the condition, where there is one; barriers and load
/// operations do not. It begins and ends outside of a render pass. Drivers may read the value once where it begins, so
/// each pass has its own.
class ConditionalCommands {
public:
    ConditionalCommands(Commands commands, const std::optional<FrameCondition>& condition) noexcept
        : commands_(commands), is_conditional_(condition.has_value()) {
        if (!is_conditional_) return;
        const VkConditionalRenderingBeginInfoEXT info{
            .sType = VK_STRUCTURE_TYPE_CONDITIONAL_RENDERING_BEGIN_INFO_EXT,
            .buffer = condition->buffer,
            .offset = condition->offset};
        commands_->CmdBeginConditionalRenderingEXT(commands_, &info);
    }
    ~ConditionalCommands() {
        if (is_conditional_) commands_->CmdEndConditionalRenderingEXT(commands_);
    }
    ConditionalCommands(const ConditionalCommands&) = delete;
    ConditionalCommands& operator=(const ConditionalCommands&) = delete;

private:
    Commands commands_;
    bool is_conditional_;
};

}  // namespace rimline
