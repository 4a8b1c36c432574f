#pragma once

// Plain loops that are compiled once for each instruction set, and the best version for this machine.
//
// A kernel is a type with a static, always-inlined `run` over a fixed number of lanes, which the
// compiler translates to the registers of each version:
//
//     struct Sum {
//         [[gnu::always_inline]] static inline float run(const std::array<float, 8>& lanes);
//     };
//     const auto sum = best_version<Sum>();   // Store it where it is called often.

#include <vector>

namespace rimline {

template <typename Kernel, typename Function>
struct KernelVersions;

template <typename Kernel, typename Result, typename... Arguments>
struct KernelVersions<Kernel, Result(Arguments...)> {
    using Pointer = Result (*)(Arguments...);

    static Result baseline(Arguments... arguments) { return Kernel::run(arguments...); }
#if defined(__x86_64__)
    [[gnu::target("avx2")]] static Result avx2(Arguments... arguments) {
        return Kernel::run(arguments...);
    }
#if defined(__clang__)  // clang has no such preference and would ignore the other names with it.
    [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] static Result
#else
    [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")]] static Result
#endif
    avx512(Arguments... arguments) {
        return Kernel::run(arguments...);
    }
#endif

    /// The versions that this machine can run, the best last.
    static std::vector<Pointer> all() {
        std::vector<Pointer> versions{baseline};
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx2")) versions.push_back(avx2);
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
            versions.push_back(avx512);
#endif
        return versions;
    }
};

template <typename Kernel>
using KernelPointer = typename KernelVersions<Kernel, decltype(Kernel::run)>::Pointer;

template <typename Kernel>
KernelPointer<Kernel> best_version() {
    return KernelVersions<Kernel, decltype(Kernel::run)>::all().back();
}

/// For tests: all versions give the same results.
template <typename Kernel>
std::vector<KernelPointer<Kernel>> all_versions() {
    return KernelVersions<Kernel, decltype(Kernel::run)>::all();
}

}  // namespace rimline
