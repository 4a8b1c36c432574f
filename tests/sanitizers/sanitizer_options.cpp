// What the sanitizers are told, in every program built with them: hooks that their runtimes call.
//
// Drivers, the loader and the window system are not ours to fix, and are named one by one; all else
// stays reported. What a driver allocates for an object of ours that we forget to destroy is hidden
// too: that is the validation layer's to find.

#define RIMLINE_HOOK extern "C" __attribute__((visibility("default"), used))

// A leak's stack is named when the program ends; by then a driver that was unloaded has no name, and
// no suppression can match it. So nothing is unloaded.
RIMLINE_HOOK int dlclose(void* /*handle*/) { return 0; }

RIMLINE_HOOK const char* __lsan_default_suppressions() {
    return "leak:libvulkan_lvp.so\n"
           "leak:libLLVM-15.so.1\n"
           "leak:libVkLayer_khronos_validation.so\n";
}

RIMLINE_HOOK const char* __tsan_default_suppressions() {
    return "race:libvulkan_lvp.so\n"
           "race:libLLVM-15.so.1\n"
           "race:libVkLayer_khronos_validation.so\n"
           "race:libvulkan.so.1\n"
           "race:libxcb.so\n"
           "race:libX11-xcb.so\n";
}
