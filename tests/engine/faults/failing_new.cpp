#include "tests/engine/faults/failing_new.h"

#include <cstddef>
#include <cstdlib>
#include <new>

#include "tests/engine/faults/vulkan_faults.h"

// Set by the linker: where the program's code begins and ends.
extern "C" const char __executable_start;
extern "C" const char etext;

namespace rimline::tests {

namespace {

struct Countdown {
    bool is_armed = false;
    bool is_counting = false;
    bool has_failed = false;
    std::uint64_t left = 0;
};
thread_local Countdown countdown;

void* allocate(std::size_t size, std::size_t alignment, const void* caller) {
    const char* const place = static_cast<const char*>(caller);
    if (countdown.is_armed && countdown.is_counting && !is_keeping_books() &&
        place >= &__executable_start && place < &etext && countdown.left-- == 0) {
        countdown.is_armed = false;
        countdown.has_failed = true;
        throw std::bad_alloc();
    }
    // aligned_alloc wants whole multiples.
    void* const memory =
        alignment > alignof(std::max_align_t)
            ? std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment)
            : std::malloc(size > 0 ? size : 1);
    if (!memory) throw std::bad_alloc();
    return memory;
}

}  // namespace

void arm_new(std::uint64_t allocation) noexcept {
    countdown = {.is_armed = true, .left = allocation};
}

bool disarm_new() noexcept {
    countdown.is_armed = false;
    return countdown.has_failed;
}

CountingNew::CountingNew() noexcept { countdown.is_counting = true; }
CountingNew::~CountingNew() { countdown.is_counting = false; }

}  // namespace rimline::tests

using rimline::tests::allocate;

void* operator new(std::size_t size) { return allocate(size, 0, __builtin_return_address(0)); }
void* operator new[](std::size_t size) { return allocate(size, 0, __builtin_return_address(0)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment), __builtin_return_address(0));
}
// Those that do not throw never fail here, but must come from where delete gives back to: a sanitizer has
// its own.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return std::malloc(size > 0 ? size : 1);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
