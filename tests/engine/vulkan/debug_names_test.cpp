#include "engine/vulkan/debug_names.h"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

// What a device is told.
struct Told {
    PFN_vkCreateBuffer create_buffer = nullptr;
    PFN_vkCreateImage create_image = nullptr;
    std::vector<std::uint64_t> made;
    std::map<std::uint64_t, std::string> names;
    std::vector<std::string> labels;
    int open_labels = 0;
};
Told told;

VKAPI_ATTR VkResult VKAPI_CALL create_buffer(VkDevice device, const VkBufferCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkBuffer* buffer) {
    const VkResult result = told.create_buffer(device, info, allocator, buffer);
    told.made.push_back(reinterpret_cast<std::uint64_t>(*buffer));
    return result;
}
VKAPI_ATTR VkResult VKAPI_CALL create_image(VkDevice device, const VkImageCreateInfo* info,
                                            const VkAllocationCallbacks* allocator,
                                            VkImage* image) {
    const VkResult result = told.create_image(device, info, allocator, image);
    told.made.push_back(reinterpret_cast<std::uint64_t>(*image));
    return result;
}
VKAPI_ATTR VkResult VKAPI_CALL set_object_name(VkDevice,
                                               const VkDebugUtilsObjectNameInfoEXT* info) {
    told.names[info->objectHandle] = info->pObjectName;
    return VK_SUCCESS;
}
VKAPI_ATTR void VKAPI_CALL begin_label(VkCommandBuffer, const VkDebugUtilsLabelEXT* label) {
    told.labels.push_back(label->pLabelName);
    ++told.open_labels;
}
VKAPI_ATTR void VKAPI_CALL end_label(VkCommandBuffer) { --told.open_labels; }

TEST_CASE("every buffer and image has a name, and every pass a label") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1000));
    Scene scene{.camera = {.eye = {0, 1, 4}}};
    scene.instances.push_back({.octree = &model.octree, .name = "knot.obj"});
    scene.lights.push_back({.vector = {1, 2, 3}});

    DeviceContext context = gpu->context();
    auto vk = std::make_shared<DeviceFunctions>(*context.vk);
    told = {.create_buffer = vk->CreateBuffer, .create_image = vk->CreateImage};
    vk->CreateBuffer = &create_buffer;
    vk->CreateImage = &create_image;
    vk->SetDebugUtilsObjectNameEXT = &set_object_name;
    vk->CmdBeginDebugUtilsLabelEXT = &begin_label;
    vk->CmdEndDebugUtilsLabelEXT = &end_label;
    context.vk = vk;
    Renderer(context, {.samples = 1, .scale = 1}).render(scene, 32, 32);

    CHECK(told.made.size() > 10);
    for (const std::uint64_t object : told.made) CHECK_FALSE(told.names[object].empty());
    const auto is_named = [](const std::string& name) {
        return std::ranges::any_of(told.names,
                                   [&](const auto& entry) { return entry.second == name; });
    };
    CHECK(is_named("the picture's depth"));
    CHECK(is_named("the silhouette slots of knot.obj"));
    CHECK(told.labels == std::vector<std::string>{"silhouettes", "surfaces", "shadow volumes",
                                                  "lines", "picture"});
    CHECK(told.open_labels == 0);
}

}  // namespace
}  // namespace rimline
