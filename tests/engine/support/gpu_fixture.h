#pragma once

// A device for a test. Where the validation layer is installed it is on, with synchronization checks, and any
// message of it fails the case; the case prints whether it is on. Without a device the case is skipped. The
// variable RIMLINE_DEVICE chooses the device (requested_device.h).

#include <doctest/doctest.h>

#include <memory>
#include <optional>
#include <string>

#include "engine/tested_device.h"
#include "engine/vulkan/vulkan_instance.h"
#include "silhouette/error.h"
#include "tests/engine/support/requested_device.h"
#include "tests/skip.h"

namespace rimline::tests {

class Gpu {
public:
    /// Null where there is no usable device; `reason` then says why. `loader` as in InstanceOptions.
    static std::unique_ptr<Gpu> open(std::string& reason,
                                     PFN_vkGetInstanceProcAddr loader = nullptr) {
        try {
            return std::unique_ptr<Gpu>(new Gpu(loader));
        } catch (const Error& error) {
            // A device that was asked for and is not there is no reason to skip.
            if (error.code() != ErrorCode::no_device || !requested_device().empty()) throw;
            reason = error.what();
            return nullptr;
        }
    }
    ~Gpu() {
        device_.reset();
        const std::string first = instance_->first_validation_message();
        CHECK_MESSAGE(instance_->validation_message_count().value_or(0) == 0, first);
    }
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    const TestedDevice& device() const noexcept { return *device_; }
    const DeviceContext& context() const noexcept { return device_->context(); }
    const VulkanInstance& instance() const noexcept { return *instance_; }

private:
    explicit Gpu(PFN_vkGetInstanceProcAddr loader) {
        try {
            instance_.emplace(InstanceOptions{.validate = true, .loader = loader});
            MESSAGE("validation: on, with synchronization checks");
        } catch (const Error& error) {
            if (error.code() != ErrorCode::no_device) throw;
            MESSAGE("validation: off, ", std::string(error.what()));
            instance_.emplace(InstanceOptions{.loader = loader});
        }
        device_.emplace(*instance_, requested_device());
    }

    std::optional<VulkanInstance> instance_;
    std::optional<TestedDevice> device_;
};

}  // namespace rimline::tests

/// Defines `gpu`, or ends the test case as skipped. After `gpu`: further arguments of Gpu::open().
#define RIMLINE_OPEN_GPU(gpu, ...)                                          \
    std::string gpu##_reason;                                               \
    const std::unique_ptr<rimline::tests::Gpu> gpu =                        \
        rimline::tests::Gpu::open(gpu##_reason __VA_OPT__(, ) __VA_ARGS__); \
    if (!gpu) RIMLINE_SKIP(gpu##_reason)
