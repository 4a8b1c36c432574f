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
    std::shared_ptr<const DeviceFunctions> vk;               // The device's own.
    std::map<std::string, std::vector<std::uint64_t>> made;  // By the function.
    std::map<std::uint64_t, std::string> names;
    std::vector<std::string> labels;
    int open_labels = 0;
};
Told told;

// The functions that make one object, told.
#define RIMLINE_TOLD(function, Info, Handle)                                        \
    VKAPI_ATTR VkResult VKAPI_CALL function(VkDevice device, const Info* info,      \
                                            const VkAllocationCallbacks* allocator, \
                                            Handle* handle) {                       \
        const VkResult result = told.vk->function(device, info, allocator, handle); \
        told.made[#function].push_back(reinterpret_cast<std::uint64_t>(*handle));   \
        return result;                                                              \
    }
RIMLINE_TOLD(CreateBuffer, VkBufferCreateInfo, VkBuffer)
RIMLINE_TOLD(CreateImage, VkImageCreateInfo, VkImage)
RIMLINE_TOLD(CreateImageView, VkImageViewCreateInfo, VkImageView)
RIMLINE_TOLD(CreateSampler, VkSamplerCreateInfo, VkSampler)
RIMLINE_TOLD(CreateShaderModule, VkShaderModuleCreateInfo, VkShaderModule)
RIMLINE_TOLD(CreatePipelineLayout, VkPipelineLayoutCreateInfo, VkPipelineLayout)
RIMLINE_TOLD(CreateDescriptorSetLayout, VkDescriptorSetLayoutCreateInfo, VkDescriptorSetLayout)
RIMLINE_TOLD(CreateDescriptorPool, VkDescriptorPoolCreateInfo, VkDescriptorPool)
RIMLINE_TOLD(CreateQueryPool, VkQueryPoolCreateInfo, VkQueryPool)
RIMLINE_TOLD(CreateCommandPool, VkCommandPoolCreateInfo, VkCommandPool)
RIMLINE_TOLD(CreateSemaphore, VkSemaphoreCreateInfo, VkSemaphore)
#undef RIMLINE_TOLD

// A pipeline each; the engine makes one a call.
VKAPI_ATTR VkResult VKAPI_CALL create_graphics(VkDevice device, VkPipelineCache cache,
                                               std::uint32_t count,
                                               const VkGraphicsPipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* allocator,
                                               VkPipeline* pipelines) {
    const VkResult result =
        told.vk->CreateGraphicsPipelines(device, cache, count, infos, allocator, pipelines);
    told.made["CreateGraphicsPipelines"].push_back(reinterpret_cast<std::uint64_t>(*pipelines));
    return result;
}
VKAPI_ATTR VkResult VKAPI_CALL create_compute(VkDevice device, VkPipelineCache cache,
                                              std::uint32_t count,
                                              const VkComputePipelineCreateInfo* infos,
                                              const VkAllocationCallbacks* allocator,
                                              VkPipeline* pipelines) {
    const VkResult result =
        told.vk->CreateComputePipelines(device, cache, count, infos, allocator, pipelines);
    told.made["CreateComputePipelines"].push_back(reinterpret_cast<std::uint64_t>(*pipelines));
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

TEST_CASE("every object that is made has a name, and every pass a label") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1000));
    Scene scene{.camera = {.eye = {0, 1, 4}}};
    scene.instances.push_back({.octree = &model.octree, .name = "knot.obj"});
    scene.lights.push_back({.vector = {1, 2, 3}});

    DeviceContext context = gpu->context();
    auto vk = std::make_shared<DeviceFunctions>(*context.vk);
    told = {.vk = gpu->context().vk};
    vk->CreateBuffer = &CreateBuffer;
    vk->CreateImage = &CreateImage;
    vk->CreateImageView = &CreateImageView;
    vk->CreateSampler = &CreateSampler;
    vk->CreateShaderModule = &CreateShaderModule;
    vk->CreatePipelineLayout = &CreatePipelineLayout;
    vk->CreateDescriptorSetLayout = &CreateDescriptorSetLayout;
    vk->CreateDescriptorPool = &CreateDescriptorPool;
    vk->CreateQueryPool = &CreateQueryPool;
    vk->CreateCommandPool = &CreateCommandPool;
    vk->CreateSemaphore = &CreateSemaphore;
    vk->CreateGraphicsPipelines = &create_graphics;
    vk->CreateComputePipelines = &create_compute;
    vk->SetDebugUtilsObjectNameEXT = &set_object_name;
    vk->CmdBeginDebugUtilsLabelEXT = &begin_label;
    vk->CmdEndDebugUtilsLabelEXT = &end_label;
    context.vk = vk;
    Renderer(context, {.samples = 1, .scale = 1, .pass_times = true}).render(scene, 32, 32);

    // Each of the functions above was called, and what it made has a name.
    CHECK(told.made.size() == 13);
    CHECK(told.made["CreateBuffer"].size() > 10);
    CHECK(told.made["CreateGraphicsPipelines"].size() > 10);
    for (const auto& [function, objects] : told.made)
        for (const std::uint64_t object : objects) {
            CAPTURE(function);
            CHECK_FALSE(told.names[object].empty());
        }
    const auto is_named = [](const std::string& name) {
        return std::ranges::any_of(told.names,
                                   [&](const auto& entry) { return entry.second == name; });
    };
    CHECK(is_named("the picture's depth"));
    CHECK(is_named("the silhouette slots of knot.obj"));
    for (const char* const pass :
         {"surfaces, whole", "surfaces, in shadow", "sides of shadow volumes", "lines", "picture",
          "change streams", "times of passes"})
        CHECK_MESSAGE(is_named(pass), pass);
    CHECK(told.labels == std::vector<std::string>{"silhouettes", "surfaces", "shadow volumes",
                                                  "lines", "picture"});
    CHECK(told.open_labels == 0);
}

}  // namespace
}  // namespace rimline
