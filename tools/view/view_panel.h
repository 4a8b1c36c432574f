#pragma once

// The panel beside the picture: every choice there is, what the last frame took, and what went wrong. It
// changes the session directly; what takes time or writes files it only asks for.

#include <array>
#include <optional>
#include <string>

#include "tools/view/hough_panel.h"
#include "tools/view/model_loader.h"
#include "tools/view/view_counters.h"
#include "tools/view/view_input.h"
#include "tools/view/view_session.h"

namespace rimline::tools {

/// What was asked for in a frame.
struct PanelRequests {
    std::optional<std::string> open;  ///< A model's name.
    bool cancel = false;              ///< What is being loaded.
    bool fit = false;
    struct Save {
        std::string path;
        ImageSize size;
    };
    std::optional<Save> save;
};

class ViewPanel {
public:
    /// In units of the panel, its margins included.
    static constexpr float k_width = 320.0f;

    bool visible = true;
    std::string message;  ///< What went wrong or was done last; empty to say nothing.
    bool message_is_error = false;

    void tell(std::string text, bool is_error) {
        message = std::move(text);
        message_is_error = is_error;
    }

    struct Shown {
        const ViewCounters& counters;
        std::optional<ModelLoader::Stage> loading;
        std::string device;
        float scale;  ///< Units of the panel for one of a desktop with letters of usual size.
    };
    /// Draws the panel and, where open, the inspector's; `hough` is what that one is opened by.
    PanelRequests draw(ViewSession& session, ViewInput& hand, HoughPanel& hough,
                       const Shown& shown);

private:
    void draw_model(const ViewSession& session, const Shown& shown, PanelRequests& requests);
    void draw_view(ViewSession& session, ViewInput& hand, PanelRequests& requests);
    void draw_look(ViewSession& session);
    static void draw_colors(ViewSession& session);
    void draw_lights(ViewSession& session);
    void draw_enabled_lights(ViewSession& session);
    void draw_picture(PanelRequests& requests);
    void draw_counters(const ViewSession& session, const Shown& shown);

    std::array<char, 1024> path_{};
    std::array<char, 1024> picture_path_{"view.png"};
    std::array<int, 2> picture_size_{1920, 1440};
};

}  // namespace rimline::tools
