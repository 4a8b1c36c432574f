#pragma once

// What the faces of a line's own vertices do to it: its balance, and its invisibility by them at both ends.
//
// At a vertex v of line v-w, a face (v, a, b) covers the line where w lies between a and b as seen around v. It
// hides it there where it lies in front of w. Faces that v touches without being a corner of them
// (FaceContacts) count likewise.
//
//            a            the plane through the eye, v and w has a on one side and b on the other,
//           /             and the side of w at v is the one that the face opens to
//      v ----- w
//           \.
//            b

#include "silhouette/lines/line_frame.h"

namespace rimline {

/// Sets balance of the edge lines, and their locals. A silhouette between two faces whose balance is 0 is not
/// one by its faces' corners: it becomes a crease, drawn if it bends by `crease_angle_rad` and
/// `draws_creases`. O(lines · faces of a vertex).
void find_locals(LineFrame& frame, bool draws_creases, float crease_angle_rad);

/// Whether a face covers the line from `from` to `to` at `from` in the picture. `from` is a corner of the face
/// where `side` is k_corner, else as FaceContacts::Touch says.
constexpr std::uint32_t k_corner = 4;
bool covers(const LineFrame& frame, std::uint32_t face, std::uint32_t side, std::uint32_t from,
            std::uint32_t to);
/// Whether the plane of a face lies between the eye and the vertex.
bool lies_before(const LineFrame& frame, std::uint32_t face, std::uint32_t vertex);

}  // namespace rimline
