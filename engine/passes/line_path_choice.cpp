#include "engine/passes/line_path_choice.h"

#include "silhouette/error.h"

namespace rimline {

LinePath choose_line_path(LinePath wanted, VkPhysicalDeviceType type, bool has_geometry_shader) {
    if (wanted == LinePath::automatic)
        wanted = type == VK_PHYSICAL_DEVICE_TYPE_CPU ? LinePath::geometry : LinePath::pulling;
    if (has_geometry_shader || !needs_geometry_shader(wanted)) return wanted;
    if (wanted == LinePath::geometry) return LinePath::pulling;
    throw Error(ErrorCode::no_device,
                "this path of lines needs geometry shaders, which the device lacks");
}

}  // namespace rimline
