#pragma once

// Where an edge meets a face or another edge, of which exact signs say that it does (face_contacts.h). Doubles lose that
// where the two are nearly parallel: a place from them may lie anywhere, or nowhere. These are correct to a few roundings
// all the same.

#include <glm/vec3.hpp>

namespace rimline {

/// The share of the way from `a` to `b` at which it passes the plane of p, q and r, in [0, 1]. The two must lie on
/// different sides of it.
double share_to_plane(const glm::vec3& a, const glm::vec3& b, const glm::vec3& p,
                      const glm::vec3& q, const glm::vec3& r) noexcept;

/// The share of the way from `a` to `b` at which it crosses that from `c` to `d`, in [0, 1]. The two must cross.
double share_to_crossing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                         const glm::vec3& d) noexcept;

}  // namespace rimline
