#pragma once

// What recording a frame produces besides commands, kept until the GPU is done with the frame.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "engine/frame_report.h"
#include "engine/silhouette_changes.h"
#include "engine/stream/deforming_instance.h"
#include "engine/stream/tracked_silhouette.h"

namespace rimline {

struct RecordedFrame {
    /// Instance and light; no light for the camera.
    using SilhouetteKey = std::pair<std::size_t, std::optional<std::size_t>>;

    std::chrono::steady_clock::time_point started;
    std::vector<TrackedSilhouette*> silhouettes;  ///< Those whose streams the frame records.
    /// Of all silhouettes, in ascending order.
    std::vector<std::pair<SilhouetteKey, SilhouetteBuffers>> buffers;
    DeformedFrame deformed;
    FrameReport report;

    /// Adds a stream, or a silhouette that the GPU finds.
    template <typename Silhouette>
    void add_buffers(const SilhouetteKey& key, const HomogeneousPoint& point,
                     const Silhouette& silhouette) {
        const auto handle = [](const Buffer& buffer) {
            return BufferHandle{buffer.handle(), buffer.address()};
        };
        buffers.push_back({key,
                           {.point = point,
                            .slots = handle(silhouette.slots()),
                            .face_words = handle(silhouette.face_words()),
                            .arguments = handle(silhouette.arguments())}});
    }
    std::optional<SilhouetteBuffers> buffers_of(std::size_t instance,
                                                std::optional<std::size_t> light) const {
        const SilhouetteKey key{instance, light};
        const auto found = std::ranges::lower_bound(buffers, key, {},
                                                    [](const auto& entry) { return entry.first; });
        if (found == buffers.end() || found->first != key) return std::nullopt;
        return found->second;
    }
};

}  // namespace rimline
