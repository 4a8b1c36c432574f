// What every source includes that Highway compiles once for each instruction set, before all else that is
// compiled so. The source names itself first:
//
//     #undef HWY_TARGET_INCLUDE
//     #define HWY_TARGET_INCLUDE "silhouette/hough/block_kernels.cpp"
//     #include "silhouette/vector_targets-inl.h"
//
// No include guard: foreach_target.h includes the source again for each instruction set, and what follows it
// here has guards of its own.

// Vectors are members of structs in these sources, which registers of unknown size cannot be. Machines with
// such registers have NEON as well. The later additions of AVX-512 bring nothing.
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)

// First: it must come before all that is compiled once for each target.
#include <hwy/foreach_target.h>
//
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "silhouette/squeezed_lanes-inl.h"
