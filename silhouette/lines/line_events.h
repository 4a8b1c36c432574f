#pragma once

// The places where the invisibility of lines changes.
//
// A line that passes behind another one gains or loses that line's balance: so many faces more lie left of it
// than right of it. Besides, a line changes where it meets faces that are not its own (FaceContacts).

#include <cstdint>
#include <stop_token>
#include <vector>

#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/picture_tree.h"

namespace rimline {

class LineEvents {
public:
    /// Sets event_begin and events of the frame; and, if asked for, its parallels. O(lines log lines + pairs of lines
    /// whose boxes meet in the picture). Throws Error{cancelled}.
    void find(LineFrame& frame, bool finds_parallels, const std::stop_token& stop = {});

private:
    void fill_tree(const LineFrame& frame, double margin);
    void find_crossings(LineFrame& frame, bool finds_parallels, const std::stop_token& stop);
    void cross(LineFrame& frame, std::uint32_t line, std::uint32_t occluder);
    void find_contacts(LineFrame& frame);
    void add_piercings(LineFrame& frame);
    void add_edge_crossings(LineFrame& frame);
    void add_footholds(LineFrame& frame);
    void add_contact(LineFrame& frame, std::uint32_t line, std::int32_t jump,
                     double share_in_space);
    void cross_segment(LineFrame& frame, std::uint32_t line, std::uint32_t occluder);
    void add_passages(LineFrame& frame);
    void sort(LineFrame& frame);

    PictureTree tree_;
    std::vector<std::uint32_t> line_of_edge_;
    std::vector<LineEvent> found_;
    std::vector<std::uint32_t> next_;
};

}  // namespace rimline
