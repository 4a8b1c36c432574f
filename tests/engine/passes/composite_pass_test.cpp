#include "engine/passes/composite_pass.h"

#include <doctest/doctest.h>

#include <string>

#include "tests/engine/support/changed_functions.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline {
namespace {

PFN_vkGetPhysicalDeviceFormatProperties format_properties = nullptr;

VKAPI_ATTR void VKAPI_CALL without_blending(VkPhysicalDevice device, VkFormat format,
                                            VkFormatProperties* properties) {
    format_properties(device, format, properties);
    properties->optimalTilingFeatures &= ~VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT;
}

TEST_CASE("a format that cannot blend is refused only for pictures drawn over others") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext context = tests::with_functions(gpu->context(), [](DeviceFunctions& vk) {
        format_properties = vk.GetPhysicalDeviceFormatProperties;
        vk.GetPhysicalDeviceFormatProperties = &without_blending;
    });
    CompositePass pass(context);
    CompositeKind kind{
        .format = VK_FORMAT_R8G8B8A8_UNORM, .scale = 1, .use = PictureUse::over, .is_layer = true};
    try {
        pass.prepare(context, kind);
        FAIL("accepted");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK(std::string(error.what()).find("VkFormat " + std::to_string(kind.format)) !=
              std::string::npos);
    }
    for (const PictureUse use : {PictureUse::whole, PictureUse::layer, PictureUse::straight}) {
        kind.use = use;
        pass.prepare(context, kind);
        CHECK(pass.is_prepared(kind));
    }
}

}  // namespace
}  // namespace rimline
