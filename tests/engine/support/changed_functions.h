#pragma once

// A context whose function table a test has changed, so that it sees, or answers, single calls of Vulkan.

#include <memory>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/functions.h"

namespace rimline::tests {

/// A copy of `context` after change(DeviceFunctions&). Its memory still comes from the allocator of `context`.
template <typename Change>
DeviceContext with_functions(const DeviceContext& context, Change&& change) {
    auto functions = std::make_shared<DeviceFunctions>(*context.vk);
    change(*functions);
    DeviceContext changed = context;
    changed.vk = std::move(functions);
    return changed;
}

}  // namespace rimline::tests
