#include "tools/commands/point_turn.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "silhouette/hough/orbit.h"
#include "silhouette/points/point_silhouette.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

PointTurn measure_turn(const UmbrellaIndex& umbrellas, const glm::dvec3& up, std::uint32_t frames,
                       double step_deg, bool verify, const Context& context) {
    RIMLINE_CHECK(frames > 0);
    const Orbit orbit(umbrellas.center(), up, 2.0 * std::max(umbrellas.radius(), 0x1p-20));
    const double step_rad = step_deg * std::numbers::pi / 180.0;
    PointSilhouette silhouette(umbrellas, orbit.viewpoint(0.0));
    PointTurn turn{.frames = frames, .step_deg = step_deg};
    std::vector<double> frame_us;
    Progress progress(context, "turning");
    const LongCall call = progress.call();
    for (std::uint32_t frame = 1; frame <= frames; ++frame) {
        if (frame % 16 == 0) call.checkpoint(double(frame) / frames);
        const HomogeneousPoint point = orbit.viewpoint(frame * step_rad);
        PointSilhouette::Change change{};
        frame_us.push_back(time_step_us([&] { change = silhouette.move_to(point); }));
        turn.changed_points += double(change.added.size() + change.removed.size()) / frames;
        if (!verify) continue;
        const PointSilhouette fresh(umbrellas, point);
        turn.differences += fresh.points() != silhouette.points() ||
                            fresh.consensus_edges() != silhouette.consensus_edges();
    }
    turn.median_us = quantile(frame_us, 0.5);
    turn.p99_us = quantile(frame_us, 0.99);
    turn.worst_us = quantile(frame_us, 1.0);
    return turn;
}

}  // namespace rimline::tools
