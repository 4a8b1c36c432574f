#include "engine/stream/mip_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "silhouette/error.h"
#include "silhouette/srgb.h"

namespace rimline {

namespace {

// Between bytes of sRGB and linear light.
struct SrgbTables {
    std::array<float, 256> linear;
    std::array<float, 255> limits;  // Between the linear light of a byte and that of the next.

    SrgbTables() {
        const auto decoded = [](float byte) {
            return linear_from_srgb(glm::vec3(byte / 255.0f)).x;
        };
        for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = decoded(float(i));
        for (std::size_t i = 0; i < limits.size(); ++i) limits[i] = decoded(float(i) + 0.5f);
    }
    std::uint8_t encoded(float value) const {
        return static_cast<std::uint8_t>(std::ranges::upper_bound(limits, value) - limits.begin());
    }
};

// The pixels of a row or column of `from` pixels that pixel `i` of `to` covers, with their shares of it: at most
// three, because `from` is at most three times `to`.
struct Covered {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::array<float, 3> shares{};
};

Covered covered(std::uint32_t from, std::uint32_t to, std::uint32_t i) {
    const std::uint64_t begin = std::uint64_t{i} * from;  // In parts of 1 / to of a pixel.
    const std::uint64_t end = begin + from;
    Covered cover{static_cast<std::uint32_t>(begin / to), 0, {}};
    for (std::uint64_t at = begin; at < end; ++cover.count) {
        const std::uint64_t next = std::min(end, (at / to + 1) * to);
        cover.shares[cover.count] = static_cast<float>(next - at) / static_cast<float>(from);
        at = next;
    }
    return cover;
}

Picture half(const SrgbTables& srgb, const Picture& large) {
    Picture small{std::max(large.width / 2, 1u), std::max(large.height / 2, 1u), {}};
    small.rgba.reserve(std::size_t{4} * small.width * small.height);
    for (std::uint32_t y = 0; y < small.height; ++y) {
        const Covered rows = covered(large.height, small.height, y);
        for (std::uint32_t x = 0; x < small.width; ++x) {
            const Covered columns = covered(large.width, small.width, x);
            std::array<float, 3> sum{};
            float alpha = 0.0f;
            for (std::uint32_t r = 0; r < rows.count; ++r)
                for (std::uint32_t c = 0; c < columns.count; ++c) {
                    const float share = rows.shares[r] * columns.shares[c];
                    const std::uint8_t* pixel =
                        &large.rgba[4 * (std::size_t{large.width} * (rows.first + r) +
                                         columns.first + c)];
                    for (std::size_t i = 0; i < 3; ++i) sum[i] += share * srgb.linear[pixel[i]];
                    alpha += share * pixel[3];
                }
            for (const float channel : sum) small.rgba.push_back(srgb.encoded(channel));
            small.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::min(alpha, 255.0f))));
        }
    }
    return small;
}

}  // namespace

std::vector<Picture> mip_levels(const Picture& picture, std::uint32_t max_side) {
    RIMLINE_CHECK(picture.width > 0 && picture.height > 0 && max_side > 0);
    const SrgbTables srgb;
    std::vector<Picture> levels{picture};
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(half(srgb, levels.back()));
    std::erase_if(levels, [&](const Picture& level) {
        return std::max(level.width, level.height) > max_side;
    });
    return levels;
}

}  // namespace rimline
