// rimline points: borders, features and silhouettes of a point cloud.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/points/feature_weights.h"
#include "silhouette/points/point_silhouette.h"
#include "silhouette/points/point_surface.h"
#include "silhouette/points/umbrella_index.h"
#include "tools/command.h"
#include "tools/commands/point_turn.h"
#include "tools/commands/points_report.h"
#include "tools/options/cloud_argument.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/options/picture_options.h"
#include "tools/options/surface_options.h"
#include "tools/output/label_output.h"
#include "tools/output/output_file.h"
#include "tools/output/points_picture.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
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
        add_output(app, "-o,--output", output_, ".png", "Draw the cloud, as a PNG")
            ->group("Output");
        app.add_option_function<std::string>(
               "--mode", [this](const std::string& text) { set_mode(text); },
               "drawn, or compare: beside hidden points, normal thresholding and PCA's normals")
            ->type_name("NAME")
            ->default_str("drawn")
            ->group("Output");
        add_output(app, "--export", export_, ".ply",
                   "Write the points with normals, labels, weights and colors")
            ->group("Output");
        app.add_flag("--no-lists", without_lists_, "Leave lists of points out of the JSON")
            ->group("Output");
        picture_.add_image_to(app);
        picture_.add_machine_to(app);
        app.footer(
            "Each point's umbrella, the triangles to its neighbors on the surface, says whether "
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
        if (!export_.empty() && (export_ == output_ || is_same_file(export_, output_)))
            throw UsageError("--export: " + export_ + " is what -o writes; name another file");
        std::optional<OutputFile> file;
        if (!export_.empty()) file.emplace(export_, cloud_.model);
        std::optional<OutputFile> drawing;
        if (!output_.empty()) drawing.emplace(output_, cloud_.model);
        const FoundPoints found = find(context, options, drawing);
        if (file) {
            file->write(
                format_labels({found.cloud, found.surface, found.weights, found.silhouette}));
            file->commit();
        }
        const PointsReport report{found, cloud_.model, export_, output_, without_lists_};
        if (context.json)
            print_object(report);
        else
            print_summary(report);
        const std::uint32_t differences = found.turn ? found.turn->differences : 0;
        return report_check(differences == 0
                                ? ""
                                : cloud_.model + ": " + std::to_string(differences) +
                                      " of its frames differ from finding them afresh");
    }

private:
    void set_mode(const std::string& text) {
        if (text != "drawn" && text != "compare")
            throw CLI::ValidationError("--mode", "expected drawn or compare, not '" + text + "'");
        mode_ = text == "compare" ? PointsMode::compare : PointsMode::drawn;
    }

    bool has_silhouette() const { return eye_ || from_ || direction_ || !output_.empty(); }
    bool needs_index() const { return has_silhouette() || turn_frames_ > 0; }

    FoundPoints find(const Context& context, const PointSurfaceOptions& options,
                     std::optional<OutputFile>& drawing) const {
        PointCloud cloud = cloud_.load(context);
        const auto named = [&](auto&& work) { return about_model(cloud_.model, work); };
        Clock::time_point start = Clock::now();
        Progress surface_progress(context, "finding umbrellas of " + cloud_.model);
        PointSurface surface = named(
            [&] { return PointSurface(cloud.positions(), options, surface_progress.call()); });
        FoundPoints found(std::move(cloud), std::move(surface));
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

    void find_silhouette(const Context& context, FoundPoints& found,
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
        found.is_verified = verify_;
        found.has_silhouette = has_silhouette();
        if (!has_silhouette()) return;
        if (!point) point = umbrellas.viewpoint(*eye_);
        start = Clock::now();
        const PointSilhouette silhouette(umbrellas, *point);
        found.silhouette = silhouette.points();
        found.consensus = silhouette.consensus_edges();
        found.arcs = chain(found.consensus).size();
        found.silhouette_ms = ms_since(start);
    }

    PointTurn turn(const Context& context, const FoundPoints& found,
                   const UmbrellaIndex& umbrellas) const {
        const glm::dvec3 up =
            picture_.up ? glm::dvec3(*picture_.up) : direction_of(found.cloud.up());
        return turn_around(umbrellas, up, turn_frames_, turn_step_deg_, verify_, context);
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
