#pragma once

// Numbers out of the bytes that the fuzzer makes, and what a target does when something is wrong.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline::fuzz {

/// Ends the run, so that the fuzzer keeps its input.
[[noreturn]] inline void fail(const std::string& what) {
    std::fprintf(stderr, "fuzz: %s\n", what.c_str());
    std::abort();
}

inline void require(bool holds, const char* what) {
    if (!holds) fail(what);
}

/// A message that a user could read: it begins with the name of the file and is one line without control
/// characters.
inline void require_message(const std::string& message, const std::string& name) {
    if (!message.starts_with(name)) fail("a message without the file's name: " + message);
    for (const char c : message)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            fail("a message with control characters: " + message);
}

class FuzzInput {
public:
    FuzzInput(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

    bool is_empty() const noexcept { return bytes_.empty(); }
    std::size_t size() const noexcept { return bytes_.size(); }

    /// 0 at the end.
    std::uint8_t byte() {
        if (bytes_.empty()) return 0;
        const std::uint8_t first = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return first;
    }
    /// Less than `limit`, at most 256.
    std::uint32_t below(std::uint32_t limit) { return byte() * limit / 256; }

    /// A coordinate within k_max_coordinate: mostly small numbers, of which many are equal; else powers of two,
    /// subnormals, neighbors of earlier numbers, or any bits.
    float coordinate() {
        const std::uint8_t kind = byte();
        float value = 0.0f;
        if (kind < 128) {
            value = static_cast<float>(kind % 16) - 8.0f;
        } else if (kind < 160) {
            value = std::ldexp(kind % 2 == 0 ? 1.0f : -1.0f, int(byte()) - 187);
        } else if (kind < 200) {
            value = std::nextafter(last_, kind % 2 == 0 ? 1e30f : -1e30f);
        } else if (kind < 216) {
            value = last_ + static_cast<float>(byte()) * 0x1p-20f;
        } else {
            std::uint32_t bits = 0;
            for (int i = 0; i < 4; ++i) bits = bits << 8 | byte();
            std::memcpy(&value, &bits, sizeof value);
        }
        if (!(std::abs(value) <= k_max_coordinate)) value = k_max_coordinate;
        return last_ = value;
    }
    glm::vec3 point() {
        const float x = coordinate(), y = coordinate(), z = coordinate();
        return {x, y, z};
    }
    HomogeneousPoint viewpoint_or_direction() {
        const bool is_direction = byte() % 4 == 0;
        const glm::vec3 at = point();
        return is_direction ? HomogeneousPoint::direction(at) : HomogeneousPoint::viewpoint(at);
    }
    /// At most `max_faces` faces among few vertices, so that most edges have several.
    MeshSource mesh(std::uint32_t max_faces) {
        MeshSource source;
        const std::uint32_t vertices = 3 + below(max_faces + 3), faces = 1 + below(max_faces);
        for (std::uint32_t v = 0; v < vertices; ++v) source.positions.push_back(point());
        for (std::uint32_t f = 0; f < faces; ++f)
            source.triangles.push_back({below(vertices), below(vertices), below(vertices)});
        return source;
    }

private:
    std::span<const std::uint8_t> bytes_;
    float last_ = 0.0f;
};

}  // namespace rimline::fuzz
