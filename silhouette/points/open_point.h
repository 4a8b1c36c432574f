#pragma once

// A point whose umbrella has gaps, while it is decided whether the surface ends there.

#include <cstdint>

#include "silhouette/points/fan.h"

namespace rimline {

struct OpenPoint {
    enum class Verdict : std::uint8_t { border, crease, none };
    std::uint32_t point;
    Fan fan;         ///< With its gaps; of a crease, the umbrella of one side.
    Fan supplement;  ///< Of a crease, the umbrella of the other side; else none.
    Verdict verdict = Verdict::none;
};

}  // namespace rimline
