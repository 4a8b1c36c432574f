// rimline track: moves a silhouette point along a path and reports the changes of every frame.

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"
#include "tools/commands/frame_check.h"
#include "tools/commands/stream_bytes.h"
#include "tools/options/model_argument.h"
#include "tools/options/model_octree.h"
#include "tools/options/option_types.h"
#include "tools/options/path_options.h"
#include "tools/options/up_option.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

constexpr double k_orbit_radius = 2.0;  // In the model's radii. The help shows this value.

struct Frame {
    std::uint64_t flips = 0, added = 0, removed = 0, silhouette = 0;
    TraversalCounters counters;
    StreamBytes bytes;
    double us = 0.0;

    Frame& operator+=(const Frame& other) noexcept {
        flips += other.flips;
        added += other.added;
        removed += other.removed;
        silhouette += other.silhouette;
        counters += other.counters;
        bytes += other.bytes;
        us += other.us;
        return *this;
    }
};

Frame frame_of(const ChangeSet& change, std::size_t face_words, double us) {
    return {.flips = change.flipped.size(),
            .added = change.added.size(),
            .removed = change.removed.size(),
            .silhouette = change.silhouette_size,
            .counters = change.counters,
            .bytes = stream_bytes(change, face_words),
            .us = us};
}

nlohmann::ordered_json to_json(const Frame& frame) {
    return {{"flips", frame.flips},
            {"added", frame.added},
            {"removed", frame.removed},
            {"silhouette", frame.silhouette},
            {"box_checks", frame.counters.box_checks},
            {"face_checks", frame.counters.face_checks},
            {"edge_checks", frame.counters.edge_checks},
            {"bytes_streamed", frame.bytes.streamed},
            {"bytes_full", frame.bytes.full},
            {"us", frame.us}};
}

struct Track {
    double build_ms = 0.0;       // Of the octree.
    double extraction_us = 0.0;  // Of the tracker at the first point.
    std::vector<Frame> frames;
    Frame totals;
    double max_us = 0.0;
    std::string difference;  // The first that --verify found, with its frame. Empty if none.
};

Track follow(const std::string& model, const Mesh& mesh, const std::vector<glm::vec3>& origins,
             const std::vector<HomogeneousPoint>& points, bool verify, const Context& context) {
    Track track;
    Stopwatch watch;
    const HoughOctree octree =
        build_octree(model, mesh, context, {{origins.begin(), origins.end()}});
    track.build_ms = watch.ms();
    watch = Stopwatch();
    SilhouetteTracker tracker(octree, points.front());
    track.extraction_us = watch.us();

    std::optional<FrameCheck> check;
    if (verify) check.emplace(tracker);
    track.frames.reserve(points.size());
    Progress progress(context, "tracking");
    const LongCall call = progress.call();
    for (std::size_t i = 0; i < points.size(); ++i) {
        call.checkpoint(static_cast<double>(i) / static_cast<double>(points.size()));
        watch = Stopwatch();
        const ChangeSet& change = tracker.move_to(points[i]);
        const Frame frame = frame_of(change, tracker.face_words().size(), watch.us());
        track.frames.push_back(frame);
        track.totals += frame;
        track.max_us = std::max(track.max_us, frame.us);
        if (!check) continue;
        if (const std::optional<std::string> difference = check->difference(change)) {
            track.difference = "frame " + std::to_string(i) + ": " + *difference;
            break;
        }
    }
    return track;
}

class TrackCommand final : public Command {
public:
    std::string name() const override { return "track"; }
    std::string summary() const override {
        return "Update the silhouette of a moving point, frame by frame";
    }

    void add_options(CLI::App& app) override {
        model_.add_to(app);
        path_.add_to(app, "2", PathOptions::Random::offered);
        up_option_ =
            add_up(app, up_, is_up_auto_,
                   "Axis of the orbit: X,Y,Z, one of x, y, z, -x, -y, -z, or auto: along which the "
                   "model stands (default: as the file format says, else auto)")
                ->group("Path");
        add_points(app, "--origin", origins_,
                   "Origin of Hough space; repeatable (default: the model's center)")
            ->group("Method");
        app.add_flag("--verify", verify_,
                     "Compare every frame with brute force; exit 3 if one differs")
            ->group("Check");
        app.footer(
            "The silhouette is first extracted at the first point of the path. Frame 0 is at the "
            "same point, so\n"
            "it has no changes. `us` is the time of the update only, in microseconds. `verified` "
            "is "
            "true if\n"
            "--verify is given and no frame differs.\n\n"
            "Examples:\n"
            "  rimline track igea.ply --step 0.5 --frames 720 --verify --json\n"
            "  rimline track shape:knot:20000 --path random --seed 7 --frames 1000 --verify");
    }

    ExitStatus run(const Context& context) override {
        path_.require_path(up_option_, "orbit");
        path_.read(context);  // Reports a bad file before a long load.
        const Mesh mesh = model_.load_mesh(context);
        settle_up(mesh, up_, is_up_auto_, context.stop);
        const std::vector<HomogeneousPoint> points = path_.points(mesh, *up_, k_orbit_radius);

        const Track track = about_model(model_.model, [&] {
            return follow(model_.model, mesh, origins_, points, verify_, context);
        });
        context.times.end("tracking");
        if (context.json)
            print_result(context, track);
        else
            print_summary(track);
        return report_check(track.difference.empty() ? "" : model_.model + ": " + track.difference);
    }

private:
    bool verified(const Track& track) const { return verify_ && track.difference.empty(); }

    void print_result(const Context& context, const Track& track) const {
        nlohmann::ordered_json totals = to_json(track.totals);
        totals["max_us"] = track.max_us;
        const JsonList frames{"frames", track.frames.size(),
                              [&](std::size_t i) { return to_json(track.frames[i]); }};
        print_json(context,
                   {{"model", model_.model},
                    {"path", path_.path},
                    {"build_ms", track.build_ms},
                    {"extraction_us", track.extraction_us},
                    {frames.key, nullptr},
                    {"totals", std::move(totals)},
                    {"verified", verified(track)}},
                   frames);
    }

    void print_summary(const Track& track) const {
        const double n = static_cast<double>(track.frames.size());
        const auto mean = [n](std::uint64_t sum) { return static_cast<double>(sum) / n; };
        const Frame& sum = track.totals;
        std::printf("%zu frame%s%s\n", track.frames.size(), track.frames.size() == 1 ? "" : "s",
                    verified(track) ? ", every one equal to brute force" : "");
        std::printf("  a frame     %.1f faces turn, %.1f edges join, %.1f leave, of %.1f\n",
                    mean(sum.flips), mean(sum.added), mean(sum.removed), mean(sum.silhouette));
        std::printf("  work        %.1f box, %.1f face and %.1f edge checks\n",
                    mean(sum.counters.box_checks), mean(sum.counters.face_checks),
                    mean(sum.counters.edge_checks));
        std::printf("  to send     %.1f bytes, of %.1f for all\n", mean(sum.bytes.streamed),
                    mean(sum.bytes.full));
        std::printf("  time        %.2f us, at most %.2f us\n", sum.us / n, track.max_us);
        std::printf("  before it   octree %.1f ms, first silhouette %.1f us\n", track.build_ms,
                    track.extraction_us);
    }

    ModelArgument model_;
    PathOptions path_;
    CLI::Option* up_option_ = nullptr;
    std::optional<glm::vec3> up_;
    bool is_up_auto_ = false;
    bool verify_ = false;
    std::vector<glm::vec3> origins_;
};

}  // namespace

std::unique_ptr<Command> make_track_command() { return std::make_unique<TrackCommand>(); }

}  // namespace rimline::tools
