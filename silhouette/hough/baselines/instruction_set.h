#pragma once

// One body of plain loops, compiled once for each instruction set, and the version this machine runs.
//
// A kernel is a type with a static, always-inlined `run` over a fixed number of lanes, which the
// compiler turns into whatever registers the version has:
//
//     struct Sum {
//         [[gnu::always_inline]] static inline float run(const std::array<float, 8>& lanes);
//     };
//     const auto sum = best_version<Sum>();   // Kept by whoever calls it often.

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
    [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")]] static Result
    avx512(Arguments... arguments) {
        return Kernel::run(arguments...);
    }
#endif

    static Pointer best() noexcept {
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
            __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
            return avx512;
        if (__builtin_cpu_supports("avx2")) return avx2;
#endif
        return baseline;
    }
};

template <typename Kernel>
using KernelPointer = typename KernelVersions<Kernel, decltype(Kernel::run)>::Pointer;

template <typename Kernel>
KernelPointer<Kernel> best_version() noexcept {
    return KernelVersions<Kernel, decltype(Kernel::run)>::best();
}

}  // namespace rimline
