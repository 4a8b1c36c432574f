#pragma once

// How devices sample a picture by default (engine/sampling.h), for tests on a device of one type.

#include <array>

#include "engine/renderer.h"

namespace rimline::tests {

/// Of devices of the CPU type, and of GPUs.
inline const std::array<RendererOptions, 2> k_default_samplings{
    {{.samples = 1, .scale = 2}, {.samples = 4, .scale = 1}}};

}  // namespace rimline::tests
