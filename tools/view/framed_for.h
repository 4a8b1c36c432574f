#pragma once

// The cameras of the picture that the window shows and of those that it saves.

#include "engine/camera.h"
#include "tools/options/option_types.h"
#include "tools/view/view_session.h"

namespace rimline::tools {

/// While it lives, the camera is that of a picture of `size`: what is framed in the window, beside the panel, is framed
/// in the picture too.
class FramedFor {
public:
    FramedFor(ViewSession& session, bool is_framed, ImageSize size)
        : session_(session), shown_(session.camera) {
        if (is_framed) session_.fit({.window = {size.width, size.height}});
    }
    ~FramedFor() { session_.camera = shown_; }
    FramedFor(const FramedFor&) = delete;
    FramedFor& operator=(const FramedFor&) = delete;

private:
    ViewSession& session_;
    const Camera shown_;
};

/// While it lives, the camera is ViewSession::shown_camera().
class ShownBeside {
public:
    ShownBeside(ViewSession& session, const FreeArea& area)
        : session_(session), camera_(session.camera) {
        session_.camera = session_.shown_camera(area);
    }
    ~ShownBeside() { session_.camera = camera_; }
    ShownBeside(const ShownBeside&) = delete;
    ShownBeside& operator=(const ShownBeside&) = delete;

private:
    ViewSession& session_;
    const Camera camera_;
};

}  // namespace rimline::tools
