#pragma once

// Names of objects and labels of passes, for messages of the validation layers and for tools that show frames.
// Without VK_EXT_debug_utils they do nothing. An instance of Rimline's own enables it where there is one.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

#include "engine/vulkan/functions.h"

namespace rimline {

template <typename Handle>
void set_name(const DeviceFunctions& vk, VkObjectType type, Handle handle,
              const std::string& name) noexcept {
    if (!vk.SetDebugUtilsObjectNameEXT) return;
    const VkDebugUtilsObjectNameInfoEXT info{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = reinterpret_cast<std::uint64_t>(handle),
        .pObjectName = name.c_str()};
    // A name that cannot be kept is no error.
    (void)vk.SetDebugUtilsObjectNameEXT(vk.device, &info);
}

/// Commands recorded while it lives belong to a pass of this name.
class PassLabel {
public:
    PassLabel(Commands commands, const char* name) noexcept : commands_(commands) {
        if (!commands->CmdBeginDebugUtilsLabelEXT) return;
        const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                         .pLabelName = name};
        commands->CmdBeginDebugUtilsLabelEXT(commands, &label);
    }
    ~PassLabel() {
        if (commands_->CmdEndDebugUtilsLabelEXT) commands_->CmdEndDebugUtilsLabelEXT(commands_);
    }
    PassLabel(const PassLabel&) = delete;
    PassLabel& operator=(const PassLabel&) = delete;

private:
    Commands commands_;
};

}  // namespace rimline
