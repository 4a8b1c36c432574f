#include "engine/vulkan/vulkan_result.h"

namespace rimline {

std::string name_of(VkResult result) {
#define RIMLINE_NAME(name) \
    case name: return #name
    switch (result) {
        RIMLINE_NAME(VK_SUCCESS);
        RIMLINE_NAME(VK_NOT_READY);
        RIMLINE_NAME(VK_TIMEOUT);
        RIMLINE_NAME(VK_EVENT_SET);
        RIMLINE_NAME(VK_EVENT_RESET);
        RIMLINE_NAME(VK_INCOMPLETE);
        RIMLINE_NAME(VK_PIPELINE_COMPILE_REQUIRED);
        RIMLINE_NAME(VK_SUBOPTIMAL_KHR);
        RIMLINE_NAME(VK_ERROR_OUT_OF_HOST_MEMORY);
        RIMLINE_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY);
        RIMLINE_NAME(VK_ERROR_INITIALIZATION_FAILED);
        RIMLINE_NAME(VK_ERROR_DEVICE_LOST);
        RIMLINE_NAME(VK_ERROR_MEMORY_MAP_FAILED);
        RIMLINE_NAME(VK_ERROR_LAYER_NOT_PRESENT);
        RIMLINE_NAME(VK_ERROR_EXTENSION_NOT_PRESENT);
        RIMLINE_NAME(VK_ERROR_FEATURE_NOT_PRESENT);
        RIMLINE_NAME(VK_ERROR_INCOMPATIBLE_DRIVER);
        RIMLINE_NAME(VK_ERROR_TOO_MANY_OBJECTS);
        RIMLINE_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED);
        RIMLINE_NAME(VK_ERROR_FRAGMENTED_POOL);
        RIMLINE_NAME(VK_ERROR_UNKNOWN);
        RIMLINE_NAME(VK_ERROR_OUT_OF_POOL_MEMORY);
        RIMLINE_NAME(VK_ERROR_INVALID_EXTERNAL_HANDLE);
        RIMLINE_NAME(VK_ERROR_FRAGMENTATION);
        RIMLINE_NAME(VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS);
        RIMLINE_NAME(VK_ERROR_SURFACE_LOST_KHR);
        RIMLINE_NAME(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR);
        RIMLINE_NAME(VK_ERROR_OUT_OF_DATE_KHR);
        RIMLINE_NAME(VK_ERROR_INCOMPATIBLE_DISPLAY_KHR);
        RIMLINE_NAME(VK_ERROR_VALIDATION_FAILED_EXT);
        default: return "VkResult " + std::to_string(static_cast<int>(result));
    }
#undef RIMLINE_NAME
}

bool is_out_of_memory(VkResult result) noexcept {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_MEMORY_MAP_FAILED:
        case VK_ERROR_TOO_MANY_OBJECTS:
        case VK_ERROR_FRAGMENTED_POOL:
        case VK_ERROR_OUT_OF_POOL_MEMORY:
        case VK_ERROR_FRAGMENTATION: return true;
        default: return false;
    }
}

Error error_of(VkResult result, const std::string& call) {
    const std::string what = call + " failed with " + name_of(result);
    if (result == VK_ERROR_DEVICE_LOST)
        return {ErrorCode::device_lost, "the device was lost: " + what};
    if (is_out_of_memory(result))
        return {ErrorCode::too_large, "the device has no memory left: " + what};
    return {ErrorCode::no_device, what};
}

}  // namespace rimline
