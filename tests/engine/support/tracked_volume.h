#pragma once

// A shadow volume as it is counted, of a model and a light.

#include "engine/frame/counted_volume.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline::tests {

class TrackedVolume {
public:
    TrackedVolume(const Model& model, const HomogeneousPoint& light)
        : caster_(model.mesh), tracker_(model.octree, light) {}

    const Mesh& mesh() const { return tracker_.mesh(); }
    const HomogeneousPoint& light() const { return tracker_.point(); }
    CountedVolume counted(ShadowForm form) const {
        return {.caster = &caster_,
                .silhouette = tracker_.silhouette(),
                .face_words = tracker_.face_words(),
                .light = tracker_.point(),
                .form = form};
    }

private:
    mutable CasterMesh caster_;
    SilhouetteTracker tracker_;
};

}  // namespace rimline::tests
