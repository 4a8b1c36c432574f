#include "tests/silhouette/hough/service/allocation_faults.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};
std::atomic<bool> is_out_of_memory{false};
std::atomic<std::int64_t> spared_allocations{0};

void* counted(std::size_t size) {
    ++allocations;
    if (!is_out_of_memory || --spared_allocations >= 0)
        if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace rimline::tests {

std::uint64_t allocation_count() noexcept { return allocations; }

AllocationFaults::AllocationFaults(std::uint64_t spared) noexcept {
    spared_allocations = static_cast<std::int64_t>(spared);
    is_out_of_memory = true;
}
AllocationFaults::~AllocationFaults() { is_out_of_memory = false; }

}  // namespace rimline::tests
