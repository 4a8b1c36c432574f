// rimline points: borders, features and silhouettes of a point cloud.

#include <CLI/App.hpp>
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
#include "tools/timing.h"

namespace rimline::tools {

namespace {

class PointsCommand final : public Command {
public:
    std::string name() const override { return "points"; }
    std::string summary() const override {
        return "Find borders, features and silhouettes of a point cloud";
    }

    void add_options(CLI::App& app) override {
        app_ = &app;
        cloud_.add_to(app);
        picture_.view.add_to_cloud(app, eye_);
        add_exact_point(app, "--target", target_,
                        "Point that the camera looks at (default: the cloud's center)")
            ->group("Camera");
        picture_.add_lens_to(app);
        add_exact_point(app, "--from", from_, "Viewpoint of the silhouette (default: the eye)")
            ->group("Camera");
        add_direction(app, "--direction", direction_,
                      "Direction of the silhouette, from the cloud towards a viewer infinitely far "
                      "away")
            ->group("Camera");
        add_count(app, "--turn", turn_frames_, 1, 1'000'000,
                  "Move the viewpoint around the cloud for this number of frames, update the "
                  "silhouette and measure the time")
            ->default_str("")
            ->group("Turn");
        add_number(app, "--step", turn_step_deg_, -180.0, 180.0,
                   "Angle of the turn per frame in degrees")
            ->group("Turn");
        app.add_flag("--verify", verify_,
                     "Compare every frame of the turn with a new extraction; exit 3 if one differs")
            ->group("Turn");
        surface_.add_to(app);
        add_output(app, "-o,--output", output_, ".png", "Draw the cloud into this PNG file")
            ->group("Output");
        app.add_option_function<std::string>(
               "--mode", [this](const std::string& text) { set_mode(text); },
               "drawn; features: with lines along creases; compare: six pictures, see below")
            ->type_name("NAME")
            ->default_str("drawn")
            ->group("Output");
        app.add_option_function<std::string>(
               "--look",
               [this](const std::string& text) {
                   look_ = text == "dots" ? CloudLook::dots : CloudLook::discs;
               },
               "discs, or dots with lines (default: dots if there are fewer than 5,000 points)")
            ->check(CLI::IsMember({"discs", "dots"}))
            ->type_name("NAME")
            ->group("Output");
        add_output(app, "--export", export_, ".ply",
                   "Write the points with normals, labels, weights and colors to this PLY file")
            ->group("Output");
        app.add_flag("--no-lists", without_lists_, "Omit the lists of points from the JSON")
            ->group("Output");
        picture_.add_image_to(app);
        picture_.add_machine_to(app);
        app.footer(
            "The umbrella of a point consists of the triangles to its neighbors on the surface. It "
            "gives the\n"
            "point's normal, its label (border, interior or feature), and whether it is on the "
            "silhouette. If\n"
            "this is not certain, the point is undecided; the reasons are counted. Points are "
            "numbered as in the\n"
            "file, from 0. Of equal points only the first is used; of a model, only vertices of "
            "faces. The\n"
            "weight of a point, from 0 to 1, tells how sharply the surface bends there. In the "
            "JSON, "
            "`numbers`\n"
            "are the points of the weights in `features`. A consensus edge is on the silhouette "
            "for "
            "both its\n"
            "ends. With --as-points, missed and extra border points are counted against the "
            "borders "
            "of the model.\n\n"
            "A picture has a disc for each point, or a dot if they are few, darker where the "
            "surface "
            "bends more\n"
            "sharply. Borders are orange, undecided points red, consensus edges ink. --mode "
            "features draws\n"
            "lines along creases instead of dark points. --mode compare shows six pictures row by "
            "row:\n"
            "points that a convex hull classifies as visible (Katz et al.), and the picture as "
            "drawn;\nas many silhouette points by thresholding normals (Zakaria, Seidel), and "
            "ours; discs with\nnormals of principal components, and ours: discs in either look.\n\n"
            "Examples:\n"
            "  rimline points scan.ply --eye 2,1,3 --json\n"
            "  rimline points bunny.obj --as-points --export labels.ply\n"
            "  rimline points horse.ply --as-points --turn 720 --verify\n"
            "  rimline points fandisk.obj --as-points --eye front -o fandisk.png");
    }

    ExitStatus run(const Context& context) override {
        if (from_ && direction_) throw UsageError("--from and --direction: give one of them");
        const PointSurfaceOptions options = surface_.options();
        if (verify_ && turn_frames_ == 0) throw UsageError("--verify: belongs to --turn");
        if (turn_frames_ == 0) refuse_options(*app_, {"--step"}, "belongs to --turn");
        if (turn_frames_ == 0 && output_.empty())
            refuse_options(*app_, {"--up"}, "there is no picture; give -o FILE.png");
        if (without_lists_ && !context.json) throw UsageError("--no-lists: belongs to --json");
        if (output_.empty() && picture_.view.name)
            throw UsageError("--eye: a view is one of a picture; give -o FILE.png, or a point");
        if (output_.empty())
            refuse_options(*app_,
                           {"--azimuth", "--elevation", "--target", "--fov", "--ortho", "--mode",
                            "--look", "Image", "--device", "--validate"},
                           "there is no picture; give -o FILE.png");
        if (!export_.empty() && (export_ == output_ || is_same_file(export_, output_)))
            throw UsageError("--export: " + export_ + " is what -o writes; name another file");
        check_output(context, output_);
        check_output(context, export_);
        std::optional<OutputFile> file;
        if (!export_.empty()) file.emplace(export_, cloud_.model);
        std::optional<OutputFile> drawing;
        if (!output_.empty()) drawing.emplace(output_, cloud_.model);
        const CloudAnalysis analysis = analyze(context, options, drawing);
        if (file) {
            file->write(format_labels(
                {analysis.cloud, analysis.surface, analysis.weights, analysis.silhouette}));
            file->commit();
            context.times.end("writing");
        }
        const PointsReport report{analysis, cloud_.model, export_, output_, without_lists_};
        if (context.json)
            print_object(context, report);
        else
            print_summary(report);
        const std::uint32_t differences = analysis.turn ? analysis.turn->differences : 0;
        return report_check(differences == 0
                                ? ""
                                : cloud_.model + ": " + std::to_string(differences) +
                                      " of its frames differ from finding them afresh");
    }

private:
    void set_mode(const std::string& text) {
        if (text != "drawn" && text != "features" && text != "compare")
            throw CLI::ValidationError("--mode",
                                       "expected drawn, features or compare, not '" + text + "'");
        mode_ = text == "compare"    ? PointsMode::compare
                : text == "features" ? PointsMode::features
                                     : PointsMode::drawn;
    }

    bool has_silhouette() const { return eye_ || from_ || direction_ || !output_.empty(); }
    bool needs_index() const { return has_silhouette() || turn_frames_ > 0; }

    CloudAnalysis analyze(const Context& context, const PointSurfaceOptions& options,
                          std::optional<OutputFile>& drawing) {
        PointCloud cloud = cloud_.load(context);
        const auto name_errors = [&](auto&& work) { return about_model(cloud_.model, work); };
        Stopwatch watch;
        Progress surface_progress(context, "finding umbrellas of " + cloud_.model);
        PointSurface surface = name_errors(
            [&] { return PointSurface(cloud.positions(), options, surface_progress.call()); });
        CloudAnalysis analysis(std::move(cloud), std::move(surface));
        analysis.umbrellas_ms = watch.ms();
        if (options.method == PointSurfaceOptions::Method::thesis)
            analysis.method = "thesis";
        else
            analysis.hole_limit = hole_limit(analysis.surface, options.gap_ratio);
        context.times.end("umbrellas");
        watch = Stopwatch();
        Progress feature_progress(context, "weighing features of " + cloud_.model);
        analysis.weights = feature_weights(analysis.surface, feature_progress.call());
        analysis.features_ms = watch.ms();
        context.times.end("features");
        if (!output_.empty() || turn_frames_ > 0) {
            analysis.up = settle_up(analysis.cloud, context);
            context.times.end("up direction");
        }
        if (needs_index()) name_errors([&] { analyze_silhouette(context, analysis, drawing); });
        if (!analysis.cloud.triangles().empty()) analysis.truth = compare_borders(analysis);
        context.checkpoint();
        return analysis;
    }

    // Only faces say along which axis a model stands.
    ChosenUp settle_up(const PointCloud& cloud, const Context& context) {
        if (picture_.up) return {glm::dvec3(*picture_.up), ChosenUp::Source::option};
        ChosenUp chosen{direction_of(cloud.up()),
                        cloud.is_up_known() ? ChosenUp::Source::format : ChosenUp::Source::assumed};
        if (!cloud.triangles().empty() && (picture_.is_up_auto || !cloud.is_up_known())) {
            MeshSource source{.positions = {}, .triangles = {}};
            source.positions.assign(cloud.positions().begin(), cloud.positions().end());
            source.triangles.assign(cloud.triangles().begin(), cloud.triangles().end());
            Progress progress(context, "joining the faces of " + cloud_.model);
            chosen = choose_up(Mesh(source, Welding::none, progress.call()), {}, true);
        }
        picture_.up = glm::vec3(chosen.up);
        return chosen;
    }

    void analyze_silhouette(const Context& context, CloudAnalysis& analysis,
                            std::optional<OutputFile>& drawing) const {
        Stopwatch watch;
        Progress progress(context, "indexing umbrellas of " + cloud_.model);
        const UmbrellaIndex umbrellas(analysis.surface, progress.call());
        analysis.index_ms = watch.ms();
        context.times.end("index");
        warn_of_far_points(analysis.surface, umbrellas);
        std::optional<HomogeneousPoint> point;
        if (direction_) point = umbrellas.direction(glm::dvec3(*direction_));
        if (from_) point = umbrellas.viewpoint(*from_);
        if (drawing) {
            warn_of_small_picture(analysis.surface);
            context.checkpoint();
            const Progress drawing_progress(context, "drawing the picture");
            analysis.picture =
                draw_points({.name = cloud_.model,
                             .cloud = analysis.cloud,
                             .surface = analysis.surface,
                             .umbrellas = umbrellas,
                             .weights = analysis.weights,
                             .k = surface_.options().k,
                             .mode = mode_,
                             .look = look_.value_or(usual_look(analysis.surface.size())),
                             .eye = eye_,
                             .target = target_,
                             .silhouette_point = point,
                             .options = picture_},
                            *drawing);
            point = analysis.picture->silhouette_point;
            context.times.end("drawing");
        }
        if (turn_frames_ > 0) {
            analysis.turn = turn(context, analysis, umbrellas);
            context.times.end("turning");
        }
        analysis.is_verified = verify_;
        analysis.has_silhouette = has_silhouette();
        if (!has_silhouette()) return;
        if (!point) point = umbrellas.viewpoint(*eye_);
        watch = Stopwatch();
        const PointSilhouette silhouette(umbrellas, *point);
        analysis.silhouette = silhouette.points();
        analysis.consensus = silhouette.consensus_edges();
        analysis.arcs = chain(analysis.consensus).size();
        analysis.silhouette_ms = watch.ms();
        context.times.end("silhouette");
    }

    // Roundings turn the planes of umbrellas that are small against the whole cloud.
    void warn_of_far_points(const PointSurface& surface, const UmbrellaIndex& umbrellas) const {
        constexpr double k_least_steps = 16.0;
        const double spacing = median_scale(surface).value_or(INFINITY);
        if (spacing >= k_least_steps * umbrellas.resolution()) return;
        char text[160];
        std::snprintf(text, sizeof text,
                      ": its points are %.3g apart, but it is so large that silhouettes round "
                      "positions to %.3g: leave out what lies far away",
                      spacing, umbrellas.resolution());
        print_warning(cloud_.model + text + drop_hint());
    }

    void warn_of_small_picture(const PointSurface& surface) const {
        const std::size_t far = count_far_points(surface);
        if (far == 0) return;
        print_warning(cloud_.model + ": " + std::to_string(far) + " of its " +
                      std::to_string(surface.size()) +
                      " points lie so far from the others that these are small in the picture" +
                      drop_hint());
    }

    std::string drop_hint() const {
        return surface_.options().drops_outliers
                   ? ""
                   : "; --drop-outliers leaves out points that lie on no surface";
    }

    PointTurn turn(const Context& context, const CloudAnalysis& analysis,
                   const UmbrellaIndex& umbrellas) const {
        return measure_turn(umbrellas, analysis.up->up, turn_frames_, turn_step_deg_, verify_,
                            context);
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
    std::optional<CloudLook> look_;
    std::string output_;
    std::string export_;
    bool without_lists_ = false;
    const CLI::App* app_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_points_command() { return std::make_unique<PointsCommand>(); }

}  // namespace rimline::tools
