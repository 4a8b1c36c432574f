#include "tools/view/view_gallery.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <glm/geometric.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/tools/view/opened_model.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("a sphere's small drawing is a circle that fills the square") {
    const auto model = tests::opened_model("shape:sphere:5000");
    const GalleryView view =
        gallery_view(model->lines().surface(), glm::normalize(glm::dvec3(1, 2, 3)), {0, 1, 0});
    double length = 0.0;
    for (const std::vector<glm::vec2>& stroke : view.strokes)
        for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
            CHECK(glm::length(stroke[i]) == doctest::Approx(1.0).epsilon(0.01));
            length += glm::distance(stroke[i], stroke[i + 1]);
        }
    CHECK(length == doctest::Approx(2.0 * 3.14159).epsilon(0.02));
}

TEST_CASE("the views of a model are found beside the window and are apart from each other") {
    const auto model = tests::opened_model("shape:knot:6000");
    std::mutex mutex;
    std::condition_variable changed;
    ViewGallery gallery([&] {
        const std::lock_guard lock(mutex);
        changed.notify_all();
    });
    gallery.find(*model, {0, 1, 0});
    {
        std::unique_lock lock(mutex);
        changed.wait_for(lock, std::chrono::seconds(60), [&] { return !gallery.is_finding(); });
    }
    const auto views = gallery.views();
    REQUIRE(views.size() == ViewGallery::k_views);
    for (std::size_t i = 0; i < views.size(); ++i) {
        CHECK(!views[i]->strokes.empty());
        for (std::size_t j = 0; j < i; ++j)
            CHECK(glm::dot(views[i]->towards_viewer, views[j]->towards_viewer) < 0.95);
    }
    const std::optional<CameraPath> path = gallery.path();
    REQUIRE(path);
    CHECK(path->nodes().size() == 2 * ViewGallery::k_views);
    for (const auto& view : views)
        CHECK(std::ranges::any_of(path->nodes(), [&](const glm::dvec3& node) {
            return glm::dot(glm::normalize(node - model->mesh().center()), view->towards_viewer) >
                   1.0 - 1e-9;
        }));
    gallery.clear();
    CHECK(gallery.views().empty());
    CHECK_FALSE(gallery.path());
}

TEST_CASE("a search for views can be stopped and begun again at any time") {
    const auto model = tests::opened_model("shape:knot:60000");
    const auto other = tests::opened_model("shape:torus:500");
    ViewGallery gallery;
    for (int turn = 0; turn < 4; ++turn) {
        gallery.find(*model, {0, 1, 0});
        std::this_thread::sleep_for(std::chrono::milliseconds(5 * turn));
        gallery.find(*other, {0, 1, 0});
        gallery.clear();
        CHECK_FALSE(gallery.is_finding());
        CHECK(gallery.views().empty());
    }
}
