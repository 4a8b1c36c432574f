#pragma once

// How the points of a cloud are drawn.

#include <cstdint>

namespace rimline::tools {

enum class CloudLook {
    discs,  ///< A surface.
    dots,   ///< Discs of few points would be plates.
};

constexpr std::uint32_t k_min_disc_points = 5000;

constexpr CloudLook usual_look(std::uint32_t points) {
    return points < k_min_disc_points ? CloudLook::dots : CloudLook::discs;
}

}  // namespace rimline::tools
