#include "tests/soak/soak_record.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/engine/faults/vulkan_faults.h"

namespace rimline::tests {

namespace {

// Of the histogram: 64 a factor of two, from 2^-32 s.
constexpr double k_bins_an_octave = 64.0;
constexpr int k_octaves = 48;
// Of memory, after the first tenth.
constexpr double k_growth = 0.01;
// Pages that the heap happens to hold.
constexpr double k_spare_bytes = 256.0 * 1024.0;

std::uint64_t entries_of(const char* folder) {
    return static_cast<std::uint64_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                    std::filesystem::directory_iterator()));
}

// Without pages of files, and without code compiled at run time: Mesa 22.3's CPU driver leaves some behind with each
// device.
std::uint64_t anonymous_bytes() {
    std::ifstream maps("/proc/self/smaps");
    std::string line;
    bool is_counted = true;
    std::uint64_t kilobytes = 0;
    while (std::getline(maps, line)) {
        std::istringstream words(line);
        std::string first, permissions, offset, device, node, path;
        words >> first >> permissions;
        if (first == "Anonymous:")
            kilobytes += is_counted ? std::stoull(permissions) : 0;
        else if (first.find('-') != std::string::npos) {
            words >> offset >> device >> node >> path;
            is_counted = permissions.find('x') == std::string::npos || !path.empty();
        }
    }
    return 1024 * kilobytes;
}

}  // namespace

Holdings holdings_now() {
    malloc_trim(0);
    const struct mallinfo2 heap = mallinfo2();
    return {.anonymous_bytes = anonymous_bytes(),
            .heap_bytes = heap.uordblks + heap.hblkhd,
            .descriptors = entries_of("/proc/self/fd"),
            .threads = entries_of("/proc/self/task"),
            .vulkan_objects = live_objects().size()};
}

SoakRecord::SoakRecord(std::string name, double seconds, const SoakLimits& limits)
    : name_(std::move(name)),
      limits_(limits),
      started_s_(wall_clock_s()),
      first_tenth_s_(started_s_ + 0.1 * seconds),
      end_s_(started_s_ + seconds),
      histogram_(static_cast<std::size_t>(k_octaves * k_bins_an_octave)) {}

bool SoakRecord::goes_on() {
    const double now_s = wall_clock_s();
    if (!is_first_tenth_over_ && now_s >= first_tenth_s_) {
        is_first_tenth_over_ = true;
        after_first_tenth_ = holdings_now();
    }
    return now_s < end_s_;
}

void SoakRecord::add_step(double seconds) {
    ++steps_;
    if (!is_first_tenth_over_) return;
    const double octaves = std::log2(std::max(seconds, 1e-9)) + 32.0;
    const double bin = std::clamp(octaves * k_bins_an_octave, 0.0, double(histogram_.size() - 1));
    ++histogram_[static_cast<std::size_t>(bin)];
}

bool SoakRecord::report() {
    const Holdings now = holdings_now();
    std::uint64_t judged = 0;
    for (const std::uint64_t count : histogram_) judged += count;
    const auto quantile_s = [&](double share) {
        double below = 0.0;
        std::size_t bin = 0;
        for (; bin + 1 < histogram_.size(); ++bin) {
            below += double(histogram_[bin]);
            if (below >= share * double(judged)) break;
        }
        return std::exp2((double(bin) + 0.5) / k_bins_an_octave - 32.0);
    };
    const double median_s = quantile_s(0.5), slow_s = quantile_s(0.999);
    const Holdings& then = after_first_tenth_;
    std::printf(
        "%-8s %10llu in %.0f s; median %.3f ms, p99.9 %.3f ms (%.1f); %.1f MB to %.1f MB, of the "
        "heap %.2f MB to %.2f MB, %llu to "
        "%llu "
        "descriptors, %llu to %llu threads, %llu to %llu Vulkan objects\n",
        name_.c_str(), static_cast<unsigned long long>(steps_), wall_clock_s() - started_s_,
        1e3 * median_s, 1e3 * slow_s, slow_s / median_s, 1e-6 * double(then.anonymous_bytes),
        1e-6 * double(now.anonymous_bytes), 1e-6 * double(then.heap_bytes),
        1e-6 * double(now.heap_bytes), static_cast<unsigned long long>(then.descriptors),
        static_cast<unsigned long long>(now.descriptors),
        static_cast<unsigned long long>(then.threads), static_cast<unsigned long long>(now.threads),
        static_cast<unsigned long long>(then.vulkan_objects),
        static_cast<unsigned long long>(now.vulkan_objects));
    bool is_kept = true;
    const auto require = [&](bool holds, const char* what) {
        if (!holds) std::printf("FAILED   %s: %s\n", name_.c_str(), what);
        is_kept = is_kept && holds;
    };
    require(judged > 0, "no step after the first tenth: give it more time");
    const auto has_grown = [&](std::uint64_t from, std::uint64_t to) {
        return double(to) > (1.0 + k_growth) * double(from) + k_spare_bytes +
                                double(judged * limits_.lost_bytes);
    };
    require(!has_grown(then.heap_bytes, now.heap_bytes), "its heap grows");
    require(!limits_.judges_anonymous || !has_grown(then.anonymous_bytes, now.anonymous_bytes),
            "its memory grows");
    require(now.descriptors <= then.descriptors, "it keeps descriptors");
    require(now.threads <= then.threads, "it keeps threads");
    require(now.vulkan_objects <= then.vulkan_objects, "it keeps Vulkan objects");
    require(limits_.slowest == 0.0 || slow_s <= limits_.slowest * median_s,
            "some steps take too long");
    std::fflush(stdout);
    return is_kept;
}

double wall_clock_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double thread_clock_s() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace rimline::tests
