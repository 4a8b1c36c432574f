#include "tests/silhouette/hough/service/allocation_faults.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocations{0};
std::atomic<bool> is_out_of_memory{false};
std::atomic<std::int64_t> spared_allocations{0};

void* counted_or_null(std::size_t size) noexcept {
    ++allocations;
    if (is_out_of_memory && --spared_allocations < 0) return nullptr;
    return std::malloc(size == 0 ? 1 : size);
}

void* counted(std::size_t size) {
    if (void* memory = counted_or_null(size)) return memory;
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
// Sanitizers have some of their own, whose memory free() must not take.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return counted_or_null(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return counted_or_null(size);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

namespace rimline::tests {

std::uint64_t allocation_count() noexcept { return allocations; }

AllocationFaults::AllocationFaults(std::uint64_t spared) noexcept {
    spared_allocations = static_cast<std::int64_t>(spared);
    is_out_of_memory = true;
}
AllocationFaults::~AllocationFaults() { is_out_of_memory = false; }

}  // namespace rimline::tests
