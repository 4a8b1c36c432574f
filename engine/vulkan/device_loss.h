#pragma once

// Going on after the GPU has given up.
//
// A driver that restarts, a graphics card that is pulled out or a shader that runs too long end every
// call on a device with Error{device_lost}. The VulkanInstance, meshes, octrees and scenes stay; the
// Device and all that was made from it (renderers, buffers, swapchains) are only good for being
// destroyed, which never waits long, and are made again:
//
//     struct OnDevice {                       // In the order in which they need one another.
//         OnDevice(const VulkanInstance& instance) : device(instance), renderer(device.context()) {}
//         Device device;
//         Renderer renderer;
//     };
//     std::optional<OnDevice> gpu(std::in_place, instance);
//     const Picture picture = surviving_device_loss(
//         [&] { return gpu->renderer.render(scene, 800, 600); },
//         [&] { gpu.reset(); gpu.emplace(instance); });
//
// The picture is the one that an undisturbed device would have drawn. What was submitted and not yet
// finished is gone with the device, so `call` submits it anew.

#include <utility>

#include "silhouette/error.h"

namespace rimline {

/// How often in a row a device may be lost. More often it is not chance but what we ask of it, and
/// asking again would never end.
constexpr int k_max_device_losses = 3;

/// The result of `call`. Where it throws Error{device_lost}, `make_again` is called and then `call` once
/// more, up to k_max_device_losses times; then the error is passed on, as every other is. A device that
/// is lost while it is made counts too.
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
