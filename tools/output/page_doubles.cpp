#include "tools/output/page_doubles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "silhouette/lines/picture_grid.h"

namespace rimline::tools {

namespace {

// In shares of the reach: how long the steps are that lines are divided into, and the least length of a double. What
// crosses a line at 20 degrees is within reach of it for less.
constexpr double k_step = 0.25, k_min_double = 6.0;
constexpr double k_max_steps = 2e6;
// What is beside a step and so far from it along the line is on the other side of a fold.
constexpr double k_min_fold = 3.0;
// The direction of a line is that over so many steps to both sides: lines of scans are not straight.
constexpr std::size_t k_direction_steps = 3;
// Doubles run in about the same direction, and beside each other: within 30 degrees, unless they touch.
constexpr double k_min_square_cos = 0.75, k_touching = 0.125;

double square(double x) { return x * x; }

class PageDoubles {
public:
    // Of hidden lines or of visible ones.
    PageDoubles(std::span<const PageLine> lines, bool are_hidden, double reach)
        : lines_(lines), are_hidden_(are_hidden), reach_(reach) {
        double length = 0.0;
        for (const PageLine& line : lines) length += line.length_mm();
        step_ = std::max(k_step * reach, length / k_max_steps);
        for (const PageLine& line : lines) add_steps(line);
        fill_grid();
        find();
    }

    bool is_whole(std::size_t line) const {
        if (lines_[line].is_hidden != are_hidden_) return true;
        const std::span<const std::uint8_t> there = there_in(line);
        return std::ranges::find(there, 0) == there.end();
    }

    // Of a line that is not whole.
    std::vector<PageLine> rest_of(std::size_t number) const {
        const PageLine& line = lines_[number];
        const std::span<const std::uint8_t> there = there_in(number);
        // A closed line begins where nothing is left of it.
        const std::size_t start =
            line.is_closed ? std::size_t(std::ranges::find(there, 0) - there.begin()) : 0;
        std::vector<PageLine> rest;
        const Step* last = nullptr;  // Of the part that goes on.
        for (std::size_t i = 0; i < there.size(); ++i) {
            const std::size_t at = (start + i) % there.size();
            if (there[at] == 0) {
                last = nullptr;
                continue;
            }
            const Step& step = steps_[begins_[number] + at];
            if (last == nullptr) {
                rest.push_back({.kind = line.kind,
                                .is_hidden = line.is_hidden,
                                .is_closed = false,
                                .points = {step.from},
                                .curves = {},
                                .chains = line.chains,
                                .edges = line.edges,
                                .ink = line.ink});
            } else if (!last->ends_at_point) {
                rest.back().points.pop_back();
            }
            rest.back().points.push_back(step.to);
            last = &step;
        }
        for (PageLine& part : rest) {
            std::ranges::transform(part.points, part.points.begin(), rounded_to_um);
            const auto repeated = std::ranges::unique(part.points);
            part.points.erase(repeated.begin(), repeated.end());
        }
        std::erase_if(rest, [](const PageLine& part) { return part.points.size() < 2; });
        return rest;
    }

private:
    struct Step {
        glm::dvec2 from, to;
        glm::dvec2 direction;  // Of length 1, or 0.
        std::uint32_t line;
        bool ends_at_point;  // Of the line's.
    };

    std::span<const std::uint8_t> there_in(std::size_t line) const {
        return std::span(is_there_).subspan(begins_[line], begins_[line + 1] - begins_[line]);
    }

    void add_steps(const PageLine& line) {
        const auto number = static_cast<std::uint32_t>(begins_.size() - 1);
        const std::size_t first = steps_.size(), points = line.points.size();
        for (std::size_t i = 0; i + (line.is_closed ? 0 : 1) < points; ++i) {
            const glm::dvec2 a = line.points[i], b = line.points[(i + 1) % points];
            const auto count = static_cast<std::size_t>(1.0 + glm::distance(a, b) / step_);
            for (std::size_t k = 0; k < count; ++k)
                steps_.push_back({glm::mix(a, b, double(k) / double(count)),
                                  glm::mix(a, b, double(k + 1) / double(count)),
                                  {},
                                  number,
                                  k + 1 == count});
        }
        begins_.push_back(steps_.size());
        double arc = 0.0;
        for (std::size_t i = first; i < steps_.size(); ++i)
            arcs_.push_back(arc += glm::distance(steps_[i].from, steps_[i].to));
        for (std::size_t i = first; i < steps_.size(); ++i) {
            const std::size_t begin = i - std::min(i - first, k_direction_steps);
            const std::size_t end = std::min(i + k_direction_steps, steps_.size() - 1);
            const glm::dvec2 way = steps_[end].to - steps_[begin].from;
            const double length = glm::length(way);
            steps_[i].direction = length > 0.0 ? way / length : glm::dvec2(0.0);
        }
    }

    void fill_grid() {
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
        for (const Step& step : steps_) {
            low = glm::min(low, glm::min(step.from, step.to));
            high = glm::max(high, glm::max(step.from, step.to));
        }
        // Between a place and a step within reach of it lies a cell that both are this near to.
        grid_.reset(low, high, 2.0 * reach_, 0.5 * reach_);
        for (std::uint32_t i = 0; i < steps_.size(); ++i)
            grid_.add(i, steps_[i].from, steps_[i].to);
        grid_.finish();
    }

    // Whether another line that stays passes beside the step.
    bool is_beside_other(const Step& own) const {
        return is_beside(own, [&](std::uint32_t i) { return steps_[i].line != own.line; });
    }

    // Whether the line itself does, more than k_min_fold along it away from there: it turns back.
    bool is_beside_itself(std::uint32_t own) const {
        const std::uint32_t line = steps_[own].line;
        const double length = arcs_[begins_[line + 1] - 1];
        return is_beside(steps_[own], [&](std::uint32_t i) {
            if (steps_[i].line != line) return false;
            const double between = std::abs(arcs_[i] - arcs_[own]);
            return (lines_[line].is_closed ? std::min(between, length - between) : between) >
                   k_min_fold * reach_;
        });
    }

    // Whether one of the steps that stay and are asked for passes beside the step.
    template <typename IsAsked>
    bool is_beside(const Step& own, IsAsked&& is_asked) const {
        const glm::dvec2 place = glm::mix(own.from, own.to, 0.5);
        bool found = false;
        grid_.each_cell(place, place, [&](std::uint32_t cell) {
            for (const std::uint32_t i : grid_.segments_in(cell)) {
                if (found) return;
                const Step& other = steps_[i];
                if (is_there_[i] == 0 || !is_asked(i)) continue;
                if (square(glm::dot(own.direction, other.direction)) < k_min_square_cos) continue;
                const glm::dvec2 way = other.to - other.from;
                const double share = glm::dot(place - other.from, way) / glm::dot(way, way);
                const glm::dvec2 aside =
                    glm::mix(other.from, other.to, std::clamp(share, 0.0, 1.0)) - place;
                const double distance = glm::length(aside);
                found = distance <= k_touching * reach_ ||
                        (distance <= reach_ && square(glm::dot(own.direction, aside)) <=
                                                   (1.0 - k_min_square_cos) * square(distance));
            }
        });
        return found;
    }

    void find() {
        is_there_.assign(steps_.size(), 0);
        std::vector<std::size_t> order;
        std::vector<double> lengths(lines_.size());
        for (std::size_t line = 0; line < lines_.size(); ++line) {
            lengths[line] = lines_[line].length_mm();
            if (lines_[line].is_hidden == are_hidden_)
                order.push_back(line);
            else if (are_hidden_)
                std::fill(is_there_.begin() + std::ptrdiff_t(begins_[line]),
                          is_there_.begin() + std::ptrdiff_t(begins_[line + 1]), 1);
        }
        std::ranges::stable_sort(order, std::ranges::greater{},
                                 [&](std::size_t line) { return lengths[line]; });
        for (const std::size_t line : order) find_in(line);
    }

    void find_in(std::size_t line) {
        const std::size_t begin = begins_[line], count = begins_[line + 1] - begin;
        std::vector<std::uint8_t> stays(count);
        for (std::size_t i = 0; i < count; ++i)
            stays[i] = is_beside_other(steps_[begin + i]) ? 0 : 1;
        keep_short_doubles(line, stays);
        // Then what runs beside an earlier part of the line.
        for (std::size_t i = 0; i < count; ++i) {
            if (stays[i] != 0 && is_beside_itself(static_cast<std::uint32_t>(begin + i)))
                stays[i] = 0;
            is_there_[begin + i] = stays[i];
        }
    }

    // Short doubles stay, if not all of the line is one.
    void keep_short_doubles(std::size_t line, std::vector<std::uint8_t>& stays) const {
        const std::size_t begin = begins_[line], count = stays.size();
        const auto stayer = std::ranges::find(stays, 1);
        if (stayer == stays.end()) return;
        const std::size_t start = lines_[line].is_closed ? std::size_t(stayer - stays.begin()) : 0;
        for (std::size_t i = 0; i < count;) {
            double length = 0.0;
            std::size_t end = i;
            for (; end < count && stays[(start + end) % count] == 0; ++end) {
                const Step& step = steps_[begin + (start + end) % count];
                length += glm::distance(step.from, step.to);
            }
            if (length < k_min_double * reach_)
                for (std::size_t k = i; k < end; ++k) stays[(start + k) % count] = 1;
            i = std::max(end, i + 1);
        }
    }

    std::span<const PageLine> lines_;
    bool are_hidden_;
    double reach_, step_ = 0.0;
    std::vector<Step> steps_;
    std::vector<double> arcs_;            // Of the line, up to the end of each step.
    std::vector<std::size_t> begins_{0};  // Of each line in steps_, and their end.
    std::vector<std::uint8_t> is_there_;  // Of each step.
    PictureGrid grid_;
};

void leave_out(std::vector<PageLine>& lines, std::size_t first, bool are_hidden, double reach_mm,
               double min_length_mm) {
    const std::span<PageLine> all = std::span(lines).subspan(first);
    if (std::ranges::find(all, are_hidden, &PageLine::is_hidden) == all.end()) return;
    const PageDoubles doubles(all, are_hidden, reach_mm);
    std::vector<PageLine> left;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (doubles.is_whole(i)) {
            left.push_back(std::move(all[i]));
            continue;
        }
        for (PageLine& part : doubles.rest_of(i))
            if (part.length_mm() >= min_length_mm) left.push_back(std::move(part));
    }
    lines.erase(lines.begin() + std::ptrdiff_t(first), lines.end());
    std::ranges::move(left, std::back_inserter(lines));
}

}  // namespace

void leave_out_hidden_doubles(std::vector<PageLine>& lines, std::size_t first, double reach_mm,
                              double min_length_mm) {
    leave_out(lines, first, true, reach_mm, min_length_mm);
}

void leave_out_visible_doubles(std::vector<PageLine>& lines, std::size_t first, double reach_mm,
                               double min_length_mm) {
    leave_out(lines, first, false, reach_mm, std::max(min_length_mm, k_min_double * reach_mm));
}

}  // namespace rimline::tools
