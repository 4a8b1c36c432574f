// For LD_PRELOAD: makes calls of the C library fail, while main() runs. faults.py sets what fails:
//
//   RIMLINE_FAIL_ALLOCATION=N    the N-th allocation returns null, or throws; with RIMLINE_FAIL_ON=1, all from then on
//                                too; with RIMLINE_FAIL_OWN=1, only those count that the program itself makes, not its
//                                libraries (drivers end the process where their memory is short)
//   RIMLINE_FAIL_WRITE=N         the N-th write to a file that is neither a terminal nor one of the first three
//                                descriptors does what RIMLINE_FAIL_HOW says: full (ENOSPC, and all from then on),
//                                interrupted (EINTR once), short (one byte of it is written)
//   RIMLINE_FAIL_READ=N          the N-th read of a file: interrupted or short
//   RIMLINE_COUNTS=FILE          writes the numbers of allocations, writes and reads to FILE at the end

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

std::atomic<bool> is_counting{false};
// glibc 2.36 crashes in dlopen where memory is short.
thread_local bool is_opening = false;
std::atomic<long> allocations{0}, writes{0}, reads{0};
long failing_allocation = 0, failing_write = 0, failing_read = 0;
bool goes_on = false, only_own = false;
std::uintptr_t program_first = 0, program_last = 0;  // Addresses of the program's own code.
const char* how = "";
int (*true_main)(int, char**, char**);

long number_of(const char* variable) {
    const char* const text = std::getenv(variable);
    return text ? std::atol(text) : 0;
}

// The program comes first.
int note_program(dl_phdr_info* info, std::size_t, void*) {
    program_first = program_last = info->dlpi_addr;
    for (int i = 0; i < info->dlpi_phnum; ++i)
        if (const auto& part = info->dlpi_phdr[i]; part.p_type == PT_LOAD && (part.p_flags & PF_X))
            program_last = info->dlpi_addr + part.p_vaddr + part.p_memsz;
    return 1;
}

bool fails(const void* caller) {
    if (!is_counting || is_opening) return false;
    const auto address = reinterpret_cast<std::uintptr_t>(caller);
    if (only_own && (address < program_first || address >= program_last)) return false;
    const long number = ++allocations;
    if (failing_allocation == 0) return false;
    return number == failing_allocation || (goes_on && number > failing_allocation);
}

int counted_main(int argc, char** argv, char** environment) {
    failing_allocation = number_of("RIMLINE_FAIL_ALLOCATION");
    failing_write = number_of("RIMLINE_FAIL_WRITE");
    failing_read = number_of("RIMLINE_FAIL_READ");
    goes_on = number_of("RIMLINE_FAIL_ON") != 0;
    only_own = number_of("RIMLINE_FAIL_OWN") != 0;
    dl_iterate_phdr(note_program, nullptr);
    if (const char* const text = std::getenv("RIMLINE_FAIL_HOW")) how = text;
    is_counting = true;
    const int status = true_main(argc, argv, environment);
    is_counting = false;
    if (const char* const path = std::getenv("RIMLINE_COUNTS")) {
        std::FILE* const file = std::fopen(path, "w");
        std::fprintf(file, "%ld %ld %ld\n", allocations.load(), writes.load(), reads.load());
        std::fclose(file);
    }
    return status;
}

template <typename Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) int __libc_start_main(int (*main)(int, char**, char**),
                                                             int argc, char** argv, void (*init)(),
                                                             void (*end)(), void (*rtld_end)(),
                                                             void* stack_end) {
    true_main = main;
    return next<decltype(__libc_start_main)>("__libc_start_main")(counted_main, argc, argv, init,
                                                                  end, rtld_end, stack_end);
}

__attribute__((visibility("default"))) void* dlopen(const char* file, int mode) {
    static auto* const true_dlopen = next<void*(const char*, int)>("dlopen");
    is_opening = true;
    void* const library = true_dlopen(file, mode);
    is_opening = false;
    return library;
}

__attribute__((visibility("default"))) void* malloc(std::size_t size) {
    if (fails(__builtin_return_address(0))) return errno = ENOMEM, nullptr;
    return __libc_malloc(size);
}
__attribute__((visibility("default"))) void* calloc(std::size_t count, std::size_t size) {
    if (fails(__builtin_return_address(0))) return errno = ENOMEM, nullptr;
    return __libc_calloc(count, size);
}
__attribute__((visibility("default"))) void* realloc(void* old, std::size_t size) {
    if (fails(__builtin_return_address(0))) return errno = ENOMEM, nullptr;
    return __libc_realloc(old, size);
}
__attribute__((visibility("default"))) void* aligned_alloc(std::size_t alignment,
                                                           std::size_t size) {
    if (fails(__builtin_return_address(0))) return errno = ENOMEM, nullptr;
    return __libc_memalign(alignment, size);
}
__attribute__((visibility("default"))) int posix_memalign(void** out, std::size_t alignment,
                                                          std::size_t size) {
    if (fails(__builtin_return_address(0))) return ENOMEM;
    *out = __libc_memalign(alignment, size);
    return *out ? 0 : ENOMEM;
}

__attribute__((visibility("default"))) ssize_t write(int descriptor, const void* data,
                                                     std::size_t size) {
    static auto* const true_write = next<ssize_t(int, const void*, std::size_t)>("write");
    if (is_counting && descriptor > 2) {
        const long number = ++writes;
        if (failing_write > 0 && std::strcmp(how, "full") == 0 && number >= failing_write)
            return errno = ENOSPC, -1;
        if (number == failing_write && std::strcmp(how, "interrupted") == 0)
            return errno = EINTR, -1;
        if (number == failing_write && std::strcmp(how, "short") == 0 && size > 1) size = 1;
    }
    return true_write(descriptor, data, size);
}

__attribute__((visibility("default"))) ssize_t read(int descriptor, void* data, std::size_t size) {
    static auto* const true_read = next<ssize_t(int, void*, std::size_t)>("read");
    if (is_counting && descriptor > 2) {
        const long number = ++reads;
        if (number == failing_read && std::strcmp(how, "interrupted") == 0)
            return errno = EINTR, -1;
        if (number == failing_read && std::strcmp(how, "short") == 0 && size > 1) size = 1;
    }
    return true_read(descriptor, data, size);
}

}  // extern "C"

// Those of the C++ library would call malloc in the program's place.
__attribute__((visibility("default"))) void* operator new(std::size_t size) {
    void* const memory =
        fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size == 0 ? 1 : size);
    if (!memory) throw std::bad_alloc();
    return memory;
}
__attribute__((visibility("default"))) void* operator new[](std::size_t size) {
    void* const memory =
        fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size == 0 ? 1 : size);
    if (!memory) throw std::bad_alloc();
    return memory;
}
__attribute__((visibility("default"))) void* operator new(std::size_t size,
                                                          const std::nothrow_t&) noexcept {
    return fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size == 0 ? 1 : size);
}
__attribute__((visibility("default"))) void operator delete(void* memory) noexcept {
    std::free(memory);
}
__attribute__((visibility("default"))) void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
__attribute__((visibility("default"))) void operator delete[](void* memory) noexcept {
    std::free(memory);
}
__attribute__((visibility("default"))) void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
