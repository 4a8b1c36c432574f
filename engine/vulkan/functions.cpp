#include "engine/vulkan/functions.h"

#include <dlfcn.h>

#include <string>

#include "engine/vulkan/device_choice.h"
#include "silhouette/error.h"

namespace rimline {

namespace {

[[noreturn]] void fail_without(const char* function) {
    throw Error(ErrorCode::no_device, std::string("the Vulkan loader or driver has no ") +
                                          function + ": Rimline needs Vulkan 1.3");
}

template <typename Function, typename Get, typename Owner>
Function find(Get get, Owner owner, const char* name) {
    return reinterpret_cast<Function>(get(owner, name));
}

template <typename Function, typename Get, typename Owner>
Function require(Get get, Owner owner, const char* name) {
    const auto found = find<Function>(get, owner, name);
    if (!found) fail_without(name);
    return found;
}

}  // namespace

PFN_vkGetInstanceProcAddr system_loader() {
    static const auto loader = [] {
#ifdef __APPLE__
        constexpr const char* k_names[] = {"libvulkan.1.dylib", "libvulkan.dylib",
                                           "libMoltenVK.dylib"};
#else
        constexpr const char* k_names[] = {"libvulkan.so.1", "libvulkan.so"};
#endif
        for (const char* name : k_names)
            if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL))
                if (void* symbol = dlsym(library, "vkGetInstanceProcAddr"))
                    return reinterpret_cast<PFN_vkGetInstanceProcAddr>(symbol);
        return PFN_vkGetInstanceProcAddr{};
    }();
    if (!loader)
        throw Error(ErrorCode::no_device,
                    std::string("there is no Vulkan loader (vkGetInstanceProcAddr): ") +
                        k_no_device_advice);
    return loader;
}

GlobalFunctions load_global_functions(PFN_vkGetInstanceProcAddr loader) {
    GlobalFunctions functions{.GetInstanceProcAddr = loader};
#define RIMLINE_LOAD(name) \
    functions.name = require<PFN_vk##name>(loader, VkInstance{VK_NULL_HANDLE}, "vk" #name);
    RIMLINE_GLOBAL_FUNCTIONS(RIMLINE_LOAD)
#undef RIMLINE_LOAD
    return functions;
}

InstanceFunctions load_instance_functions(PFN_vkGetInstanceProcAddr loader, VkInstance instance) {
    InstanceFunctions functions;
#define RIMLINE_LOAD(name) functions.name = require<PFN_vk##name>(loader, instance, "vk" #name);
    RIMLINE_INSTANCE_FUNCTIONS(RIMLINE_LOAD)
#undef RIMLINE_LOAD
#define RIMLINE_LOAD(name) functions.name = find<PFN_vk##name>(loader, instance, "vk" #name);
    RIMLINE_INSTANCE_EXTENSION_FUNCTIONS(RIMLINE_LOAD)
#undef RIMLINE_LOAD
    return functions;
}

DeviceFunctions load_device_functions(const InstanceFunctions& instance, VkDevice device) {
    DeviceFunctions functions;
    static_cast<InstanceFunctions&>(functions) = instance;
    functions.device = device;
    const auto get = instance.GetDeviceProcAddr;
#define RIMLINE_LOAD(name) functions.name = require<PFN_vk##name>(get, device, "vk" #name);
    RIMLINE_DEVICE_FUNCTIONS(RIMLINE_LOAD)
#undef RIMLINE_LOAD
#define RIMLINE_LOAD(name) functions.name = find<PFN_vk##name>(get, device, "vk" #name);
    RIMLINE_DEVICE_EXTENSION_FUNCTIONS(RIMLINE_LOAD)
#undef RIMLINE_LOAD
    return functions;
}

}  // namespace rimline
