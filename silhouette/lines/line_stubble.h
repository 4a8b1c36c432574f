#pragma once

// Stubble: short strokes that a pen would not draw. They come and go with the tessellation of the mesh.
//
//   loose   A short stroke with an end where no other stroke is; twice as long, if that is true of both ends. Several
//           that hold only each other, if all together are that short. A closed stroke, or several with each other,
//           counts as half as long if it is as narrow as a sliver: it looks like one line. A
//           short stroke between others, like the short edge of a plate or a piece of an outline between two folds,
//           stays: without it, there would be a gap. So does one that two longer strokes end at, and one with a part
//           of the outline, which has nothing behind it on one side: an outline has no gaps.
//   double  A stroke that is not much longer, all of it beside longer ones, so near that it would only thicken them. Of
//           strokes at the outline and beside it, that at the outline stays, also where it is shorter.
//   tail    The end of a stroke, up to where a longer stroke passes along it, and on as long as it does: where a
//           contour goes to and fro between faces, pieces of it stick out of it. What is short before the longer
//           stroke, and no part of the outline. The stroke is cut there. Sharp edges and borders have no tails: they
//           meet in corners.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/line_options.h"
#include "silhouette/lines/picture_grid.h"

namespace rimline {

class LineStubble {
public:
    /// Takes strokes out of the drawing until none is stubble. A loose stroke is shorter than LineOptions::stubble
    /// for each loose end; closed ones count as having one. LineOptions::gap is how near strokes are to each other
    /// that meet, or that look like one. O(points + pairs of points and segments that share a cell) a round; there
    /// are few rounds. And a ray for each place of a loose stroke and of a tail on both sides of it. Adds points to the
    /// drawing for strokes that are cut.
    void remove(const LineFrame& frame, const LineOptions& options, LineDrawing& drawing);

    /// When a stroke is at the outline: beside the least share of its places (of one at least) there is nothing, at
    /// this share of the gap.
    struct OutlineTest {
        double gap_share, least_share;
    };

private:
    struct Segment {
        glm::dvec2 from, to;
        std::uint32_t stroke;
        EdgeId edge;  // That it lies on, or that the next one does.
    };

    struct StrokePlace {
        glm::dvec2 place, way;
    };

    // Its widths in directions at equal angles, of which the greatest is at least 0.98 of the diameter.
    struct Extent {
        Extent();
        void include(const glm::dvec2& place);
        void include(const Extent& other);
        double diameter() const;
        static constexpr std::size_t k_directions = 8;
        std::array<double, k_directions> low, high;
    };
    static double seen_length(double length, const Extent& extent);

    static glm::dvec2 nearest_on(const Segment& segment, const glm::dvec2& place);
    static double distance_to(const Segment& segment, const glm::dvec2& place);

    void fill(double gap, const LineDrawing& drawing);
    bool is_loose(std::uint32_t stroke, const LineOptions& options) const;
    void find_loose_groups(const LineOptions& options);
    void keep_bridges(const LineOptions& options);
    bool is_at_outline(std::uint32_t stroke, const LineFrame& frame, const LineOptions& options,
                       const OutlineTest& test) const;
    void cut_tails(const LineFrame& frame, const LineOptions& options, LineDrawing& drawing);
    // Whether the mesh is not smooth there.
    static bool is_sharp(EdgeId edge, const LineFrame& frame, const LineOptions& options);
    double tail_of(std::uint32_t stroke, bool is_last, const LineFrame& frame,
                   const LineOptions& options);
    bool is_tail(std::uint32_t stroke, const LineFrame& frame, const LineOptions& options) const;
    double length_of(std::uint32_t stroke) const;
    void cut(std::uint32_t stroke, double begin, double end, bool is_orthographic,
             LineDrawing& drawing);
    void choose_staying(const LineOptions& options);
    bool put_outline_first(const LineFrame& frame, const LineOptions& options);
    bool is_double(std::uint32_t stroke, const LineOptions& options) const;
    // Whether another stroke passes within `reach` of a place.
    bool is_held(const glm::dvec2& place, std::uint32_t stroke, double reach) const;
    // Whether another in stays_ passes beside a place of a stroke within `reach`, in about its way there.
    bool has_other_along(std::uint32_t stroke, const glm::dvec2& way, const glm::dvec2& place,
                         double reach) const;
    // The way of a segment; of a shorter one than this, the way over it and the two beside it.
    glm::dvec2 way_at(std::uint32_t segment, double least) const;
    // Whether is_asked(segment) is true of a segment near to the place.
    template <typename IsAsked>
    bool any_near(const glm::dvec2& place, IsAsked&& is_asked) const;

    PictureGrid grid_;
    std::vector<Segment> segments_;
    std::vector<std::uint32_t> first_segments_;  // Of each stroke, and one more.
    std::vector<double> lengths_, group_lengths_;
    std::vector<Extent> extents_, group_extents_;
    std::vector<std::uint8_t> is_closed_, is_there_, is_loose_, stays_, has_long_;
    enum class Answer : std::uint8_t { unknown, no, yes };
    static Answer answer(bool is_so) noexcept { return is_so ? Answer::yes : Answer::no; }
    std::vector<Answer> has_outline_,
        is_outline_;  // Of each stroke, with a part of the outline, and most of it.
    std::vector<StrokePlace> free_places_;  // Of an end, before a longer stroke passes along it.
    std::vector<std::uint32_t> held_ends_, order_, queue_, neighbors_;
};

}  // namespace rimline
