#pragma once

// Index types of point sets. silhouette/mesh/ids.h has those of meshes.

#include <array>
#include <cstdint>

namespace rimline {

enum class PointId : std::uint32_t {};
enum class UmbrellaId : std::uint32_t {};

constexpr std::uint32_t index(PointId id) noexcept { return static_cast<std::uint32_t>(id); }
constexpr std::uint32_t index(UmbrellaId id) noexcept { return static_cast<std::uint32_t>(id); }

/// Two points, the lesser first.
using PointEdge = std::array<PointId, 2>;

}  // namespace rimline
