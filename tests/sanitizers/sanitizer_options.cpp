// What the sanitizers are told, in every program built with them: hooks that their runtimes call.
//
// Drivers, the loader and the window system are not ours to fix, and are named one by one; all else
// stays reported. What a driver allocates for an object of ours that we forget to destroy is hidden
// too: that is the validation layer's to find.

#define RIMLINE_HOOK extern "C" __attribute__((visibility("default"), used))

// A leak's stack is named when the program ends; by then a driver that was unloaded has no name, and
// no suppression can match it. So nothing is unloaded.
RIMLINE_HOOK int dlclose(void* /*handle*/) { return 0; }

// The text of a string that grew has a stack that ends in the standard library, which keeps no frame
// pointers: whether it was the validation layer's is lost. None of ours can leak alone: what holds it
// would be reported.
RIMLINE_HOOK const char* __lsan_default_suppressions() {
    return "leak:libvulkan_lvp.so\n"
           "leak:libLLVM-15.so.1\n"
           "leak:libVkLayer_khronos_validation.so\n"
           "leak:std::__cxx11::basic_string<*>::_M_mutate\n";
}

RIMLINE_HOOK const char* __tsan_default_suppressions() {
    return "race:libvulkan_lvp.so\n"
           "race:libLLVM-15.so.1\n"
           "race:libVkLayer_khronos_validation.so\n"
           "race:libvulkan.so.1\n"
           "race:libxcb.so\n"
           "race:libX11-xcb.so\n";
}

#if defined(__SANITIZE_THREAD__)
#include <tbb/global_control.h>

// oneTBB's library is not instrumented: the thread sanitizer does not see that it joins its threads, and
// takes what was written before for a race with what is read after. So it gets one thread here; that
// results do not depend on the number of threads is tested without the sanitizer.
static const tbb::global_control k_one_thread(tbb::global_control::max_allowed_parallelism, 1);
#endif
