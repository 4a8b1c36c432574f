#include "tools/commands/stream_bytes.h"

#include <doctest/doctest.h>

#include <array>

namespace rimline::tools {
namespace {

TEST_CASE("what is streamed is the writes, or the whole state where that is less") {
    const std::array<SlotWrite, 2> slots{};
    const std::array<WordWrite, 3> words{};
    ChangeSet change;
    change.silhouette_size = 10;
    change.slots = slots;
    change.words = words;
    CHECK(stream_bytes(change, 5).streamed == 2 * 8 + 3 * 8);
    CHECK(stream_bytes(change, 5).full == 10 * 4 + 5 * 4);
    change.silhouette_size = 2;
    CHECK(stream_bytes(change, 5).streamed == 2 * 4 + 5 * 4);
}

}  // namespace
}  // namespace rimline::tools
