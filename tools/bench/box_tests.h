#pragma once

// Ways to test a box of Hough points against a v-sphere, to count what each costs in a static extraction of
// the literal octree (thesis 3.4.1). The text does not say which one it counts with.
//
// The v-sphere of q (v_sphere.h, w = 1) has the center q/2 and the radius |q|/2. Each test is sure of what it
// says, in real numbers; where it is not sure it says mixed, so a looser test visits more nodes and finds the
// same edges.
//
//   exact          On each axis the least and the greatest of h(h - q) over the box, summed. The test of
//                  VSphere, without its margin.
//   spheres        The sphere around the box (center and half diagonal) against the v-sphere.
//   inside_sphere  Outside as exact, inside by the sphere around the box.
//   sphere_box     Outside where the box is apart from the tightest axis-aligned box around the v-sphere;
//                  inside as exact.
//   intervals      Interval arithmetic on |H|² - H·q as it is written: bounds of |H|² and of H·q apart.

#include <array>
#include <cstdint>
#include <string_view>

#include "silhouette/methods/literal/literal_octree.h"

namespace rimline::tools {

enum class BoxTest : std::uint8_t { exact, spheres, inside_sphere, sphere_box, intervals };

constexpr std::array<BoxTest, 5> k_box_tests{BoxTest::exact, BoxTest::spheres,
                                             BoxTest::inside_sphere, BoxTest::sphere_box,
                                             BoxTest::intervals};
std::string_view name_of(BoxTest test) noexcept;

/// The side of `box`, which is not empty, of the v-sphere of `q` relative to the origin of Hough space.
VSphereSide side_of(const HoughBox& box, const glm::dvec3& q, BoxTest test) noexcept;

/// The PBVs and EBVs that an extraction from a viewpoint tests. With `is_ebv_first` a node's EBV is tested
/// before its PBV, the other way round than in LiteralOctree::extract().
LiteralCounters count_boxes(const LiteralOctree& octree, const HomogeneousPoint& viewpoint,
                            BoxTest test, bool is_ebv_first = false);

}  // namespace rimline::tools
