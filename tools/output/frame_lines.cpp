#include "tools/output/frame_lines.h"

#include "tools/timing.h"

namespace rimline::tools {

FrameLines::FrameLines(const HoughOctree& octree, const SceneOptions& style, ImageSize size,
                       const Context& context)
    : octree_(octree), style_(style), size_(size), lines_(prepare_lines(octree, context)) {}

void FrameLines::add_to(Scene& scene, const LongCall& call) {
    const PictureLines* lines =
        lines_.draw(scene.camera, size_, style_.line_style(scene.palette), call);
    scene.instances.front().picture_lines = lines;
    changes_ = {};
    if (lines != nullptr) follow(lines_.point());
}

void FrameLines::follow(const HomogeneousPoint& point) {
    const Stopwatch watch;
    if (tracker_) {
        const ChangeSet& moved = tracker_->move_to(point);
        changes_.flips = moved.flipped.size();
        changes_.added = moved.added.size();
        changes_.removed = moved.removed.size();
        changes_.counters = moved.counters;
    } else {
        tracker_.emplace(octree_, point);
        changes_.counters = tracker_->construction_counters();
    }
    changes_.edges = tracker_->silhouette().size();
    changes_.update_us = watch.us();
}

}  // namespace rimline::tools
