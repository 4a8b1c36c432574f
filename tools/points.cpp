// rimline points: borders, features and silhouettes of a point cloud.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/points/feature_weights.h"
#include "silhouette/points/point_cloud.h"
#include "silhouette/points/point_silhouette.h"
#include "silhouette/points/point_surface.h"
#include "silhouette/points/umbrella_index.h"
#include "tools/cloud_argument.h"
#include "tools/command.h"
#include "tools/label_output.h"
#include "tools/model_argument.h"
#include "tools/option_types.h"
#include "tools/output_file.h"
#include "tools/picture_options.h"
#include "tools/point_turn.h"
#include "tools/points_picture.h"
#include "tools/progress.h"
#include "tools/surface_options.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// What a mesh says of its own vertices, beside what was found without its faces.
struct BorderTruth {
    std::size_t border = 0, missed = 0, extra = 0;

    // Of the true border points, in percent; nothing where there are none.
    std::optional<double> percent(std::size_t count) const {
        if (border == 0) return std::nullopt;
        return 100.0 * static_cast<double>(count) / static_cast<double>(border);
    }
};

struct Found {
    explicit Found(PointCloud points, PointSurface umbrellas)
        : cloud(std::move(points)), surface(std::move(umbrellas)) {}

    PointCloud cloud;
    PointSurface surface;
    std::vector<float> weights;
    std::vector<PointId> silhouette;
    std::vector<PointEdge> consensus;
    std::size_t arcs = 0;
    std::optional<BorderTruth> truth;
    std::optional<PointsPictureReport> picture;
    std::optional<PointTurn> turn;
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
    // Of each reason that occurs, how many points are undecided by it.
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

BorderTruth compare_borders(const Found& found) {
    const std::vector<std::uint32_t> border = found.cloud.mesh_border_points();
    BorderTruth truth{border.size(), 0, 0};
    for (const std::uint32_t p : border)
        truth.missed += found.surface.label(PointId{p}) != PointLabel::border;
    truth.extra = found.surface.count(PointLabel::border) + truth.missed - truth.border;
    return truth;
}

class PointsCommand final : public Command {
public:
    std::string name() const override { return "points"; }
    std::string summary() const override {
        return "Find borders, features and silhouettes of a point cloud";
    }

    void add_options(CLI::App& app) override {
        cloud_.add_to(app);
        add_exact_point(app, "--eye", eye_, "Where the viewer stands (default: chosen, with -o)")
            ->group("Camera");
        add_exact_point(app, "--target", target_, "Where it looks (default: the cloud's center)")
            ->group("Camera");
        picture_.add_lens_to(app);
        add_exact_point(app, "--from", from_, "Find the silhouette from this point, not the eye")
            ->group("Camera");
        add_direction(app, "--direction", direction_,
                      "Find it from infinitely far this way, from the cloud towards the viewer")
            ->group("Camera");
        add_count(app, "--turn", turn_frames_, 1, 1'000'000,
                  "Follow the silhouette for so many frames around the cloud, and time that")
            ->default_str("")
            ->group("Turn");
        add_number(app, "--step", turn_step_deg_, -180.0, 180.0, "Degrees a frame")->group("Turn");
        app.add_flag("--verify", verify_,
                     "Compare every frame with finding it afresh; exit 3 if one differs")
            ->group("Turn");
        surface_.add_to(app);
        app.add_option("-o,--output", output_, "Draw the cloud, as a PNG")
            ->type_name("FILE.png")
            ->group("Output");
        app.add_option_function<std::string>(
               "--mode", [this](const std::string& text) { set_mode(text); },
               "drawn, or compare: beside hidden points, normal thresholding and PCA's normals")
            ->type_name("NAME")
            ->default_str("drawn")
            ->group("Output");
        app.add_option("--export", export_,
                       "Write the points with normals, labels, weights and colours")
            ->type_name("FILE.ply")
            ->group("Output");
        app.add_flag("--no-lists", without_lists_, "Leave lists of points out of the JSON")
            ->group("Output");
        picture_.add_image_to(app);
        picture_.add_machine_to(app);
        app.footer(
            "Each point's umbrella, the triangles to its neighbours on the surface, says whether "
            "it "
            "is a\n"
            "border, interior or feature point, its normal, and whether it is on the silhouette. "
            "Where that\n"
            "cannot be told a point is undecided, and why is counted. Points are numbered as the "
            "file numbers\n"
            "them, from 0; of equal ones the first stands for all, and of a model only vertices of "
            "faces are\n"
            "points. A weight from 0 to 1 says how sharply the surface turns at a point; `numbers` "
            "in the JSON\n"
            "are the points that `features` weighs. Consensus edges are on the silhouette for both "
            "their ends.\n"
            "With --as-points, missed and extra border points are counted against the model's own "
            "borders.\n\n"
            "A picture has a disc for each point, darker the sharper the surface turns, borders in "
            "orange, points\n"
            "that are undecided in red, and consensus edges as ink. --mode compare, from the upper "
            "left: points that\n"
            "no hull hides (Katz et al.), alone and as drawn; silhouette points by thresholding as "
            "many normals\n"
            "(Zakaria, Seidel), and ours; discs with normals of principal components, and ours.\n\n"
            "Examples:\n"
            "  rimline points scan.ply --eye 2,1,3 --json\n"
            "  rimline points bunny.obj --as-points --export labels.ply\n"
            "  rimline points horse.ply --as-points --turn 720 --verify\n"
            "  rimline points fandisk.obj --as-points --eye 2,1,2 -o fandisk.png");
    }

    ExitStatus run(const Context& context) override {
        if (from_ && direction_) throw UsageError("--from and --direction: give one of them");
        const PointSurfaceOptions options = surface_.options();
        if (verify_ && turn_frames_ == 0) throw UsageError("--verify: belongs to --turn");
        std::optional<OutputFile> file;
        if (!export_.empty()) {
            if (!export_.ends_with(".ply"))
                throw UsageError("--export: expected FILE.ply, not '" + export_ + "'");
            file.emplace(export_);
        }
        std::optional<OutputFile> drawing;
        if (!output_.empty()) drawing.emplace(output_);
        const Found found = find(context, options, drawing);
        if (file) {
            file->write(
                format_labels({found.cloud, found.surface, found.weights, found.silhouette}));
            file->commit();
        }
        if (context.json)
            print_result(found);
        else
            print_summary(found);
        return found.turn && found.turn->differences > 0 ? ExitStatus::check_failed
                                                         : ExitStatus::success;
    }

private:
    void set_mode(const std::string& text) {
        if (text != "drawn" && text != "compare")
            throw CLI::ValidationError("--mode", "expected drawn or compare, not '" + text + "'");
        mode_ = text == "compare" ? PointsMode::compare : PointsMode::drawn;
    }

    bool has_silhouette() const { return eye_ || from_ || direction_ || !output_.empty(); }
    bool needs_index() const { return has_silhouette() || turn_frames_ > 0; }

    Found find(const Context& context, const PointSurfaceOptions& options,
               std::optional<OutputFile>& drawing) const {
        PointCloud cloud = cloud_.load(context);
        const auto named = [&](auto&& work) { return about_model(cloud_.model, work); };
        Clock::time_point start = Clock::now();
        Progress surface_progress(context, "finding umbrellas of " + cloud_.model);
        PointSurface surface = named(
            [&] { return PointSurface(cloud.positions(), options, surface_progress.call()); });
        Found found(std::move(cloud), std::move(surface));
        found.umbrellas_ms = ms_since(start);
        start = Clock::now();
        Progress feature_progress(context, "weighing features of " + cloud_.model);
        found.weights = feature_weights(found.surface, feature_progress.call());
        found.features_ms = ms_since(start);
        if (needs_index()) named([&] { find_silhouette(context, found, drawing); });
        if (!found.cloud.triangles().empty()) found.truth = compare_borders(found);
        context.checkpoint();
        return found;
    }

    void find_silhouette(const Context& context, Found& found,
                         std::optional<OutputFile>& drawing) const {
        Clock::time_point start = Clock::now();
        Progress progress(context, "indexing umbrellas of " + cloud_.model);
        const UmbrellaIndex umbrellas(found.surface, progress.call());
        found.index_ms = ms_since(start);
        std::optional<HomogeneousPoint> point;
        if (direction_) point = umbrellas.direction(glm::dvec3(*direction_));
        if (from_) point = umbrellas.viewpoint(*from_);
        if (drawing) {
            context.checkpoint();
            found.picture = draw_points({.name = cloud_.model,
                                         .cloud = found.cloud,
                                         .surface = found.surface,
                                         .umbrellas = umbrellas,
                                         .weights = found.weights,
                                         .k = surface_.options().k,
                                         .mode = mode_,
                                         .eye = eye_,
                                         .target = target_,
                                         .silhouette_point = point,
                                         .options = picture_},
                                        *drawing);
            point = found.picture->silhouette_point;
        }
        if (turn_frames_ > 0) found.turn = turn(context, found, umbrellas);
        if (!has_silhouette()) return;
        if (!point) point = umbrellas.viewpoint(*eye_);
        start = Clock::now();
        const PointSilhouette silhouette(umbrellas, *point);
        found.silhouette = silhouette.points();
        found.consensus = silhouette.consensus_edges();
        found.arcs = chain(found.consensus).size();
        found.silhouette_ms = ms_since(start);
    }

    PointTurn turn(const Context& context, const Found& found,
                   const UmbrellaIndex& umbrellas) const {
        glm::dvec3 up(0.0, 1.0, 0.0);
        if (found.cloud.up() == UpAxis::z) up = {0.0, 0.0, 1.0};
        if (picture_.up) up = glm::dvec3(*picture_.up);
        return turn_around(umbrellas, up, turn_frames_, turn_step_deg_, verify_, context);
    }

    void print_result(const Found& found) const {
        const PointCloud& cloud = found.cloud;
        const auto count = [&](PointLabel label) { return found.surface.count(label); };
        nlohmann::ordered_json reasons = nlohmann::ordered_json::object();
        for (const auto& [reason, points] : found.reasons()) reasons[reason] = points;
        nlohmann::ordered_json result{
            {"cloud", cloud_.model},
            {"points", cloud.size()},
            {"file_points", cloud.file_point_count()},
            {"duplicates", cloud.duplicate_count()},
            {"dropped", cloud.dropped_count()},
            {"unused", cloud.unused_count()},
            {"center", {cloud.center().x, cloud.center().y, cloud.center().z}},
            {"radius", cloud.radius()},
            {"labels",
             {{"border", count(PointLabel::border)},
              {"interior", count(PointLabel::interior)},
              {"feature", count(PointLabel::feature)},
              {"undecided", count(PointLabel::undecided)}}},
            {"reasons", std::move(reasons)},
            {"silhouette_points", found.silhouette.size()},
            {"consensus_edge_count", found.consensus.size()},
            {"arcs", found.arcs},
            {"ms", found.ms()},
            {"umbrellas_ms", found.umbrellas_ms},
            {"features_ms", found.features_ms},
            {"index_ms", found.index_ms},
            {"silhouette_ms", found.silhouette_ms}};
        if (const std::optional<BorderTruth>& truth = found.truth) {
            const auto percent = [&](std::size_t part) -> nlohmann::ordered_json {
                if (const auto value = truth->percent(part)) return *value;
                return nullptr;
            };
            result["truth"] = {{"border", truth->border},
                               {"missed", truth->missed},
                               {"extra", truth->extra},
                               {"missed_percent", percent(truth->missed)},
                               {"extra_percent", percent(truth->extra)}};
        }
        if (const std::optional<PointTurn>& turn = found.turn) {
            result["turn"] = {
                {"frames", turn->frames},       {"step", turn->step_deg},
                {"median_us", turn->median_us}, {"p99_us", turn->p99_us},
                {"worst_us", turn->worst_us},   {"changed_points", turn->changed_points}};
            if (verify_) result["verified"] = turn->differences == 0;
        }
        if (!export_.empty()) result["export"] = export_;
        if (const std::optional<PointsPictureReport>& picture = found.picture) {
            nlohmann::ordered_json messages = nullptr;
            if (picture->validation_messages) messages = *picture->validation_messages;
            result["output"] = output_;
            result["device"] = picture->device;
            result["driver"] = picture->driver;
            result["validation_messages"] = std::move(messages);
            result["picture_ms"] = picture->ms;
        }
        if (!without_lists_) add_lists(found, result);
        print_json(result);
    }

    static void add_lists(const Found& found, nlohmann::ordered_json& result) {
        result["border"] = found.numbers(PointLabel::border);
        result["undecided"] = found.numbers(PointLabel::undecided);
        nlohmann::ordered_json& silhouette = result["silhouette"] = nlohmann::ordered_json::array();
        for (const PointId p : found.silhouette) silhouette.push_back(found.number(p));
        nlohmann::ordered_json& edges = result["consensus_edges"] = nlohmann::ordered_json::array();
        for (const auto& [a, b] : found.consensus)
            edges.push_back({found.number(a), found.number(b)});
        result["features"] = found.weights;
        result["numbers"] = found.cloud.file_points();
    }

    void print_summary(const Found& found) const {
        const PointCloud& cloud = found.cloud;
        const auto count = [&](PointLabel label) { return found.surface.count(label); };
        std::printf("%s\n", cloud_.model.c_str());
        std::printf("  points      %u of %u in the file", cloud.size(), cloud.file_point_count());
        const auto left_out = [](std::uint32_t points, const char* why) {
            if (points > 0) std::printf(", %u %s", points, why);
        };
        left_out(cloud.duplicate_count(), "equal to another");
        left_out(cloud.dropped_count(), "not finite");
        left_out(cloud.unused_count(), "of no face");
        std::printf("\n  labels      %u border, %u interior, %u feature, %u undecided\n",
                    count(PointLabel::border), count(PointLabel::interior),
                    count(PointLabel::feature), count(PointLabel::undecided));
        for (const auto& [reason, points] : found.reasons())
            std::printf("              %u undecided: %s\n", points, reason);
        if (const std::optional<BorderTruth>& truth = found.truth) {
            std::printf("  borders     %zu true, %zu missed, %zu extra", truth->border,
                        truth->missed, truth->extra);
            if (const auto missed = truth->percent(truth->missed))
                std::printf(" (%.1f%% and %.1f%%)", *missed, *truth->percent(truth->extra));
            std::printf("\n");
        }
        const auto sharp = std::ranges::count_if(found.weights, [](float w) { return w >= 0.5f; });
        std::printf("  features    %td points weigh a half or more\n", sharp);
        if (has_silhouette())
            std::printf("  silhouette  %zu points, %zu consensus edges in %zu arcs\n",
                        found.silhouette.size(), found.consensus.size(), found.arcs);
        std::printf("  time        %.1f ms: umbrellas %.1f, features %.1f", found.ms(),
                    found.umbrellas_ms, found.features_ms);
        if (has_silhouette())
            std::printf(", index %.1f, silhouette %.2f", found.index_ms, found.silhouette_ms);
        std::printf("\n");
        if (const std::optional<PointTurn>& turn = found.turn) {
            std::printf("  turn        %u frames by %g degrees: %.0f us a frame, 99%% below %.0f\n",
                        turn->frames, turn->step_deg, turn->median_us, turn->p99_us);
            if (verify_)
                std::printf("              %u of them differ from finding it afresh\n",
                            turn->differences);
        }
        if (found.picture)
            std::printf("  picture     %.1f ms on %s\n", found.picture->ms,
                        found.picture->device.c_str());
        for (const std::string& written : {export_, output_})
            if (!written.empty()) std::printf("  written to  %s\n", written.c_str());
    }

    CloudArgument cloud_;
    std::optional<glm::dvec3> eye_;
    std::optional<glm::dvec3> target_;
    std::optional<glm::dvec3> from_;
    std::optional<glm::vec3> direction_;
    std::uint32_t turn_frames_ = 0;
    double turn_step_deg_ = 0.5;
    bool verify_ = false;
    SurfaceOptions surface_;
    PictureOptions picture_;
    PointsMode mode_ = PointsMode::drawn;
    std::string output_;
    std::string export_;
    bool without_lists_ = false;
};

}  // namespace

std::unique_ptr<Command> make_points_command() { return std::make_unique<PointsCommand>(); }

}  // namespace rimline::tools
