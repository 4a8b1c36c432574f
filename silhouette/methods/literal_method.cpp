#include "silhouette/methods/literal_method.h"

namespace rimline {

void LiteralMethod::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                            TraversalCounters& counters) {
    LiteralCounters work;
    octree_.extract(point, edges, work);
    take(work, counters);
}

void LiteralMethod::update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                           TraversalCounters& counters) {
    if (tracker_)
        tracker_->move_to(point);
    else
        tracker_.emplace(octree_, point);
    take(tracker_->counters(), counters);
    edges.assign(tracker_->silhouette().begin(), tracker_->silhouette().end());
}

void LiteralMethod::take(const LiteralCounters& work, TraversalCounters& counters) {
    work_ = work;
    counters += {work.box_checks(), work.face_checks, work.edge_tests};
}

std::vector<NamedCount> LiteralMethod::own_counts() const {
    return {{"obv_checks", work_.obv_checks},
            {"pbv_checks", work_.pbv_checks},
            {"ebv_checks", work_.ebv_checks},
            {"contained_faces", work_.contained_faces},
            {"nodes_enqueued", work_.nodes_enqueued}};
}

}  // namespace rimline
