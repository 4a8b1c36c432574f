#pragma once

// A consumer of one tracker of a SilhouetteService that needs the silhouette of an exact point, such as
// that of the frame it is about to draw.
//
//     announce(point of frame t + 1)         draw frame t          follow(point of frame t + 1)
//             |                                                        ^ waits only for what is left
//             +--> service: the tracker moves on a worker's thread ----+
//
// The service promises that the latest point posted is reached, and that change sets come in order. So
// the follower posts its point, where that was not announced, and takes change sets up to that post's:
// then the consumer, the tracker and the point are at one, and nothing is on its way. Where change sets
// will not do, because one is missing or because the consumer has no state or finds the whole smaller, one
// snapshot replaces them.

#include "silhouette/hough/service/silhouette_service.h"

namespace rimline {

class SilhouetteFollower {
public:
    /// Adds a tracker at `point`, and removes it in the end. The service and the octree must outlive the
    /// follower. Throws what SilhouetteService::add() does.
    SilhouetteFollower(SilhouetteService& service, const HoughOctree& octree,
                       const HomogeneousPoint& point)
        : service_(&service), tracker_(service.add(octree, point)), posted_(point) {}
    ~SilhouetteFollower() { service_->remove(tracker_); }
    SilhouetteFollower(const SilhouetteFollower&) = delete;
    SilhouetteFollower& operator=(const SilhouetteFollower&) = delete;

    /// Says where the next follow() will probably lead. Does not wait. A wrong guess costs its move.
    void announce(const HomogeneousPoint& point) noexcept {
        if (point == posted_) return;
        posted_at_ = PublishedChange::Clock::now();
        // False for a stopped service; follow() will say so.
        if (!service_->post(tracker_, point)) return;
        posted_ = point;
        is_on_its_way_ = true;
    }

    /// Leads a consumer that has seen all earlier calls, but for invalidate(), to `point`: calls
    ///     bool consumer.apply(const ChangeSet&)          once for each change set on the way, until it
    ///                                                    says that only the whole state will do, and
    ///     void consumer.resend(const SilhouetteSnapshot&) once at most, with the state at `point`.
    /// Throws Error{cancelled} when the service was stopped before it got there, std::bad_alloc, and what
    /// the consumer throws; call invalidate() then, as after everything that leaves the consumer behind.
    template <typename Consumer>
    void follow(const HomogeneousPoint& point, Consumer& consumer) {
        announce(point);
        if (!(point == posted_)) throw_stopped();
        while (is_on_its_way_) {
            const Taken taken = service_->take(tracker_, change_);
            if (taken == Taken::nothing) {
                wait_for_change();
                continue;
            }
            if (taken != Taken::change) break;  // Only a snapshot leads on.
            // First: it is taken even where the consumer throws, and would be waited for in vain.
            is_on_its_way_ = change_.posted() < posted_at_ || !(change_.view().point == posted_);
            needs_whole_ = needs_whole_ || !consumer.apply(change_.view());
        }
        if (needs_whole_ || is_on_its_way_) {
            needs_whole_ = true;
            read_tracker(snapshot_);
            is_on_its_way_ = false;
            consumer.resend(snapshot_);
            needs_whole_ = false;
        }
        reached_ = point;
    }

    /// The consumer has lost its state: the next follow() sends all of it.
    void invalidate() noexcept { needs_whole_ = true; }

    /// Where the last follow() led.
    const HomogeneousPoint& point() const noexcept { return reached_; }
    /// The tracker's own state there: an oracle for the consumer's. Only while nothing was announced since.
    void read_state(SilhouetteSnapshot& snapshot) {
        RIMLINE_CHECK(!is_on_its_way_);
        read_tracker(snapshot);
    }

    TrackerId tracker() const noexcept { return tracker_; }
    /// Memory that the tracker has reserved. Waits for the worker that moves it, if one does.
    std::uint64_t tracker_bytes() const noexcept { return service_->size_bytes(tracker_); }

private:
    [[noreturn]] static void throw_stopped() {
        throw Error(ErrorCode::cancelled,
                    "the silhouette service was stopped while silhouettes were followed");
    }
    void wait_for_change() {
        if (!service_->wait_for_change(tracker_)) throw_stopped();
    }
    // The tracker's state at the point posted last.
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
    PublishedChange::Clock::time_point posted_at_{};  // Between the last post and the one before.
    bool is_on_its_way_ = false;  // The change set of the last post has not been taken.
    bool needs_whole_ = true;
    HomogeneousPoint reached_{};
    PublishedChange change_;  // Kept for their memory.
    SilhouetteSnapshot snapshot_;
};

}  // namespace rimline
