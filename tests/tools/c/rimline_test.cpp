#include "tools/c/rimline.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/skip.h"

namespace {

using rimline::EdgeId;
using rimline::HomogeneousPoint;

constexpr rimline_point k_eye{2.0, 1.0, 5.0, 0};

// The status of a call, whose error must have a message.
template <typename Call>
rimline_status failing(Call call) {
    rimline_error* error = nullptr;
    const rimline_status status = call(&error);
    CHECK(status != RIMLINE_OK);
    CHECK(status == rimline_error_status(error));
    CHECK(std::strlen(rimline_error_message(error)) > 0);
    CHECK(std::strstr(rimline_error_message(error), "--") == nullptr);  // Names have no dashes.
    rimline_error_free(error);
    CHECK(call(nullptr) == status);  // Without an error too.
    return status;
}

rimline_mesh* load(const char* name) {
    rimline_mesh* mesh = nullptr;
    REQUIRE(rimline_mesh_load(name, nullptr, &mesh, nullptr) == RIMLINE_OK);
    return mesh;
}

TEST_CASE("the tracker of the C library follows brute force") {
    const rimline::Mesh reference(rimline::make_built_in_shape("knot", 3000));
    rimline_mesh* mesh = load("shape:knot:3000");
    rimline_mesh_info info{.struct_size = sizeof info};
    REQUIRE(rimline_mesh_get_info(mesh, &info, nullptr) == RIMLINE_OK);
    CHECK(info.faces == reference.face_count());
    CHECK(info.edges == reference.edge_count());
    CHECK(info.radius == reference.radius());
    rimline_tracker* tracker = nullptr;
    REQUIRE(rimline_tracker_create(mesh, &k_eye, nullptr, &tracker, nullptr) == RIMLINE_OK);
    rimline_mesh_free(mesh);  // The tracker keeps what it needs.

    std::vector<std::uint32_t> slots(reference.edge_count());
    const std::uint32_t* edges = nullptr;
    std::size_t count = 0;
    REQUIRE(rimline_tracker_silhouette(tracker, &edges, &count, nullptr) == RIMLINE_OK);
    std::copy_n(edges, count, slots.begin());
    for (int step = 1; step <= 40; ++step) {
        const rimline_point eye{5.0 * std::sin(0.1 * step), 1.0, 5.0 * std::cos(0.1 * step),
                                step % 7 == 0};
        rimline_changes changes{.struct_size = sizeof changes};
        REQUIRE(rimline_tracker_move(tracker, &eye, &changes, nullptr) == RIMLINE_OK);
        CHECK(changes.sequence == std::uint64_t(step));
        for (std::size_t i = 0; i < changes.slot_count; ++i)
            slots[changes.slots[2 * i]] = changes.slots[2 * i + 1];
        std::vector<std::uint32_t> now(slots.begin(), slots.begin() + changes.silhouette_count);
        std::ranges::sort(now);
        const glm::vec3 place(eye.x, eye.y, eye.z);
        const auto expected = rimline::brute_force_silhouette(
            reference, eye.is_direction ? HomogeneousPoint::direction(place)
                                        : HomogeneousPoint::viewpoint(place));
        REQUIRE(now.size() == expected.size());
        CHECK(std::memcmp(now.data(), expected.data(), 4 * now.size()) == 0);
        const auto bits = rimline::brute_force_face_bits(
            reference, eye.is_direction ? HomogeneousPoint::direction(place)
                                        : HomogeneousPoint::viewpoint(place));
        const std::uint32_t* words = nullptr;
        REQUIRE(rimline_tracker_face_words(tracker, &words, &count, nullptr) == RIMLINE_OK);
        REQUIRE(count == bits.size());
        CHECK(std::memcmp(words, bits.data(), 4 * count) == 0);
    }
    rimline_tracker_free(tracker);
}

TEST_CASE("arrays become a mesh, and wrong ones an error that names the place") {
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::uint32_t corners[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    rimline_mesh* mesh = nullptr;
    REQUIRE(rimline_mesh_create(positions, 4, corners, 4, nullptr, &mesh, nullptr) == RIMLINE_OK);
    rimline_bytes* edges = nullptr;
    REQUIRE(rimline_mesh_silhouette(mesh, &k_eye, &edges, nullptr) == RIMLINE_OK);
    const std::size_t count = rimline_bytes_size(edges) / 4;
    CHECK(count >= 3);
    std::vector<std::uint32_t> vertices(2 * count);
    REQUIRE(rimline_mesh_edge_vertices(mesh,
                                       static_cast<const std::uint32_t*>(rimline_bytes_data(edges)),
                                       count, vertices.data(), nullptr) == RIMLINE_OK);
    CHECK(*std::ranges::max_element(vertices) <= 3);
    const std::uint32_t none[] = {6};
    CHECK(failing([&](rimline_error** e) {
              return rimline_mesh_edge_vertices(mesh, none, 1, vertices.data(), e);
          }) == RIMLINE_BAD_ARGUMENT);
    rimline_bytes_free(edges);
    const float* places = nullptr;
    std::size_t place_count = 0;
    REQUIRE(rimline_mesh_positions(mesh, &places, &place_count, nullptr) == RIMLINE_OK);
    REQUIRE(place_count == 4);
    CHECK(std::memcmp(places, positions, sizeof positions) == 0);
    const std::uint32_t faces[] = {0, 1, 2, 3};
    std::uint32_t face_corners[12] = {};
    REQUIRE(rimline_mesh_face_vertices(mesh, faces, 4, face_corners, nullptr) == RIMLINE_OK);
    CHECK(std::memcmp(face_corners, corners, sizeof corners) == 0);
    const std::uint32_t no_face[] = {0, 4};
    CHECK(failing([&](rimline_error** e) {
              return rimline_mesh_face_vertices(mesh, no_face, 2, face_corners, e);
          }) == RIMLINE_BAD_ARGUMENT);
    CHECK(failing([&](rimline_error** e) {
              return rimline_mesh_face_vertices(mesh, nullptr, 1, face_corners, e);
          }) == RIMLINE_BAD_ARGUMENT);
    CHECK(failing([&](rimline_error** e) {
              return rimline_mesh_positions(nullptr, &places, &place_count, e);
          }) == RIMLINE_BAD_ARGUMENT);
    CHECK(places == nullptr);
    rimline_mesh_free(mesh);

    const std::uint32_t outside[] = {0, 1, 4};
    CHECK(failing([&](rimline_error** e) {
              return rimline_mesh_create(positions, 4, outside, 1, nullptr, &mesh, e);
          }) == RIMLINE_BAD_ARGUMENT);
    CHECK(mesh == nullptr);
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
        const float wrong[] = {0, 0, 0, 1, bad, 0, 0, 1, 0};
        CHECK(failing([&](rimline_error** e) {
                  return rimline_mesh_create(wrong, 3, corners, 1, nullptr, &mesh, e);
              }) == RIMLINE_BAD_ARGUMENT);
    }
    REQUIRE(rimline_mesh_create(nullptr, 0, nullptr, 0, nullptr, &mesh, nullptr) == RIMLINE_OK);
    REQUIRE(rimline_mesh_silhouette(mesh, &k_eye, &edges, nullptr) == RIMLINE_OK);
    CHECK(rimline_bytes_size(edges) == 0);
    rimline_drawer* drawer = nullptr;
    CHECK(failing([&](rimline_error** e) {
              return rimline_drawer_create(mesh, nullptr, &drawer, e);
          }) == RIMLINE_BAD_INPUT);
    std::size_t found = 9;
    rimline_view view{};
    CHECK(rimline_best_views(mesh, nullptr, 1, nullptr, &view, &found, nullptr) == RIMLINE_OK);
    CHECK(found == 0);
    rimline_bytes_free(edges);
    rimline_mesh_free(mesh);
}

TEST_CASE("a direction is one however short") {
    rimline_mesh* mesh = nullptr;
    REQUIRE(rimline_mesh_load("shape:knot:2000", nullptr, &mesh, nullptr) == RIMLINE_OK);
    const auto edges_of = [&](double length) {
        const rimline_point point{length, 0.8 * length, 0.0, 1};
        rimline_bytes* edges = nullptr;
        REQUIRE(rimline_mesh_silhouette(mesh, &point, &edges, nullptr) == RIMLINE_OK);
        const std::string found(static_cast<const char*>(rimline_bytes_data(edges)),
                                rimline_bytes_size(edges));
        rimline_bytes_free(edges);
        return found;
    };
    for (const int power : {-10, -60, -62, -100, -300, -1040})
        CHECK(edges_of(std::ldexp(1.0, power)) == edges_of(1.0));
    rimline_mesh_free(mesh);
}

TEST_CASE("a mesh says what was lost") {
    rimline_mesh* mesh = nullptr;
    REQUIRE(rimline_mesh_load("shape:box", nullptr, &mesh, nullptr) == RIMLINE_OK);
    CHECK(rimline_mesh_warning(mesh, 0) == nullptr);
    CHECK(rimline_mesh_warning(nullptr, 0) == nullptr);
    rimline_mesh_free(mesh);
    const float far = 5411000.0f;
    const float positions[] = {far, 0, 0, far + 1, 0, 0, far, 1, 0};
    const std::uint32_t corners[] = {0, 1, 2};
    REQUIRE(rimline_mesh_create(positions, 3, corners, 1, nullptr, &mesh, nullptr) == RIMLINE_OK);
    const char* const warning = rimline_mesh_warning(mesh, 0);
    REQUIRE(warning != nullptr);
    CHECK(std::string(warning).find("single precision loses its shape") != std::string::npos);
    CHECK(rimline_mesh_warning(mesh, 1) == nullptr);
    rimline_mesh_free(mesh);
}

TEST_CASE("a call that waits for the turn of another can be ended") {
    rimline_mesh* mesh = nullptr;
    REQUIRE(rimline_mesh_load("shape:knot:20000", nullptr, &mesh, nullptr) == RIMLINE_OK);
    rimline_drawer* drawer = nullptr;
    REQUIRE(rimline_drawer_create(mesh, nullptr, &drawer, nullptr) == RIMLINE_OK);
    struct Shared {
        std::atomic<bool> is_drawing = false, goes_on = false;
    } shared;
    // The first call holds the drawer until it may go on.
    std::thread first([&] {
        const rimline_call call{sizeof call,
                                [](double, void* user) {
                                    auto& s = *static_cast<Shared*>(user);
                                    s.is_drawing = true;
                                    while (!s.goes_on) std::this_thread::yield();
                                    return 0;
                                },
                                &shared};
        rimline_drawing* drawing = nullptr;
        CHECK(rimline_drawer_draw(drawer, nullptr, 0, &call, &drawing, nullptr) == RIMLINE_OK);
        rimline_drawing_free(drawing);
    });
    while (!shared.is_drawing) std::this_thread::yield();
    const rimline_call ended{sizeof ended, [](double, void*) { return 1; }, nullptr};
    rimline_drawing* none = nullptr;
    CHECK(failing([&](rimline_error** e) {
              return rimline_drawer_draw(drawer, nullptr, 0, &ended, &none, e);
          }) == RIMLINE_CANCELLED);
    CHECK_FALSE(shared.goes_on);
    shared.goes_on = true;
    first.join();
    rimline_drawer_free(drawer);
    rimline_mesh_free(mesh);
}

TEST_CASE("null handles and wrong arguments are errors, never crashes") {
    rimline_mesh* mesh = load("shape:box");
    rimline_mesh* other = nullptr;
    rimline_mesh_info info{.struct_size = sizeof info};
    rimline_bytes* bytes = nullptr;
    rimline_tracker* tracker = nullptr;
    rimline_drawer* drawer = nullptr;
    rimline_drawing* drawing = nullptr;
    rimline_picture* picture = nullptr;
    rimline_line line{.struct_size = sizeof line};
    std::size_t count = 0;
    const std::uint32_t* numbers = nullptr;
    const rimline_point not_a_number{std::nan(""), 0, 0, 0}, far{1e30, 0, 0, 0}, zero{0, 0, 0, 1};
    const auto wrong = [](auto call) { CHECK(failing(call) == RIMLINE_BAD_ARGUMENT); };
    wrong([&](auto e) { return rimline_mesh_load(nullptr, nullptr, &other, e); });
    wrong([&](auto e) { return rimline_mesh_load("", nullptr, &other, e); });
    wrong([&](auto e) { return rimline_mesh_load("-", nullptr, &other, e); });
    rimline_error* error = nullptr;
    CHECK(rimline_mesh_load("shape:nothing", nullptr, &other, &error) == RIMLINE_BAD_ARGUMENT);
    CHECK(std::string(rimline_error_message(error)).starts_with("path: no built-in shape"));
    rimline_error_free(error);
    wrong([&](auto e) { return rimline_mesh_load("shape:box", nullptr, nullptr, e); });
    wrong([&](auto e) { return rimline_mesh_get_info(nullptr, &info, e); });
    wrong([&](auto e) { return rimline_mesh_get_info(mesh, nullptr, e); });
    rimline_mesh_info unset{};
    wrong([&](auto e) { return rimline_mesh_get_info(mesh, &unset, e); });
    for (const rimline_point* point :
         {static_cast<const rimline_point*>(nullptr), &not_a_number, &far, &zero}) {
        wrong([&](auto e) { return rimline_mesh_silhouette(mesh, point, &bytes, e); });
        wrong([&](auto e) { return rimline_tracker_create(mesh, point, nullptr, &tracker, e); });
    }
    wrong([&](auto e) { return rimline_mesh_silhouette(nullptr, &k_eye, &bytes, e); });
    wrong([&](auto e) { return rimline_tracker_create(nullptr, &k_eye, nullptr, &tracker, e); });
    wrong([&](auto e) { return rimline_tracker_move(nullptr, &k_eye, nullptr, e); });
    wrong([&](auto e) { return rimline_tracker_silhouette(nullptr, &numbers, &count, e); });
    wrong([&](auto e) { return rimline_tracker_face_words(nullptr, &numbers, &count, e); });
    wrong([&](auto e) { return rimline_drawer_create(nullptr, nullptr, &drawer, e); });
    wrong([&](auto e) { return rimline_drawer_draw(nullptr, nullptr, 0, nullptr, &drawing, e); });
    wrong([&](auto e) { return rimline_drawing_page(nullptr, nullptr, nullptr, &count, e); });
    wrong([&](auto e) { return rimline_drawing_line(nullptr, 0, &line, e); });
    wrong([&](auto e) { return rimline_drawing_encode(nullptr, RIMLINE_SVG, &bytes, e); });
    wrong([&](auto e) {
        return rimline_renderer_render(nullptr, mesh, nullptr, 0, nullptr, &picture, e);
    });
    wrong([&](auto e) { return rimline_picture_pixels(nullptr, nullptr, nullptr, nullptr, e); });
    wrong([&](auto e) { return rimline_picture_encode_png(nullptr, &bytes, e); });
    wrong([&](auto e) {
        return rimline_best_views(nullptr, nullptr, 1, nullptr, nullptr, &count, e);
    });
    wrong(
        [&](auto e) { return rimline_best_views(mesh, nullptr, 1, nullptr, nullptr, &count, e); });
    rimline_call call{};
    wrong([&](auto e) { return rimline_mesh_load("shape:box", &call, &other, e); });

    REQUIRE(rimline_tracker_create(mesh, &k_eye, nullptr, &tracker, nullptr) == RIMLINE_OK);
    rimline_changes unset_changes{};
    wrong([&](auto e) { return rimline_tracker_move(tracker, &k_eye, &unset_changes, e); });
    wrong([&](auto e) { return rimline_tracker_move(tracker, &not_a_number, nullptr, e); });
    // An older caller's struct is shorter.
    rimline_changes older{};
    older.struct_size = offsetof(rimline_changes, flipped);
    older.added_count = 77;
    REQUIRE(rimline_tracker_move(tracker, &k_eye, &older, nullptr) == RIMLINE_OK);
    CHECK(older.sequence == 1);
    CHECK(older.added_count == 77);
    rimline_tracker_free(tracker);

    REQUIRE(rimline_drawer_create(mesh, nullptr, &drawer, nullptr) == RIMLINE_OK);
    const std::vector<rimline_option> bad{
        {"no-such-option", "1"}, {"hidden", "sometimes"}, {"eye", "1,2"},
        {"hidden", nullptr},     {nullptr, nullptr},      {"help", nullptr},
        {"scale", "1:2"},        {"eye", "0,0,0"},        {"hidden", ""}};
    for (const rimline_option& option : bad)
        wrong(
            [&](auto e) { return rimline_drawer_draw(drawer, &option, 1, nullptr, &drawing, e); });
    // An option without a value does not take the next one for it.
    const rimline_option no_value[] = {{"eye", nullptr}, {"fov", "40"}};
    rimline_error* without = nullptr;
    CHECK(rimline_drawer_draw(drawer, no_value, 2, nullptr, &drawing, &without) ==
          RIMLINE_BAD_ARGUMENT);
    CHECK(std::string(rimline_error_message(without)) == "options: eye needs a value");
    rimline_error_free(without);
    const rimline_option twice[] = {{"eye", "1,2,3"}, {"fov", "30"}, {"eye", "3,2,1"}};
    CHECK(rimline_drawer_draw(drawer, twice, 3, nullptr, &drawing, &without) ==
          RIMLINE_BAD_ARGUMENT);
    CHECK(std::string(rimline_error_message(without)) == "options: 'eye' is given twice");
    rimline_error_free(without);
    wrong([&](auto e) { return rimline_drawer_draw(drawer, nullptr, 1, nullptr, &drawing, e); });
    REQUIRE(rimline_drawer_draw(drawer, nullptr, 0, nullptr, &drawing, nullptr) == RIMLINE_OK);
    REQUIRE(rimline_drawing_page(drawing, nullptr, nullptr, &count, nullptr) == RIMLINE_OK);
    wrong([&](auto e) { return rimline_drawing_line(drawing, count, &line, e); });
    wrong([&](auto e) { return rimline_drawing_encode(drawing, 7, &bytes, e); });
    REQUIRE(rimline_drawing_line(drawing, 0, &line, nullptr) == RIMLINE_OK);
    CHECK(line.point_count >= 2);
    CHECK(std::isfinite(line.points[2 * line.point_count - 1]));
    rimline_drawing_free(drawing);
    rimline_drawer_free(drawer);
    rimline_mesh_free(mesh);

    rimline_error_free(nullptr);
    rimline_bytes_free(nullptr);
    rimline_mesh_free(nullptr);
    rimline_tracker_free(nullptr);
    rimline_drawer_free(nullptr);
    rimline_drawing_free(nullptr);
    rimline_renderer_free(nullptr);
    rimline_picture_free(nullptr);
    CHECK(rimline_bytes_size(nullptr) == 0);
    CHECK(rimline_error_status(nullptr) == RIMLINE_OK);
    CHECK(std::string(rimline_version()).find('.') != std::string::npos);
}

TEST_CASE(
    "a progress function that uses what its call uses is refused, and does not wait for itself") {
    rimline_mesh* mesh = load("shape:knot:20000");
    struct Seen {
        rimline_mesh* mesh;
        rimline_drawer* drawer = nullptr;
        rimline_status status = RIMLINE_OK;
    } seen{mesh};
    const rimline_call making{sizeof making,
                              [](double, void* user) {
                                  auto& s = *static_cast<Seen*>(user);
                                  rimline_tracker* tracker = nullptr;
                                  s.status = rimline_tracker_create(s.mesh, &k_eye, nullptr,
                                                                    &tracker, nullptr);
                                  return 0;
                              },
                              &seen};
    rimline_tracker* tracker = nullptr;
    REQUIRE(rimline_tracker_create(mesh, &k_eye, &making, &tracker, nullptr) == RIMLINE_OK);
    CHECK(seen.status == RIMLINE_BAD_ARGUMENT);
    REQUIRE(rimline_drawer_create(mesh, nullptr, &seen.drawer, nullptr) == RIMLINE_OK);
    const rimline_call drawing_call{sizeof drawing_call,
                                    [](double, void* user) {
                                        auto& s = *static_cast<Seen*>(user);
                                        rimline_drawing* none = nullptr;
                                        s.status = rimline_drawer_draw(s.drawer, nullptr, 0,
                                                                       nullptr, &none, nullptr);
                                        return 0;
                                    },
                                    &seen};
    seen.status = RIMLINE_OK;
    rimline_drawing* drawing = nullptr;
    REQUIRE(rimline_drawer_draw(seen.drawer, nullptr, 0, &drawing_call, &drawing, nullptr) ==
            RIMLINE_OK);
    CHECK(seen.status == RIMLINE_BAD_ARGUMENT);
    rimline_drawing_free(drawing);
    rimline_drawer_free(seen.drawer);
    rimline_tracker_free(tracker);
    rimline_mesh_free(mesh);
}

TEST_CASE("messages are UTF-8, whatever names are") {
    rimline_mesh* mesh = nullptr;
    rimline_error* error = nullptr;
    REQUIRE(rimline_mesh_load("b\xff.obj", nullptr, &mesh, &error) == RIMLINE_IO);
    CHECK(std::string(rimline_error_message(error)).starts_with("b\\xff.obj: "));
    rimline_error_free(error);
}

TEST_CASE("the progress function sees shares that grow, and ends calls") {
    struct Seen {
        std::vector<double> shares;
        std::size_t end_after = 1'000'000;
    };
    const auto note = [](double share, void* user) {
        auto& seen = *static_cast<Seen*>(user);
        seen.shares.push_back(share);
        return seen.shares.size() >= seen.end_after ? 1 : 0;
    };
    Seen seen;
    rimline_call call{sizeof call, note, &seen};
    rimline_mesh* mesh = nullptr;
    REQUIRE(rimline_mesh_load("shape:knot:100000", &call, &mesh, nullptr) == RIMLINE_OK);
    CHECK(std::ranges::is_sorted(seen.shares));
    CHECK_FALSE(seen.shares.empty());
    // No step before the last one reports that all is done.
    seen.shares.clear();
    rimline_drawer* drawer = nullptr;
    REQUIRE(rimline_drawer_create(mesh, nullptr, &drawer, nullptr) == RIMLINE_OK);
    const rimline_option chosen{"eye", "auto"};
    rimline_drawing* drawing = nullptr;
    REQUIRE(rimline_drawer_draw(drawer, &chosen, 1, &call, &drawing, nullptr) == RIMLINE_OK);
    CHECK(std::ranges::is_sorted(seen.shares));
    CHECK(std::ranges::count_if(seen.shares, [](double share) { return share > 0.96; }) == 1);
    CHECK(seen.shares.back() == 1.0);
    rimline_drawing_free(drawing);
    rimline_drawer_free(drawer);
    seen = {.shares = {}, .end_after = 1};
    rimline_tracker* tracker = nullptr;
    CHECK(failing([&](auto e) {
              seen.shares.clear();
              return rimline_tracker_create(mesh, &k_eye, &call, &tracker, e);
          }) == RIMLINE_CANCELLED);
    CHECK(tracker == nullptr);
    REQUIRE(rimline_tracker_create(mesh, &k_eye, nullptr, &tracker, nullptr) == RIMLINE_OK);
    rimline_tracker_free(tracker);
    rimline_mesh_free(mesh);
    rimline_mesh* missing = nullptr;
    CHECK(failing([&](auto e) {
              return rimline_mesh_load("/no/such/file.obj", nullptr, &missing, e);
          }) == RIMLINE_IO);
}

TEST_CASE("pictures and views are drawn" * doctest::test_suite("device")) {
    rimline_renderer* renderer = nullptr;
    if (rimline_renderer_create(nullptr, &renderer, nullptr) == RIMLINE_NO_DEVICE)
        RIMLINE_SKIP("no Vulkan device");
    REQUIRE(renderer != nullptr);
    rimline_mesh* mesh = load("shape:knot:3000");
    const rimline_option options[] = {{"size", "64x48"}, {"style", "toon"}, {"ground", nullptr}};
    rimline_picture* picture = nullptr;
    REQUIRE(rimline_renderer_render(renderer, mesh, options, 3, nullptr, &picture, nullptr) ==
            RIMLINE_OK);
    std::uint32_t width = 0, height = 0;
    const std::uint8_t* rgba = nullptr;
    REQUIRE(rimline_picture_pixels(picture, &width, &height, &rgba, nullptr) == RIMLINE_OK);
    CHECK(width == 64);
    CHECK(height == 48);
    std::size_t dark = 0;
    for (std::size_t i = 0; i < 64 * 48; ++i) dark += rgba[4 * i] < 60 ? 1 : 0;
    CHECK(dark > 20);  // Lines.
    rimline_bytes* png = nullptr;
    REQUIRE(rimline_picture_encode_png(picture, &png, nullptr) == RIMLINE_OK);
    CHECK(std::memcmp(rimline_bytes_data(png), "\x89PNG", 4) == 0);
    rimline_view views[3];
    std::size_t count = 0;
    REQUIRE(rimline_best_views(mesh, renderer, 3, nullptr, views, &count, nullptr) == RIMLINE_OK);
    CHECK(count == 3);
    CHECK(views[0].visible_ratio > 0.3);
    rimline_view by_rays[3];
    REQUIRE(rimline_best_views(mesh, nullptr, 3, nullptr, by_rays, &count, nullptr) == RIMLINE_OK);
    CHECK(count == 3);
    CHECK(std::abs(by_rays[0].visible_ratio - views[0].visible_ratio) < 0.01);
    for (int i = 0; i < 3; ++i) CHECK(std::abs(by_rays[0].eye[i] - views[0].eye[i]) < 0.1);
    // A picture that waits for the renderer of another can be ended.
    struct Shared {
        std::atomic<bool> is_drawing = false, goes_on = false;
    } shared;
    std::thread first([&] {
        const rimline_call call{sizeof call,
                                [](double share, void* user) {
                                    auto& s = *static_cast<Shared*>(user);
                                    s.is_drawing = share > 0.0;
                                    while (share > 0.0 && !s.goes_on) std::this_thread::yield();
                                    return 0;
                                },
                                &shared};
        rimline_picture* other = nullptr;
        CHECK(rimline_renderer_render(renderer, mesh, options, 3, &call, &other, nullptr) ==
              RIMLINE_OK);
        rimline_picture_free(other);
    });
    while (!shared.is_drawing) std::this_thread::yield();
    const rimline_call ended{sizeof ended, [](double, void*) { return 1; }, nullptr};
    rimline_picture* none = nullptr;
    CHECK(failing([&](auto e) {
              return rimline_renderer_render(renderer, mesh, options, 3, &ended, &none, e);
          }) == RIMLINE_CANCELLED);
    shared.goes_on = true;
    first.join();
    // Closing the device in a child of fork() would wait for threads that it has not.
    const pid_t child = fork();
    if (child == 0) {
        alarm(20);
        rimline_renderer_free(renderer);
        _exit(0);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
    CHECK(failing([&](auto e) {
              const rimline_option bad{"style", "oil"};
              return rimline_renderer_render(renderer, mesh, &bad, 1, nullptr, &picture, e);
          }) == RIMLINE_BAD_ARGUMENT);
    CHECK(failing([&](auto e) {
              return rimline_renderer_create("no-such-device", &renderer, e);
          }) == RIMLINE_NO_DEVICE);
    rimline_bytes_free(png);
    rimline_mesh_free(mesh);
}

}  // namespace
