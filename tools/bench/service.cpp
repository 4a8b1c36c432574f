#include "tools/bench/service.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <thread>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/hough/service/silhouette_service.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

double cpu_seconds(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct CpuTimes {
    double process_s = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
    double thread_s = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
};

double us_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::micro>(to - from).count();
}

Quantiles quantiles(std::vector<double> values_us) {
    if (values_us.empty()) return {};
    std::sort(values_us.begin(), values_us.end());
    const auto at = [&](double share) {
        return values_us[static_cast<std::size_t>(share *
                                                  static_cast<double>(values_us.size() - 1))];
    };
    return {at(0.5), at(0.99), at(0.999), values_us.back()};
}

// Directions distributed evenly over the sphere, by the golden angle.
glm::dvec3 spread_direction(std::uint32_t i, std::uint32_t count) {
    const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(golden_angle * i), across * std::sin(golden_angle * i), z};
}

// The position of the camera (number 0) or a light at each frame.
class Path {
public:
    Path(const Mesh& mesh, std::uint32_t number, std::uint32_t count)
        : center_(mesh.center()),
          orbit_(center_, axis(mesh, number, count),
                 mesh.radius() * (number == 0 ? 2.0 : 1.5 + 2.5 * number / count)),
          is_direction_(number % 8 == 5),
          start_rad_(2.4 * number) {
        double step_degrees = number == 0 ? 0.5 : 0.02 * std::pow(15.0, 1.0 * number / count);
        if (number % 4 == 3) step_degrees = 0.0;
        step_rad_ = step_degrees * std::numbers::pi / 180.0;
    }

    HomogeneousPoint at(std::uint32_t frame) const {
        const double angle_rad = start_rad_ + frame * step_rad_;
        if (!is_direction_) return orbit_.viewpoint(angle_rad);
        return HomogeneousPoint::direction(glm::vec3(orbit_.position(angle_rad) - center_));
    }

private:
    static glm::dvec3 axis(const Mesh& mesh, std::uint32_t number, std::uint32_t count) {
        if (number > 0) return spread_direction(number, count);
        return direction_of(mesh.up());
    }

    glm::dvec3 center_;
    Orbit orbit_;
    bool is_direction_;
    double start_rad_;
    double step_rad_ = 0.0;
};

struct Show {
    std::vector<std::unique_ptr<HoughOctree>> octrees;  // One a model.
    std::vector<Path> paths;                            // One a tracker.

    const HoughOctree& octree_of(std::size_t tracker) const {
        return *octrees[tracker % octrees.size()];
    }
};

// Follows every tracker through some frames by change sets alone. Returns the first difference from brute
// force.
std::string check(SilhouetteService& service, const std::vector<TrackerId>& ids, const Show& show,
                  const Context& context) {
    std::vector<SilhouetteSnapshot> states(ids.size());
    for (std::size_t t = 0; t < ids.size(); ++t) service.snapshot(ids[t], states[t]);
    PublishedChange change;
    for (std::uint32_t frame = 1; frame <= 3; ++frame) {
        context.checkpoint();
        for (std::size_t t = 0; t < ids.size(); ++t)
            service.post(ids[t], show.paths[t].at(30 * frame));
        for (std::size_t t = 0; t < ids.size(); ++t) {
            const std::string place =
                "tracker " + std::to_string(t) + ", frame " + std::to_string(frame);
            SilhouetteSnapshot& state = states[t];
            const Taken taken =
                service.wait_for_change(ids[t]) ? service.take(ids[t], change) : Taken::nothing;
            if (taken == Taken::gap)
                throw Error(ErrorCode::too_large, "there is not enough memory for the changes of " +
                                                      std::to_string(ids.size()) +
                                                      " trackers: take fewer, or smaller models");
            if (taken != Taken::change) return place + ": nothing was published";
            const ChangeSet changes = change.view();
            if (changes.sequence != ++state.sequence) return place + ": a gap in the sequence";
            state.slots.resize(changes.silhouette_size, k_no_edge);
            for (const SlotWrite& write : changes.slots) state.slots.at(write.slot) = write.edge;
            for (const WordWrite& write : changes.words) state.words.at(write.word) = write.bits;

            const Mesh& mesh = show.octree_of(t).mesh();
            const HomogeneousPoint point = show.paths[t].at(30 * frame);
            if (changes.point != point) return place + ": another point";
            if (state.words != brute_force_face_bits(mesh, point)) return place + ": face bits";
            std::vector<EdgeId> edges = state.slots;
            std::sort(edges.begin(), edges.end());
            if (edges != brute_force_silhouette(mesh, point)) return place + ": silhouette";
        }
    }
    return {};
}

void measure(ServiceResult& result, SilhouetteService& service, const std::vector<TrackerId>& ids,
             const Show& show, const ServiceBenchOptions& options, const Context& context) {
    std::vector<double> posts_us;
    std::vector<double> takes_us;
    std::vector<double> latencies_us;
    std::vector<double> camera_latencies_us;
    for (std::vector<double>* times : {&posts_us, &takes_us, &latencies_us})
        times->reserve(std::size_t{options.frames} * ids.size());
    std::vector<PublishedChange> changes(ids.size());
    const auto take_all = [&] {
        for (std::size_t t = 0; t < ids.size(); ++t)
            for (;;) {
                const Clock::time_point start = Clock::now();
                if (service.take(ids[t], changes[t]) != Taken::change) break;
                takes_us.push_back(us_between(start, Clock::now()));
                const double us = us_between(changes[t].posted(), changes[t].published());
                latencies_us.push_back(us);
                if (t == 0) camera_latencies_us.push_back(us);
            }
    };

    Progress progress(context, "running the service");
    const LongCall call = progress.call();
    const SilhouetteServiceCounters before = service.counters();
    const CpuTimes cpu_before;
    const Clock::time_point start = Clock::now();
    const auto frame_time = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1.0 / options.frames_per_second));
    for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
        call.checkpoint(static_cast<double>(frame) / options.frames);
        take_all();
        for (std::size_t t = 0; t < ids.size(); ++t) {
            const HomogeneousPoint point = show.paths[t].at(frame);
            const Clock::time_point post_start = Clock::now();
            service.post(ids[t], point);
            posts_us.push_back(us_between(post_start, Clock::now()));
        }
        const Clock::time_point next = start + (frame + 1) * frame_time;
        std::this_thread::sleep_until(next);
        if (Clock::now() > next + frame_time) ++result.late_frames;
    }
    const CpuTimes cpu_after;
    result.seconds = us_between(start, Clock::now()) * 1e-6;
    take_all();
    const SilhouetteServiceCounters after = service.counters();

    result.posts = after.posts - before.posts;
    result.moves = after.moves - before.moves;
    result.superseded = after.superseded - before.superseded;
    result.lost = after.lost - before.lost;
    const double renderer_s = cpu_after.thread_s - cpu_before.thread_s;
    const double workers_s = cpu_after.process_s - cpu_before.process_s - renderer_s;
    result.core_share = workers_s / result.seconds;
    result.renderer_core_share = renderer_s / result.seconds;
    result.service_move_us =
        1e6 * workers_s / static_cast<double>(std::max<std::uint64_t>(result.moves, 1));
    result.post = quantiles(std::move(posts_us));
    result.take = quantiles(std::move(takes_us));
    result.latency = quantiles(std::move(latencies_us));
    result.camera_latency = quantiles(std::move(camera_latencies_us));
}

// The trackers in turn, frame after frame, in the order of the service's workers.
double direct_move_us(const Show& show, std::uint32_t frames, const Context& context) {
    std::vector<SilhouetteTracker> trackers;
    for (std::size_t t = 0; t < show.paths.size(); ++t) {
        context.checkpoint();
        trackers.emplace_back(show.octree_of(t), show.paths[t].at(0));
    }
    const double before_s = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        context.checkpoint();
        for (std::size_t t = 0; t < trackers.size(); ++t)
            trackers[t].move_to(show.paths[t].at(frame));
    }
    const double seconds = cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - before_s;
    return 1e6 * seconds / (static_cast<double>(frames) * static_cast<double>(trackers.size()));
}

}  // namespace

ServiceResult bench_service(std::span<const ServiceBenchModel> models,
                            const ServiceBenchOptions& options, const Context& context) {
    RIMLINE_CHECK(!models.empty() && options.trackers > 0 && options.frames > 0 &&
                  options.frames_per_second > 0.0);
    ServiceResult result;
    result.trackers = options.trackers;
    result.frames = options.frames;
    Show show;
    for (const ServiceBenchModel& model : models) {
        context.checkpoint();
        result.models.push_back(model.name);
        result.faces += model.mesh->face_count();
        show.octrees.push_back(std::make_unique<HoughOctree>(*model.mesh));
    }
    for (std::uint32_t t = 0; t < options.trackers; ++t)
        show.paths.emplace_back(show.octree_of(t).mesh(), t, options.trackers);
    {
        SilhouetteService service({.workers = options.workers});
        result.workers = service.worker_count();
        std::vector<TrackerId> ids;
        for (std::uint32_t t = 0; t < options.trackers; ++t) {
            context.checkpoint();
            ids.push_back(service.add(show.octree_of(t), show.paths[t].at(0)));
        }
        result.difference = check(service, ids, show, context);
        if (!result.difference.empty()) return result;
        // Returns to the start and uses every buffer once.
        for (std::uint32_t frame = 0; frame < 10; ++frame) {
            PublishedChange change;
            for (std::uint32_t t = 0; t < options.trackers; ++t) {
                service.post(ids[t], show.paths[t].at(frame % 2));
                service.wait_for_change(ids[t]);
                service.take(ids[t], change);
            }
        }
        measure(result, service, ids, show, options, context);
    }
    result.direct_move_us = direct_move_us(show, std::min(options.frames, 200u), context);
    return result;
}

}  // namespace rimline::tools
