#pragma once

// Opens models and clouds on a thread of its own, so that the window goes on while a large file is read.
//
// One at a time: asking for another stops the one before. What comes of it is picked up by the window's
// thread; what fails is a message, never the end of the program.

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "tools/view/document.h"

namespace rimline::tools {

class ModelLoader {
public:
    /// `wake` is called from the loading thread whenever there is something new to show.
    explicit ModelLoader(std::function<void()> wake = {}) : wake_(std::move(wake)) {}
    /// Stops what is being loaded, and waits until it has stopped.
    ~ModelLoader();
    ModelLoader(const ModelLoader&) = delete;
    ModelLoader& operator=(const ModelLoader&) = delete;

    /// Stops what is being loaded and begins with a file or shape: as open_named() tells which it is.
    void open(CloudArgument named);
    void open(std::string name) { open(CloudArgument{.model = std::move(name)}); }
    /// Stops what is being loaded. Its result, if there is one already, is dropped.
    void cancel();

    struct Stage {
        std::string doing;   ///< "reading bunny.obj"
        double share = 0.0;  ///< Of this part of the work, in [0, 1].
    };
    /// Nothing when nothing is being loaded.
    std::optional<Stage> stage() const;

    struct Result {
        Document opened;    ///< Nothing when it failed.
        std::string error;  ///< Why.
    };
    /// What has come of the last open(), once.
    std::optional<Result> take();

private:
    void load(std::stop_token stop, const CloudArgument& named);
    void wake() const {
        if (wake_) wake_();
    }

    std::function<void()> wake_;
    mutable std::mutex mutex_;  // Guards the two below.
    std::optional<Stage> stage_;
    std::optional<Result> result_;
    std::jthread thread_;  // Last: it ends before the rest goes.
};

}  // namespace rimline::tools
