// Best views weighted by ratios that a device draws.

#include "engine/measure/visible_ratio.h"
#include "silhouette/field/best_views.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline {
namespace {

TEST_CASE("views of which few candidates are drawn are those of drawing all") {
    RIMLINE_OPEN_GPU(gpu);
    bool are_few = false;
    for (const char* shape : {"knot", "torus", "sphere", "box"}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, 2000));
        const HoughOctree octree(mesh);
        VisibleRatioPass pass(gpu->context(), octree);
        std::uint64_t drawn = 0;
        BestViewsOptions options{.count = 1};
        options.visible_ratios = [&](std::span<const glm::dvec3> eyes) {
            drawn += eyes.size();
            std::vector<double> ratios;
            for (const VisibleRatio& ratio : pass.measure(eyes)) ratios.push_back(ratio.ratio());
            return ratios;
        };
        const TangentialField field = make_view_field(mesh);
        const BestViews few = find_best_views(field, options);
        CHECK(few.renders == drawn);
        options.draws_all = true;
        const BestViews all = find_best_views(field, options);
        CHECK(all.renders + few.renders == drawn);
        CHECK(few.renders <= all.renders);
        are_few = are_few || few.renders < all.renders;
        REQUIRE(few.views.size() == all.views.size());
        for (std::size_t i = 0; i < few.views.size(); ++i) {
            CHECK(few.views[i].eye == all.views[i].eye);
            CHECK(few.views[i].visible_ratio == all.views[i].visible_ratio);
            CHECK(few.views[i].visible_ratio > 0.0);
        }
    }
    CHECK(are_few);
}

}  // namespace
}  // namespace rimline
