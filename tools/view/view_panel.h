#pragma once

// The panel beside the picture: all settings, the counters of the last frame, and messages. It changes the
// session directly. Slow actions and those that write files are returned as requests.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tools/view/file_browser.h"
#include "tools/view/hough_panel.h"
#include "tools/view/model_loader.h"
#include "tools/view/view_counters.h"
#include "tools/view/view_gallery.h"
#include "tools/view/view_input.h"
#include "tools/view/view_session.h"

namespace rimline::tools {

/// Actions that the user requested in one frame.
struct PanelRequests {
    std::optional<std::string> open;                   ///< The model to open.
    bool adds = false;                                 ///< It is added to the scene that is shown.
    std::optional<std::vector<PlacedModel>> arranged;  ///< The models of the scene, moved.
    bool has_new_first = false;                        ///< Of these (Arrangement).
    bool cancel = false;                               ///< Cancel the load.
    bool fit = false;                                  ///< Fit the model into the picture.
    bool lens = false;                                 ///< The camera has another one.
    bool choose_sun = false;                           ///< Light the model for the camera.
    bool play = false;                                 ///< Begin to play the camera path, or stop.
    bool copy_command = false;  ///< Put a command line that draws the picture into the clipboard.
    std::optional<glm::dvec3> up;         ///< Make this axis the upward one.
    std::optional<glm::dvec3> look_from;  ///< Turn the camera: the direction towards the viewer.
    struct Save {
        std::string path;
        ImageSize size;
    };
    std::optional<Save> save;        ///< A picture.
    std::optional<Save> save_scene;  ///< A scene file, for a picture of this size.
};

enum class MessageKind { result, warning, error };

class ViewPanel {
public:
    /// In units of the panel, margins included.
    static constexpr float k_width = 320.0f;

    bool visible = true;
    std::string message;  ///< The last one; may be empty.
    MessageKind message_kind = MessageKind::result;

    void show_message(std::string text, MessageKind kind) {
        message = std::move(text);
        message_kind = kind;
    }

    /// What the panel displays beside the session.
    struct Status {
        const ViewCounters& counters;
        std::optional<ModelLoader::Stage> loading;
        std::string device;
        const std::vector<std::string>& recent;                          ///< Files to open again.
        const std::vector<std::shared_ptr<const GalleryView>>& gallery;  ///< Views to choose from.
        bool has_path, plays_path;  ///< A camera path through the best views.
        bool finds_views;           ///< More are being found.
        float scale;                ///< The desktop's text scale; 1 is the usual size.
    };
    /// Draws the panel. A check box opens and closes `hough`, which the caller draws.
    void draw(ViewSession& session, ViewInput& input, HoughPanel& hough, const Status& status,
              PanelRequests& requests);
    /// Draws the message, if there is one, at the lower edge of the picture, and the progress of a load where the panel
    /// is hidden.
    void draw_messages(const Status& status, PanelRequests& requests);

    /// Forgets what the user has changed of the models' places; for a scene that cannot be shown.
    void forget_places() noexcept { shown_.clear(); }
    /// Whether only its title was shown in the last frame.
    bool is_folded() const noexcept { return is_folded_; }
    /// Of pictures to be saved.
    void set_picture_size(ImageSize size) {
        picture_size_ = {static_cast<int>(size.width), static_cast<int>(size.height)};
    }
    /// Whether files that are opened are added to the scene.
    bool adds() const noexcept { return adds_; }

    /// What the panel says of a picture and of a scene file to be saved.
    PanelRequests::Save picture_request() const;
    PanelRequests::Save scene_request() const;

private:
    void draw_model(const ViewSession& session, const Status& status, PanelRequests& requests);
    void draw_choice(const Status& status, PanelRequests& requests);
    void draw_models(const ViewSession& session, PanelRequests& requests);
    void draw_view(ViewSession& session, ViewInput& input, PanelRequests& requests);
    static void draw_directions(const ViewSession& session, PanelRequests& requests);
    static void draw_gallery(const Status& status, PanelRequests& requests);
    static void draw_camera(const ViewSession& session, PanelRequests& requests);
    void draw_appearance(ViewSession& session);
    static void draw_colors(ViewSession& session);
    void draw_lights(ViewSession& session, PanelRequests& requests);
    void draw_enabled_lights(ViewSession& session, PanelRequests& requests);
    void draw_picture(const ViewSession& session, PanelRequests& requests);
    void draw_counters(const ViewSession& session, const Status& status);

    std::array<char, 1024> path_{};
    FileBrowser browser_;
    bool browses_ = false;
    bool is_folded_ = false;
    bool adds_ = false;
    // The models of the document, and what the user makes of them.
    std::vector<PlacedModel> shown_, placed_;
    bool has_new_first_ = false;  // Of placed_.
    std::array<char, 1024> picture_path_{"view.png"};
    std::array<char, 1024> scene_path_{"scene.json"};
    std::array<int, 2> picture_size_{1920, 1440};
};

}  // namespace rimline::tools
