#include "engine/frame/clear_area.h"

namespace rimline {

ClearArea choose_clear_area(VkPhysicalDeviceType type, VkDriverId driver) noexcept {
    if (type == VK_PHYSICAL_DEVICE_TYPE_CPU) return ClearArea::drawn;
    switch (driver) {
        case VK_DRIVER_ID_ARM_PROPRIETARY:
        case VK_DRIVER_ID_BROADCOM_PROPRIETARY:
        case VK_DRIVER_ID_IMAGINATION_OPEN_SOURCE_MESA:
        case VK_DRIVER_ID_IMAGINATION_PROPRIETARY:
        case VK_DRIVER_ID_MESA_PANVK:
        case VK_DRIVER_ID_MESA_TURNIP:
        case VK_DRIVER_ID_MESA_V3DV:
        case VK_DRIVER_ID_MOLTENVK:
        case VK_DRIVER_ID_QUALCOMM_PROPRIETARY: return ClearArea::drawn;
        default: return ClearArea::whole;
    }
}

}  // namespace rimline
