#include "tools/bench/service_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace rimline::tools {

namespace {

void print_quantiles(const char* name, const Quantiles& q) {
    std::printf("  %-28s %10.2f %10.2f %10.2f %10.2f\n", name, q.median_us, q.p99_us, q.p999_us,
                q.max_us);
}

nlohmann::ordered_json to_json(const Quantiles& q) {
    return {{"median_us", q.median_us},
            {"p99_us", q.p99_us},
            {"p999_us", q.p999_us},
            {"max_us", q.max_us}};
}

unsigned long long whole(std::uint64_t count) { return count; }

}  // namespace

void print_result(const ServiceResult& result) {
    std::printf("service: %u trackers on", result.trackers);
    for (const std::string& model : result.models) std::printf(" %s", model.c_str());
    std::printf(", %llu faces; %u workers\n", whole(result.faces), result.workers);
    if (!result.difference.empty()) {
        std::printf("  not measured: it differs from brute force: %s\n", result.difference.c_str());
        return;
    }
    std::printf("  %u frames in %.2f s, %llu of them late by a frame or more\n", result.frames,
                result.seconds, whole(result.late_frames));
    std::printf("  posts %llu, moves %llu, superseded %llu, lost %llu\n", whole(result.posts),
                whole(result.moves), whole(result.superseded), whole(result.lost));
    std::printf("  cores taken: workers %.3f, the posting and taking thread %.3f\n",
                result.core_share, result.renderer_core_share);
    std::printf(
        "  a move: %.2f us of processor time in the service, %.2f us in a loop without it\n",
        result.service_move_us, result.direct_move_us);
    std::printf("  %-28s %10s %10s %10s %10s\n", "", "median us", "p99 us", "p99.9 us", "max us");
    print_quantiles("post", result.post);
    print_quantiles("take", result.take);
    print_quantiles("post to publication", result.latency);
    print_quantiles("of the camera", result.camera_latency);
}

nlohmann::ordered_json to_json(const ServiceResult& result) {
    nlohmann::ordered_json object{
        {"models", result.models},     {"faces", result.faces},
        {"trackers", result.trackers}, {"workers", result.workers},
        {"frames", result.frames},     {"verified", result.difference.empty()}};
    if (!result.difference.empty()) return object;
    object.update({{"seconds", result.seconds},
                   {"late_frames", result.late_frames},
                   {"posts", result.posts},
                   {"moves", result.moves},
                   {"superseded", result.superseded},
                   {"lost", result.lost},
                   {"core_share", result.core_share},
                   {"renderer_core_share", result.renderer_core_share},
                   {"service_move_us", result.service_move_us},
                   {"direct_move_us", result.direct_move_us},
                   {"post", to_json(result.post)},
                   {"take", to_json(result.take)},
                   {"latency", to_json(result.latency)},
                   {"camera_latency", to_json(result.camera_latency)}});
    return object;
}

}  // namespace rimline::tools
