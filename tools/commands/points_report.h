#pragma once

// The results of `rimline points`, and their output as a summary or as JSON.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/points/point_cloud.h"
#include "silhouette/points/point_silhouette.h"
#include "silhouette/points/point_surface.h"
#include "tools/commands/point_turn.h"
#include "tools/options/up_option.h"
#include "tools/output/points_picture.h"

namespace rimline::tools {

/// The border vertices of a mesh, compared with the border points found without its faces.
struct BorderTruth {
    std::size_t border = 0, missed = 0, extra = 0;

    /// `count` in percent of the true border points. Nothing if there are none.
    std::optional<double> percent(std::size_t count) const {
        if (border == 0) return std::nullopt;
        return 100.0 * static_cast<double>(count) / static_cast<double>(border);
    }
};

/// The median of the scales of points that have one: about their distance from each other.
std::optional<double> median_scale(const PointSurface& surface);

/// How many points lie more than three times as far from the middle of the cloud as 99% of all. Outliers that were
/// left out do not count.
std::size_t count_far_points(const PointSurface& surface);

/// Radii of round holes, in the cloud's units.
struct HoleLimit {
    double median;   ///< Smaller ones are not found, in the median over the points.
    double largest;  ///< The same where the points are sparsest.
    double found;  ///< Larger ones are nearly all found: docs/results/points.md, "Narrow openings".
};
/// gap_ratio times the points' scales (PointSurface::scale()), and four times the median of these.
std::optional<HoleLimit> hole_limit(const PointSurface& surface, double gap_ratio);

struct CloudAnalysis {
    explicit CloudAnalysis(PointCloud points, PointSurface umbrellas)
        : cloud(std::move(points)), surface(std::move(umbrellas)) {}

    PointCloud cloud;
    PointSurface surface;
    std::vector<float> weights;
    std::vector<PointId> silhouette;
    std::vector<PointEdge> consensus;
    std::size_t arcs = 0;
    const char* method = "robust";  ///< Of finding umbrellas.
    std::optional<BorderTruth> truth;
    std::optional<PointsPictureReport> picture;
    std::optional<PointTurn> turn;
    /// Not set: the method has no such limit, or no point has an umbrella.
    std::optional<HoleLimit> hole_limit;
    std::optional<ChosenUp> up;   ///< Of the picture and the turn.
    bool has_silhouette = false;  ///< The silhouette of one viewpoint was requested.
    bool is_verified = false;     ///< Every frame of the turn was compared.
    double umbrellas_ms = 0.0;
    double features_ms = 0.0;
    double index_ms = 0.0;
    double silhouette_ms = 0.0;

    double ms() const { return umbrellas_ms + features_ms + index_ms + silhouette_ms; }
    std::uint32_t number(PointId point) const { return cloud.file_point(index(point)); }
    std::vector<std::uint32_t> numbers(PointLabel label) const {
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t p = 0; p < surface.size(); ++p)
            if (surface.label(PointId{p}) == label) numbers.push_back(cloud.file_point(p));
        return numbers;
    }
    /// Each reason that occurs, with its number of undecided points.
    std::vector<std::pair<const char*, std::uint32_t>> reasons() const {
        std::vector<std::pair<const char*, std::uint32_t>> counted;
        std::array<std::uint32_t, 256> counts{};
        for (std::uint32_t p = 0; p < surface.size(); ++p)
            ++counts[static_cast<std::size_t>(surface.reason(PointId{p}))];
        for (std::size_t reason = 1; reason < counts.size(); ++reason)
            if (counts[reason] > 0)
                counted.emplace_back(describe(static_cast<UndecidedReason>(reason)),
                                     counts[reason]);
        return counted;
    }
};

/// Compares the labels with the borders of the cloud's own faces.
BorderTruth compare_borders(const CloudAnalysis& analysis);

struct PointsReport {
    const CloudAnalysis& analysis;
    const std::string& cloud;               ///< The cloud's name.
    std::string export_file, picture_file;  ///< Empty if not written.
    bool without_lists = false;
};
void print_object(const Context& context, const PointsReport& report);
void print_summary(const PointsReport& report);

}  // namespace rimline::tools
