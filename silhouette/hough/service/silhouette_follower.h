#pragma once

// Connects one tracker of a SilhouetteService to a consumer that needs the silhouette for an exact point,
// for example for the next frame.
//
//     announce(point of frame t + 1)         draw frame t          follow(point of frame t + 1)
//             |                                                        ^ waits only for the rest
//             +--> service: the tracker moves on a worker's thread ----+
//
// The service guarantees that the tracker reaches the latest posted point, and that change sets are in
// order. follow() posts its point unless it was announced, and takes change sets up to the one of that
// post. The consumer and the tracker are then at the point, and nothing is pending. One snapshot replaces
// the change sets if one is missing, if the consumer has no state, or if the consumer prefers the whole
// state.

#include "silhouette/hough/service/silhouette_service.h"

namespace rimline {

class SilhouetteFollower {
public:
    /// Adds a tracker at `point`. The destructor removes it. The service and the octree must outlive the
    /// follower. Throws the same errors as SilhouetteService::add().
    SilhouetteFollower(SilhouetteService& service, const HoughOctree& octree,
                       const HomogeneousPoint& point)
        : service_(&service), tracker_(service.add(octree, point)), posted_(point) {}
    ~SilhouetteFollower() { service_->remove(tracker_); }
    SilhouetteFollower(const SilhouetteFollower&) = delete;
    SilhouetteFollower& operator=(const SilhouetteFollower&) = delete;

    /// Posts the probable point of the next follow(). Does not wait. A wrong guess costs one move.
    void announce(const HomogeneousPoint& point) noexcept {
        if (point == posted_) return;
        posted_at_ = PublishedChange::Clock::now();
        // The service was stopped. follow() will throw.
        if (!service_->post(tracker_, point)) return;
        posted_ = point;
        is_pending_ = true;
    }

    /// Brings the consumer to `point`. It must be the consumer of all earlier calls, except after
    /// invalidate(). Calls
    ///     bool consumer.apply(const ChangeSet&)          for each change set, until it returns false
    ///                                                    because it needs the whole state, and
    ///     void consumer.resend(const SilhouetteSnapshot&) at most once, with the state at `point`.
    /// Throws Error{cancelled} if the service was stopped before it reached `point`, std::bad_alloc, and
    /// what the consumer throws. Then, or if the consumer has lost its state, call invalidate().
    template <typename Consumer>
    void follow(const HomogeneousPoint& point, Consumer& consumer) {
        announce(point);
        if (!(point == posted_)) throw_stopped();
        while (is_pending_) {
            const Taken taken = service_->take(tracker_, change_);
            if (taken == Taken::nothing) {
                wait_for_change();
                continue;
            }
            if (taken != Taken::change) break;  // Only a snapshot helps.
            // Before apply(), which may throw: the change set is taken, so waiting for it would never end.
            is_pending_ = change_.posted() < posted_at_ || !(change_.view().point == posted_);
            needs_snapshot_ = needs_snapshot_ || !consumer.apply(change_.view());
        }
        if (needs_snapshot_ || is_pending_) {
            needs_snapshot_ = true;
            read_tracker(snapshot_);
            is_pending_ = false;
            consumer.resend(snapshot_);
            needs_snapshot_ = false;
        }
        reached_ = point;
    }

    /// Call this if the consumer has lost its state. The next follow() sends the whole state.
    void invalidate() noexcept { needs_snapshot_ = true; }

    /// The point of the last follow().
    const HomogeneousPoint& point() const noexcept { return reached_; }
    /// The tracker's state there, for comparison with the consumer's state. Not allowed after announce()
    /// until the next follow().
    void read_state(SilhouetteSnapshot& snapshot) {
        RIMLINE_CHECK(!is_pending_);
        read_tracker(snapshot);
    }

    TrackerId tracker() const noexcept { return tracker_; }
    /// Memory reserved by the tracker. Waits if a worker is moving it.
    std::uint64_t tracker_bytes() const noexcept { return service_->size_bytes(tracker_); }

private:
    [[noreturn]] static void throw_stopped() {
        throw Error(ErrorCode::cancelled,
                    "the silhouette service was stopped while silhouettes were followed");
    }
    void wait_for_change() {
        if (!service_->wait_for_change(tracker_)) throw_stopped();
    }
    // Reads the tracker's state at the last posted point.
    void read_tracker(SilhouetteSnapshot& snapshot) {
        for (;;) {
            service_->snapshot(tracker_, snapshot);
            if (snapshot.point == posted_) return;
            wait_for_change();
        }
    }

    SilhouetteService* service_;
    TrackerId tracker_;
    HomogeneousPoint posted_;
    PublishedChange::Clock::time_point posted_at_{};  // Between the last two posts.
    bool is_pending_ = false;  // The change set of the last post was not taken yet.
    bool needs_snapshot_ = true;
    HomogeneousPoint reached_{};
    PublishedChange change_;  // Members, to reuse their memory.
    SilhouetteSnapshot snapshot_;
};

}  // namespace rimline
