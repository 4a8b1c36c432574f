#pragma once

// Faults on demand: a loader whose functions may fail.
//
//     engine --vkAllocateMemory()--> vulkan_faults.cpp --dlsym()--> the system's loader
//
// Every call that Vulkan lets fail is counted; one of them can be made to fail without reaching the driver,
// and a device can be made to be lost. What is made and destroyed is booked, so that a leak shows as a
// handle.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace rimline::tests {

/// The loader: for InstanceOptions::loader.
PFN_vkVoidFunction VKAPI_CALL failing_loader(VkInstance instance, const char* name);

enum class FaultKind {
    failure,     ///< One call fails, and the next one does not.
    lost_device  ///< One submit or wait finds the device lost, as does each on that device afterwards.
};

/// Which call fails, counted from 0 over the calls of its kind, and how: a call has several results to
/// fail with, and takes number `result` of them, counted round.
struct Fault {
    FaultKind kind = FaultKind::failure;
    std::uint64_t call = 0;
    std::uint64_t result = 0;
    /// Where there is one, only calls of this function are counted and fail.
    const char* function = nullptr;
};

/// What became of an armed fault.
struct FaultReport {
    bool injected = false;
    const char* call = "";  ///< The function that failed.
    VkResult result = VK_SUCCESS;
};

/// Starts counting calls; `fault` is injected when its turn comes. One fault at a time, any thread.
void arm(const Fault& fault);
/// Ends it. Devices that are lost stay so.
FaultReport disarm();
/// While it lives nothing fails, and nothing is counted.
class NoFaults {
public:
    NoFaults();
    ~NoFaults();
    NoFaults(const NoFaults&) = delete;
    NoFaults& operator=(const NoFaults&) = delete;

private:
    bool was_armed_;
};

/// How often `function` has been called, of those that may fail, and was not made to fail.
std::uint64_t calls_of(const std::string& function);
/// Semaphores that submissions have waited for.
std::uint64_t semaphore_waits();

/// Whether this thread is in the bookkeeping here: what is allocated then is not the engine's.
bool is_keeping_books() noexcept;

/// Objects made and not destroyed, as "VkBuffer 0x1234", and destroyed without having been made. Objects
/// of pools (command buffers, descriptor sets) go with their pool and are not listed.
std::vector<std::string> live_objects();

}  // namespace rimline::tests
