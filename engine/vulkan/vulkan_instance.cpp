#include "engine/vulkan/vulkan_instance.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>

#include "engine/vulkan/device_choice.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/vulkan_result.h"

namespace rimline {

namespace {

constexpr const char* k_validation_layer = "VK_LAYER_KHRONOS_validation";

bool has_extension(const GlobalFunctions& vk, const char* name) {
    const auto extensions = enumerate<VkExtensionProperties>(
        [&](std::uint32_t* count, VkExtensionProperties* all) {
            return vk.EnumerateInstanceExtensionProperties(nullptr, count, all);
        },
        "vkEnumerateInstanceExtensionProperties");
    return std::ranges::any_of(extensions, [name](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

bool has_validation_layer(const GlobalFunctions& vk) {
    const std::vector<VkLayerProperties> layers = enumerate<VkLayerProperties>(
        [&vk](std::uint32_t* count, VkLayerProperties* all) {
            return vk.EnumerateInstanceLayerProperties(count, all);
        },
        "vkEnumerateInstanceLayerProperties");
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, k_validation_layer) == 0;
    });
}

// What the layer says of itself: which features and limits its checks on the GPU change.
bool is_notice(const VkDebugUtilsMessengerCallbackDataEXT& data) {
    return data.pMessageIdName != nullptr &&
           std::strcmp(data.pMessageIdName, "WARNING-GPU-Assisted-Validation") == 0;
}

}  // namespace

struct VulkanInstance::Messages {
    std::atomic<std::uint32_t> count{0};
    mutable std::mutex mutex;
    std::string first;

    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user) {
        if (is_notice(*data)) return VK_FALSE;
        Messages& messages = *static_cast<Messages*>(user);
        const std::lock_guard lock(messages.mutex);
        if (messages.count++ == 0) messages.first = data->pMessage;
        return VK_FALSE;
    }
};

VulkanInstance::VulkanInstance(const InstanceOptions& options)
    : loader_(options.loader ? options.loader : system_loader()),
      presents_(!options.window_extensions.empty()),
      messages_(std::make_unique<Messages>()) {
    const GlobalFunctions vk = load_global_functions(loader_);
    std::uint32_t version = VK_API_VERSION_1_0;
    vk_check(vk.EnumerateInstanceVersion(&version), "vkEnumerateInstanceVersion");
    if (version < VK_API_VERSION_1_3)
        throw Error(ErrorCode::no_device,
                    "the Vulkan loader is older than 1.3: install a newer libvulkan1");
    if (options.validate && !has_validation_layer(vk))
        throw Error(ErrorCode::no_device, std::string("the layer ") + k_validation_layer +
                                              " is not installed: install vulkan-validationlayers");

    const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                        .pApplicationName = "rimline",
                                        .pEngineName = "rimline",
                                        .apiVersion = VK_API_VERSION_1_3};
    const VkDebugUtilsMessengerCreateInfoEXT messenger{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = &Messages::receive,
        .pUserData = messages_.get()};
    constexpr std::array k_checks{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    const VkValidationFeaturesEXT features{
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .pNext =
            &messenger,  // Also receives messages about the creation and destruction of the instance.
        .enabledValidationFeatureCount = k_checks.size(),
        .pEnabledValidationFeatures = k_checks.data()};
    std::vector<const char*> extensions;
    for (const std::string& name : options.window_extensions) extensions.push_back(name.c_str());
    // Loaders list devices that lack parts of Vulkan, as MoltenVK's, only to those who ask for them.
    const bool is_portable = has_extension(vk, VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    if (is_portable) extensions.push_back(VK_KHR_PORTABILITY_ENUMERATION_EXTENSION_NAME);
    // For messages, and for names (debug_names.h).
    has_debug_utils_ = options.validate || has_extension(vk, VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (has_debug_utils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (options.validate) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    VkInstanceCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pApplicationInfo = &application,
        .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
        .ppEnabledExtensionNames = extensions.data()};
    if (is_portable) info.flags = VK_INSTANCE_CREATE_ENUMERATE_PORTABILITY_BIT_KHR;
    if (options.validate) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &k_validation_layer;
    }
    functions_ = std::make_unique<InstanceFunctions>();  // Before the instance: it may throw.
    const VkResult created = vk.CreateInstance(&info, nullptr, &instance_);
    // The loader's result if no driver is installed.
    if (created == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error(ErrorCode::no_device, k_no_device_advice);
    vk_check(created, "vkCreateInstance");
    try {
        *functions_ = load_instance_functions(loader_, instance_);
        if (options.validate)
            vk_check(functions_->CreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr,
                                                              &messenger_),
                     "vkCreateDebugUtilsMessengerEXT");
    } catch (...) {
        if (functions_->DestroyInstance) functions_->DestroyInstance(instance_, nullptr);
        throw;
    }
}

VulkanInstance::~VulkanInstance() {
    if (messenger_ != VK_NULL_HANDLE)
        functions_->DestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    functions_->DestroyInstance(instance_, nullptr);
}

std::optional<std::uint32_t> VulkanInstance::validation_message_count() const noexcept {
    if (!validates()) return std::nullopt;
    return messages_->count.load();
}

std::string VulkanInstance::first_validation_message() const {
    const std::lock_guard lock(messages_->mutex);
    return messages_->first;
}

}  // namespace rimline
