#pragma once

// Lines that coincide in the picture, of which one is drawn: in a view of a box from the front, the edges of its
// back lie on those of its front.
//
// Visible lines come first, then hidden ones. A stretch is covered where a line that came before lies along it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/lines/line_frame.h"
#include "silhouette/lines/picture_box.h"
#include "silhouette/lines/picture_grid.h"

namespace rimline {

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
    /// O(lines + pairs of nearly parallel lines that share a cell).
    void find(const LineFrame& frame, CoveredStretches& covered);

private:
    struct Stretch {
        std::uint32_t line;
        std::array<glm::dvec2, 2> ends;
        double begin, end;
        double length;  // In the picture.
        // Its direction, and how far that of a line may be from it that passes within the tolerance of both ends.
        std::uint16_t direction, most_turn;
    };
    struct Box {
        PictureBox area;
        std::uint32_t stretch;
        std::uint16_t direction, most_turn;
    };
    PictureGrid grid_;
    std::vector<Stretch> stretches_, hidden_;  // First the visible ones: the first of two stays.
    std::vector<Box> boxes_;  // By place in the grid.
    std::vector<CoveredStretch> found_;
    std::vector<std::uint32_t> tested_;
};

}  // namespace rimline
