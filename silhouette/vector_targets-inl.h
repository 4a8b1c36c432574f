// The preamble of every source that Highway compiles once for each instruction set. The source names itself
// first:
//
//     #undef HWY_TARGET_INCLUDE
//     #define HWY_TARGET_INCLUDE "silhouette/hough/block_kernels.cpp"
//     #include "silhouette/vector_targets-inl.h"
//
// It has no include guard: Highway's foreach_target includes the source again for each instruction set. The
// headers below have guards of their own.

// Vectors are members of structs in these sources, which registers of unknown size cannot be. Machines with
// such registers have NEON as well. The later additions of AVX-512 bring nothing.
#define HWY_DISABLED_TARGETS \
    (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3 | HWY_AVX3_DL)

// Must come before all headers with code for each target.
#include <hwy/foreach_target.h>
//
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "silhouette/squeezed_lanes-inl.h"
