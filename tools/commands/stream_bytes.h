#pragma once

// The number of bytes that a frame sends to a consumer of change sets. The consumer holds slots and face
// words in its own memory: a GPU behind a bus, or a program behind a socket.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "silhouette/hough/change_set.h"

namespace rimline::tools {

struct StreamBytes {
    /// The writes of the change set, or the whole state if that is smaller.
    std::uint64_t streamed = 0;
    /// The whole state: the slots in use and all words of face bits.
    std::uint64_t full = 0;

    StreamBytes& operator+=(const StreamBytes& other) noexcept {
        streamed += other.streamed;
        full += other.full;
        return *this;
    }
};

inline StreamBytes stream_bytes(const ChangeSet& change, std::size_t face_words) noexcept {
    const std::uint64_t full =
        sizeof(EdgeId) * std::uint64_t{change.silhouette_size} + sizeof(std::uint32_t) * face_words;
    const std::uint64_t writes = change.slots.size_bytes() + change.words.size_bytes();
    return {std::min(writes, full), full};
}

}  // namespace rimline::tools
