#include "silhouette/hough/service/change_outbox.h"

#include <doctest/doctest.h>

#include <thread>
#include <vector>

#include "tests/silhouette/hough/service/allocation_faults.h"

namespace rimline {
namespace {

constexpr TrackerId k_owner{7};
const std::vector<FaceId> some_faces(100, FaceId{1});

ChangeSet numbered(std::uint64_t sequence) {
    ChangeSet changes;
    changes.sequence = sequence;
    changes.flipped = some_faces;
    return changes;
}

TEST_CASE("change sets come out as they went in, as many as there are places") {
    ChangeOutbox box(3);
    box.open(k_owner);
    PublishedChange out;
    CHECK(box.take(k_owner, out).taken == Taken::nothing);
    std::uint64_t next_in = 1;
    std::uint64_t next_out = 1;
    for (int round = 0; round < 5; ++round) {
        while (box.has_room()) REQUIRE(box.publish(numbered(next_in++), {}));
        CHECK(next_in - next_out == 3);
        for (int i = 0; i < 2; ++i) {
            const ChangeOutbox::TakeResult result = box.take(k_owner, out);
            REQUIRE(result.taken == Taken::change);
            CHECK(result.made_room == (i == 0));
            CHECK(out.view().sequence == next_out++);
            CHECK(out.view().flipped.size() == some_faces.size());
        }
    }
}

TEST_CASE("a whole state makes room and the next change set follows on it") {
    ChangeOutbox box(2);
    box.open(k_owner);
    PublishedChange out;
    CHECK(!box.drop_pending());
    box.publish(numbered(1), {});
    box.publish(numbered(2), {});
    CHECK(box.drop_pending());
    CHECK(box.take(k_owner, out).taken == Taken::nothing);
    box.publish(numbered(3), {});
    REQUIRE(box.take(k_owner, out).taken == Taken::change);
    CHECK(out.view().sequence == 3);
}

TEST_CASE("a change set lost for want of memory shows as a gap behind those before it") {
    ChangeOutbox box(4);
    box.open(k_owner);
    REQUIRE(box.publish(numbered(1), {}));
    {
        const tests::AllocationFaults out_of_memory;
        CHECK(!box.publish(numbered(2), {}));
    }
    CHECK(!box.publish(numbered(3), {}));  // Of no use without the second.
    PublishedChange out;
    CHECK(box.wait(k_owner));
    REQUIRE(box.take(k_owner, out).taken == Taken::change);
    CHECK(out.view().sequence == 1);
    CHECK(box.wait(k_owner));
    CHECK(box.take(k_owner, out).taken == Taken::gap);
    CHECK(box.take(k_owner, out).taken == Taken::gap);
    box.drop_pending();
    CHECK(box.take(k_owner, out).taken == Taken::nothing);
    REQUIRE(box.publish(numbered(4), {}));
    REQUIRE(box.take(k_owner, out).taken == Taken::change);
    CHECK(out.view().sequence == 4);
}

TEST_CASE("nobody takes what is another tracker's") {
    ChangeOutbox box(2);
    box.open(k_owner);
    box.publish(numbered(1), {});
    PublishedChange out;
    CHECK(box.take(TrackerId{8}, out).taken == Taken::removed);
    CHECK(!box.wait(TrackerId{8}));
    box.open(TrackerId{9});
    CHECK(box.take(k_owner, out).taken == Taken::removed);
    CHECK(box.take(TrackerId{9}, out).taken == Taken::nothing);
    box.close();
    CHECK(box.take(TrackerId{9}, out).taken == Taken::removed);
}

TEST_CASE("who waits is told of a change set, of the tracker's end and of the end of waits") {
    ChangeOutbox box(2);
    box.open(k_owner);
    bool result = false;
    std::thread first([&] { result = box.wait(k_owner); });
    box.publish(numbered(1), {});
    first.join();
    CHECK(result);

    PublishedChange out;
    box.take(k_owner, out);
    std::thread second([&] { result = box.wait(k_owner); });
    box.close();
    second.join();
    CHECK(!result);

    box.open(k_owner);
    result = true;
    std::thread third([&] { result = box.wait(k_owner); });
    box.end_waits();
    third.join();
    CHECK(!result);
    box.publish(numbered(1), {});
    CHECK(box.wait(k_owner));  // What is there can still be had.
}

}  // namespace
}  // namespace rimline
