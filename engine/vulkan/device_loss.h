#pragma once

// Continuing after the loss of a device.
//
// If a driver restarts, a graphics card is removed or a shader runs too long, every call on the device ends
// with Error{device_lost}. The VulkanInstance, meshes, octrees and scenes stay valid. The Device and
// everything made from it (renderers, buffers, swapchains) can only be destroyed, which never waits long, and
// made again:
//
//     struct OnDevice {                       // In the order of dependence.
//         OnDevice(const VulkanInstance& instance) : device(instance), renderer(device.context()) {}
//         Device device;
//         Renderer renderer;
//     };
//     std::optional<OnDevice> gpu(std::in_place, instance);
//     const Picture picture = surviving_device_loss(
//         [&] { return gpu->renderer.render(scene, 800, 600); },
//         [&] { gpu.reset(); gpu.emplace(instance); });
//
// The picture is the one that an undisturbed device would have drawn. Work that was submitted and not
// finished is lost with the device, so `call` submits it again.

#include <utility>

#include "silhouette/error.h"

namespace rimline {

/// How often in a row a device may be lost. After more losses the cause is probably the work itself, and
/// another attempt would lose the device again.
constexpr int k_max_device_losses = 3;

/// Returns the result of `call`. If it throws Error{device_lost}, calls `make_again` and then `call` again,
/// up to k_max_device_losses times. After that the error is rethrown, as every other error is. A loss during
/// `make_again` counts too.
template <typename Call, typename MakeAgain>
auto surviving_device_loss(Call&& call, MakeAgain&& make_again) -> decltype(call()) {
    bool is_lost = false;
    for (int losses = 0;; ++losses) {
        try {
            if (is_lost) make_again();
            return call();
        } catch (const Error& error) {
            if (error.code() != ErrorCode::device_lost || losses == k_max_device_losses) throw;
            is_lost = true;
        }
    }
}

}  // namespace rimline
