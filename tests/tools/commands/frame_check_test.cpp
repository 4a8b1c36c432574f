#include "tools/commands/frame_check.h"

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/options/track_path.h"

using namespace rimline;
using tools::FrameCheck;

namespace {

// A change set that owns its lists, to be spoilt.
struct OwnedChange {
    explicit OwnedChange(const ChangeSet& from)
        : change(from),
          flipped(from.flipped.begin(), from.flipped.end()),
          added(from.added.begin(), from.added.end()),
          removed(from.removed.begin(), from.removed.end()),
          slots(from.slots.begin(), from.slots.end()),
          words(from.words.begin(), from.words.end()) {}

    ChangeSet view() {
        change.flipped = flipped;
        change.added = added;
        change.removed = removed;
        change.slots = slots;
        change.words = words;
        return change;
    }

    ChangeSet change;
    std::vector<FaceId> flipped;
    std::vector<EdgeId> added, removed;
    std::vector<SlotWrite> slots;
    std::vector<WordWrite> words;
};

}  // namespace

TEST_CASE("a frame check passes true change sets and finds whatever is spoilt in one") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const HoughOctree octree(mesh);
    const HomogeneousPoint from = HomogeneousPoint::viewpoint({4, 1, 2});
    const HomogeneousPoint to = HomogeneousPoint::viewpoint({3.9f, 1.2f, 2.1f});
    const std::vector<std::pair<const char*, std::function<void(OwnedChange&)>>> spoilers{
        {"nothing", [](OwnedChange&) {}},
        {"a face too few", [](OwnedChange& c) { c.flipped.pop_back(); }},
        {"a face twice", [](OwnedChange& c) { c.flipped.push_back(c.flipped[0]); }},
        {"an added edge too few", [](OwnedChange& c) { c.added.pop_back(); }},
        {"an added edge twice", [](OwnedChange& c) { c.added.push_back(c.added[0]); }},
        {"a removed edge too few", [](OwnedChange& c) { c.removed.pop_back(); }},
        {"added and removed swapped", [](OwnedChange& c) { c.added.swap(c.removed); }},
        {"a slot too few", [](OwnedChange& c) { c.slots.pop_back(); }},
        {"a slot with another edge", [](OwnedChange& c) { c.slots[0].edge = c.slots[1].edge; }},
        {"a slot out of range", [](OwnedChange& c) { c.slots[0].slot = c.change.silhouette_size; }},
        {"a word too few", [](OwnedChange& c) { c.words.pop_back(); }},
        {"a bit turned", [](OwnedChange& c) { c.words[0].bits ^= 4; }},
        {"a word out of range", [](OwnedChange& c) { c.words[0].word = 1u << 30; }},
        {"another size", [](OwnedChange& c) { --c.change.silhouette_size; }},
        {"another point", [&](OwnedChange& c) { c.change.point = from; }}};
    for (const auto& [name, spoil] : spoilers) {
        CAPTURE(name);
        SilhouetteTracker tracker(octree, from);
        FrameCheck check(tracker);
        OwnedChange owned(tracker.move_to(to));
        REQUIRE(owned.added.size() > 2);
        REQUIRE(owned.removed.size() > 2);
        REQUIRE(owned.slots.size() > 2);
        spoil(owned);
        CHECK(check.difference(owned.view()).has_value() == (std::string(name) != "nothing"));
    }
}

TEST_CASE("a frame check follows a tracker over many frames") {
    const Mesh mesh(make_built_in_shape("terrain", 500));
    const HoughOctree octree(mesh);
    const auto points = tools::random_path(mesh, 11, 300);
    SilhouetteTracker tracker(octree, points[0]);
    FrameCheck check(tracker);
    for (const HomogeneousPoint& point : points)
        CHECK(check.difference(tracker.move_to(point)).value_or("") == "");
}
