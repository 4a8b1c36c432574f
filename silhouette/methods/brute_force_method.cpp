#include "silhouette/methods/brute_force_method.h"

namespace rimline {

void BruteForceMethod::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                               TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    brute_force_.look_from(point);
    brute_force_.silhouette(edges);
    counters.face_checks += mesh_->face_count();
    counters.edge_checks += mesh_->edges_of_class(EdgeClass::border).first;
}

void BruteForceMethod::update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                              TraversalCounters& counters) {
    if (!tracker_) {
        tracker_.emplace(*mesh_, point);
        counters.face_checks += mesh_->face_count();
        counters.edge_checks += mesh_->edges_of_class(EdgeClass::border).first;
    } else {
        counters += tracker_->move_to(point).counters;
    }
    edges.assign(tracker_->silhouette().begin(), tracker_->silhouette().end());
}

}  // namespace rimline
