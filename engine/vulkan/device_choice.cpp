#include "engine/vulkan/device_choice.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "silhouette/error.h"

namespace rimline {

namespace {

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::optional<std::size_t> as_index(const std::string& text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

bool fits(std::span<const DeviceFacts> devices, std::size_t index, const std::string& request) {
    if (request.empty()) return true;
    const DeviceFacts& facts = devices[index];
    const std::string wanted = lower(request);
    const bool is_cpu = facts.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (wanted == "cpu") return is_cpu;
    if (wanted == "gpu") return !is_cpu;
    // A number that is no index, such as 4090, is a part of a name.
    if (const auto number = as_index(wanted); number && *number < devices.size())
        return *number == index;
    return lower(facts.name).find(wanted) != std::string::npos;
}

int rank(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return 4;
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return 3;
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return 2;
        case VK_PHYSICAL_DEVICE_TYPE_CPU: return 1;
        default: return 0;
    }
}

std::string joined(const std::vector<std::string>& parts, const char* separator) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
    return text;
}

}  // namespace

// The loader leaves out a driver that there is no memory to load, and does not say so.
const char* const k_no_device_advice =
    "there is no Vulkan device: install a driver, mesa-vulkan-drivers for the CPU, or raise the "
    "limit of memory (ulimit -v) if one is set";

std::string name_of(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return "discrete GPU";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return "integrated GPU";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return "virtual GPU";
        case VK_PHYSICAL_DEVICE_TYPE_CPU: return "CPU";
        default: return "other device";
    }
}

DeviceVerdict judge_device(const DeviceFacts& facts) {
    DeviceVerdict verdict;
    const auto need = [&](bool present, const char* what) {
        if (!present) verdict.lacks.emplace_back(what);
    };
    need(facts.api_version >= VK_API_VERSION_1_3, "Vulkan 1.3");
    need(facts.graphics_and_compute_queue, "a queue for graphics and compute");
    need(facts.depth_clamp, "depth clamping");
    need(facts.buffer_device_address, "buffer device addresses");
    need(facts.scalar_block_layout, "scalar block layout");
    need(facts.timeline_semaphore, "timeline semaphores");
    need(facts.dynamic_rendering, "dynamic rendering");
    need(facts.synchronization2, "synchronization2");
    need(facts.maintenance4, "maintenance4");
    need(facts.depth_stencil_format, "the depth format D32_SFLOAT_S8_UINT");
    need(facts.shows_window.value_or(true), "a queue that can show pictures in this window");
    return verdict;
}

DeviceChoice choose_device(std::span<const DeviceFacts> devices, const DeviceRequest& request) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (fits(devices, i, request) && judge_device(devices[i]).usable() &&
            (!best || rank(devices[i].type) > rank(devices[*best].type)))
            best = i;

    std::vector<std::string> reasons;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceFacts& facts = devices[i];
        const DeviceVerdict verdict = judge_device(facts);
        std::string reason = facts.name + " (" + name_of(facts.type) + "): ";
        if (best == i)
            reason += "chosen";
        else if (!verdict.usable())
            reason += "lacks " + joined(verdict.lacks, ", ");
        else if (!fits(devices, i, request))
            reason += "is not '" + request + "'";
        else
            reason += "usable, but " + devices[*best].name + " comes first";
        reasons.push_back(std::move(reason));
    }
    if (best) return {*best, std::move(reasons)};
    if (devices.empty()) throw Error(ErrorCode::no_device, k_no_device_advice);
    throw Error(ErrorCode::no_device, "no Vulkan device " +
                                          (request.empty() ? "" : "fits '" + request + "' and ") +
                                          "can be used: " + joined(reasons, "; "));
}

}  // namespace rimline
