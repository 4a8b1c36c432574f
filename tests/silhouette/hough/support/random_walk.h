#pragma once

// Moves of every kind a silhouette point makes: tiny and large, teleports, back and forth, none at all,
// from viewpoint to direction and back.

#include <cmath>

#include "tests/silhouette/hough/support/probe_points.h"

namespace rimline::tests {

class RandomWalk {
public:
    RandomWalk(const Mesh& mesh, std::uint64_t seed)
        : probes_(mesh, seed), point_(probes_.next()), previous_(point_) {}

    const HomogeneousPoint& point() const { return point_; }

    HomogeneousPoint next() {
        const HomogeneousPoint from = point_;
        switch (probes_.random_below(8)) {
            case 0:
            case 1: point_ = probes_.near(point_, step(-26.0, -8.0)); break;
            case 2: point_ = probes_.near(point_, step(-8.0, -3.0)); break;
            case 3: point_ = probes_.near(point_, step(-3.0, 2.0)); break;
            case 4: point_ = probes_.next(); break;
            case 5: point_ = previous_; break;
            case 6: point_ = probes_.other_kind(point_); break;
            default: break;  // No move.
        }
        previous_ = from;
        return point_;
    }

private:
    double step(double low, double high) {
        return probes_.radius() * std::exp2(probes_.uniform(low, high));
    }

    ProbePoints probes_;
    HomogeneousPoint point_;
    HomogeneousPoint previous_;
};

}  // namespace rimline::tests
