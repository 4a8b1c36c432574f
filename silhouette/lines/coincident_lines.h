#pragma once

// Lines that coincide in the picture, of which one is drawn: in a view of a box from the front, the edges of its
// back lie on those of its front.
//
// Visible lines come first, then hidden ones. A stretch is covered where a line that came before lies along it.

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/lines/line_frame.h"

namespace rimline {

/// Seen from the eye, and not from the point beside it, lines coincide that are so near to each other from there. In a
/// perspective picture it is a share of the picture of the mesh, from four radii away on: what moves beside
/// another thing is the difference of two shifts.
double coincidence_tolerance(const LineFrame& frame);

/// False where the two lines coincide nowhere, but for stretches of a hundred tolerances or less.
bool may_coincide(const FlatLine& a, const FlatLine& b, double tolerance) noexcept;

/// A stretch of a line that another one covers, as shares in the picture of its FlatLine.
struct CoveredStretch {
    std::uint32_t line;
    double begin, end;
};

/// By line, and of each line ascending and apart from each other.
class CoveredStretches {
public:
    std::span<const CoveredStretch> of(std::uint32_t line) const noexcept {
        if (begin_.empty()) return {};
        return {stretches_.data() + begin_[line], stretches_.data() + begin_[line + 1]};
    }
    void clear() noexcept {
        begin_.clear();
        stretches_.clear();
    }

private:
    friend class CoincidentLines;
    std::vector<std::uint32_t> begin_;
    std::vector<CoveredStretch> stretches_;
};

class CoincidentLines {
public:
    /// Of the frame's parallels. O(lines + parallels log parallels). Throws Error{cancelled}.
    void find(LineFrame& frame, CoveredStretches& covered, const std::stop_token& stop = {});

private:
    // A piece of a line of one visibility.
    struct Stretch {
        std::uint32_t line;
        std::array<glm::dvec2, 2> ends;
        double begin, end;
        double length;  // In the picture.
        bool is_hidden;
    };
    static void find_stretches(const LineFrame& frame, std::uint32_t line,
                               std::vector<Stretch>& stretches);
    void cover(const Stretch& own, const Stretch& other, double tolerance);

    std::vector<Stretch> stretches_, others_;
    std::vector<CoveredStretch> found_;
};

}  // namespace rimline
