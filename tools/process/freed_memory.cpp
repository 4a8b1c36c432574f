#include "tools/process/freed_memory.h"

#include <cstdlib>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace rimline::tools {

void keep_freed_memory() {
#if defined(__GLIBC__)
    mallopt(M_MMAP_THRESHOLD, 32 << 20);  // The most that glibc takes.
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

}  // namespace rimline::tools
