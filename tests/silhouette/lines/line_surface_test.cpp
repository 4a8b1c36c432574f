#include "silhouette/lines/line_surface.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_geometry.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/against_oracle.h"
#include "tests/silhouette/lines/difficult_meshes.h"

namespace rimline {
namespace {

using Contacts = LineSurface::Contacts;

// Temporaries would dangle.
static_assert(!std::is_constructible_v<LineSurface, Mesh>);
static_assert(!std::is_constructible_v<LineDrawer, LineSurface>);

// The shares that the construction of a surface reports.
std::vector<double> progress_of_surface(const Mesh& mesh, Contacts contacts) {
    std::vector<double> shares;
    const LineSurface surface(mesh, contacts, {{}, [&](double share) { shares.push_back(share); }});
    return shares;
}

std::size_t count_of_points(const Mesh& mesh, const LineSurface& surface) {
    LineDrawer drawer(surface);
    const LineView view = tests::view_of(mesh, {1, 2, 3}, false);
    return drawer.draw(view, brute_force_silhouette(mesh, view.point()), checkable({}))
        .points.size();
}

struct StopOfTest {};

// At each place in turn: by a request to stop, which the next place notices, and by an exception of the callback.
void check_that_all_places_cancel(const Mesh& mesh, Contacts contacts) {
    const std::size_t points = count_of_points(mesh, LineSurface(mesh, contacts));
    const std::size_t places = progress_of_surface(mesh, contacts).size();
    REQUIRE(places > 6);
    for (std::size_t place = 0; place < places; ++place) {
        CAPTURE(place);
        std::stop_source stop;
        std::size_t count = 0;
        const LongCall stopped{stop.get_token(), [&](double) {
                                   if (count++ == place) stop.request_stop();
                               }};
        if (place + 1 < places) {
            CHECK_THROWS_AS(LineSurface(mesh, contacts, stopped), Error);
            CHECK(count == place + 1);
        }
        count = 0;
        const LongCall thrown{{}, [&](double) {
                                  if (count++ == place) throw StopOfTest{};
                              }};
        CHECK_THROWS_AS(LineSurface(mesh, contacts, thrown), StopOfTest);
    }
    CHECK(count_of_points(mesh, LineSurface(mesh, contacts)) == points);
}

TEST_CASE("the preparation of lines can be cancelled at each of its checkpoints") {
    const Mesh knot(make_built_in_shape("knot", 2000));
    check_that_all_places_cancel(knot, Contacts::found);
    check_that_all_places_cancel(knot, Contacts::none);
    const Mesh crossing(tests::crossing_knots(2000));
    REQUIRE(!LineSurface(crossing).geometry().contacts().piercings.empty());
    REQUIRE(!LineSurface(crossing).geometry().curves().segments().empty());
    check_that_all_places_cancel(crossing, Contacts::found);
    // So many faces that the tree has levels of its own.
    check_that_all_places_cancel(Mesh(make_built_in_shape("terrain", 20'000)), Contacts::found);
}

TEST_CASE("the preparation of lines is cancelled before it begins") {
    const Mesh mesh(make_built_in_shape("box", 12));
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(LineSurface(mesh, Contacts::found, {stop.get_token(), {}}), Error);
    CHECK_THROWS_AS(LineSurface(mesh, Contacts::none, {stop.get_token(), {}}), Error);
}

TEST_CASE("the progress of the preparation of lines ascends to one in small steps") {
    const Mesh mesh(make_built_in_shape("knot", 200'000));
    for (const auto& [contacts, step] :
         {std::pair(Contacts::found, 0.2), std::pair(Contacts::none, 0.5)}) {
        const std::vector<double> shares = progress_of_surface(mesh, contacts);
        REQUIRE(!shares.empty());
        CHECK(std::ranges::is_sorted(shares));
        CHECK(shares.front() == 0.0);
        CHECK(shares.back() == 1.0);
        for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
            CAPTURE(shares[i]);
            CHECK(shares[i + 1] - shares[i] < step);
        }
    }
}

}  // namespace
}  // namespace rimline
