#include "tests/silhouette/mesh/formats/watched_new.h"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {

struct Watch {
    bool is_armed = false;
    bool is_lasting = false;
    bool has_failed = false;
    std::uint64_t left = 0;
    std::int64_t bytes = 0;
    std::int64_t peak_bytes = 0;
};
thread_local Watch watch;

void* allocate(std::size_t size) {
    if (watch.is_armed && (watch.left == 0 || watch.left-- == 0)) {
        watch.has_failed = true;
        watch.is_armed = watch.is_lasting;
        throw std::bad_alloc();
    }
    void* const memory = std::malloc(size == 0 ? 1 : size);
    if (!memory) throw std::bad_alloc();
    watch.bytes += static_cast<std::int64_t>(malloc_usable_size(memory));
    watch.peak_bytes = std::max(watch.peak_bytes, watch.bytes);
    return memory;
}

void release(void* memory) noexcept {
    if (memory) watch.bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }

namespace rimline::tests {

void arm_new(std::uint64_t allocation, bool and_all_later) noexcept {
    watch.is_armed = true;
    watch.is_lasting = and_all_later;
    watch.has_failed = false;
    watch.left = allocation;
}

bool disarm_new() noexcept {
    watch.is_armed = false;
    return watch.has_failed;
}

PeakBytes::PeakBytes() noexcept : before_(watch.bytes) { watch.peak_bytes = watch.bytes; }

std::int64_t PeakBytes::bytes() const noexcept { return watch.peak_bytes - before_; }

}  // namespace rimline::tests
