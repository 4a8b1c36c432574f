#pragma once

// The best views of the model that the window shows, as small line drawings to choose from. They are found on a
// thread of their own, by votes alone (silhouette/field/best_views.h).

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "silhouette/field/camera_path.h"
#include "tools/view/model_document.h"

namespace rimline::tools {

struct GalleryView {
    glm::dvec3 towards_viewer;  ///< Of length 1.
    /// Polylines in the square from (-1, -1) to (1, 1), y upwards, which the model's sphere fills.
    std::vector<std::vector<glm::vec2>> strokes;
};

/// The silhouettes, borders and clear creases seen from a direction. Orthographic.
GalleryView gallery_view(const LineSurface& surface, const glm::dvec3& towards_viewer,
                         const glm::dvec3& up, const LongCall& call = {});

class ViewGallery {
public:
    static constexpr std::uint32_t k_views = 4;

    /// `wake` is called on the other thread when there is a new view.
    explicit ViewGallery(std::function<void()> wake = {}) : wake_(std::move(wake)) {}
    ~ViewGallery() { clear(); }
    ViewGallery(const ViewGallery&) = delete;
    ViewGallery& operator=(const ViewGallery&) = delete;

    /// Finds the views of `model`, which must live until clear() or the next call.
    void find(const ModelDocument& model, const glm::dvec3& up);
    /// Stops and forgets.
    void clear();
    /// Those found so far, best first.
    std::vector<std::shared_ptr<const GalleryView>> views() const;
    bool is_finding() const;
    /// A closed path through the views, once all are found (silhouette/field/camera_tour.h).
    std::optional<CameraPath> path() const;

private:
    void work(const LongCall& call, const ModelDocument& model, const glm::dvec3& up);

    std::function<void()> wake_;
    mutable std::mutex mutex_;  // Guards the three members below.
    std::vector<std::shared_ptr<const GalleryView>> views_;
    std::optional<CameraPath> path_;
    bool is_finding_ = false;
    std::jthread thread_;  // Last: it is joined before the other members are destroyed.
};

}  // namespace rimline::tools
