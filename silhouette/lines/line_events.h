#pragma once

// The places where the invisibility of lines changes.
//
// A line that passes behind another one gains or loses that line's balance: so many faces more lie left of it
// than right of it. Lines with a balance are looked up in a grid over the picture. Besides, a line changes where
// it meets faces that are not its own (FaceContacts).

#include <cstdint>
#include <vector>

#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/picture_box.h"
#include "silhouette/lines/picture_grid.h"

namespace rimline {

class LineEvents {
public:
    /// Sets event_begin and events of the frame. O(lines + pairs of lines that share a cell).
    void find(LineFrame& frame);

private:
    // A line that hides others.
    struct Occluder {
        FlatLine flat;
        std::uint32_t line;
    };
    struct Box {
        PictureBox area;
        float depth;  // The least, rounded down.
        std::uint32_t occluder;
    };

    void fill_grid(const LineFrame& frame);
    template <typename Visit>
    void each_candidate(const FlatLine& flat, std::uint32_t line, Visit&& visit);
    void find_crossings(LineFrame& frame);
    void cross(LineFrame& frame, std::uint32_t line, const Occluder& occluder);
    void find_contacts(LineFrame& frame);
    void add_piercings(LineFrame& frame);
    void add_edge_crossings(LineFrame& frame);
    void add_footholds(LineFrame& frame);
    void add_contact(LineFrame& frame, std::uint32_t line, std::int32_t jump,
                     double share_in_space);
    void cross_segment(LineFrame& frame, std::uint32_t line, const Occluder& occluder);
    void find_events_of_intersections(LineFrame& frame);
    void sort(LineFrame& frame);

    PictureGrid grid_;
    PictureSteps steps_;
    std::vector<Occluder> occluders_;
    std::vector<Box> boxes_;             // By place in the grid.
    std::vector<std::uint32_t> tested_;  // By occluder: the last line tested against it.
    std::vector<std::uint32_t> line_of_edge_;
    std::vector<LineEvent> found_;
    std::vector<std::uint32_t> next_;
};

}  // namespace rimline
