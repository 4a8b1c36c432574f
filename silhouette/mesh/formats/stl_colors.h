#pragma once

// The colors of the facets of a binary STL, in the two bytes that the format calls the attribute byte count.
//
//     bit        15          14..10   9..5    4..0      each channel from 0 to 31, sRGB
//     VisCAM     1: valid    red      green   blue
//     Magics     0: valid    blue     green   red       if "COLOR=" and four bytes RGBA are in the header
//     MeshLab    always 1    blue     green   red       the same
//
// Rule, without COLOR= (VisCAM, SolidView): a facet has the color of its bits if bit 15 is set, and none if all bits
// are 0. Any other value shows that the attributes are something else. Then no facet has a color, and a warning says so
// if some have bit 15. So random attributes are no colors.
//
// Rule, with COLOR=: a facet has the color of its bits if bit 15 is 0, otherwise that of the header. If bit 15 of all
// facets is set, as MeshLab writes, all have the color of their bits. But all have the color of the header if the
// attributes of all facets are 0, 0x8000 or 0xffff: these stand for no color. Alpha is not used.

#include <cstdint>
#include <glm/vec3.hpp>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace rimline {

struct StlColors {
    /// In linear light, one for each facet; k_no_color for a facet without. Empty if no facet has one.
    std::vector<glm::vec3> colors;
    /// Why colors are not used, without the name of the file, or empty.
    std::string warning;
};

/// The colors of facets with these attributes. `header` has 80 bytes. O(facets). Throws Error{cancelled}.
StlColors stl_colors(std::string_view header, const std::vector<std::uint16_t>& attributes,
                     const std::stop_token& stop = {});

}  // namespace rimline
