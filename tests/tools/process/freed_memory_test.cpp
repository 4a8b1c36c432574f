#include "tools/process/freed_memory.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <cstddef>
#include <memory>

// Sanitizers have allocators of their own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace rimline::tools {
namespace {

long page_faults() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
}

// Touches and frees blocks as large as pictures and buffers of vertices, with smaller ones between.
void touch_blocks() {
    for (const std::size_t bytes : {5u << 20, 300u << 10, 20u << 20, 1u << 20}) {
        const std::unique_ptr<volatile char[]> block(new char[bytes]);
        for (std::size_t at = 0; at < bytes; at += 4096) block[at] = 1;
    }
}

TEST_CASE("freed memory is used again without page faults") {
    keep_freed_memory();
    touch_blocks();
    const long before = page_faults();
    for (int frame = 0; frame < 10; ++frame) touch_blocks();
    CHECK(page_faults() - before < 100);
}

}  // namespace
}  // namespace rimline::tools

#endif
