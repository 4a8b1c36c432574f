#pragma once

// Opens models and clouds on a separate thread, so that the window stays responsive while a large file is
// read.
//
// Only one file is loaded at a time: open() cancels the load before it. The window's thread fetches the
// result with take(). A failed load gives an error message and does not end the program.

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
    /// `wake` is called on the loading thread whenever stage() or the result has changed.
    explicit ModelLoader(std::function<void()> wake = {}) : wake_(std::move(wake)) {}
    /// Cancels the load and waits for its end.
    ~ModelLoader();
    ModelLoader(const ModelLoader&) = delete;
    ModelLoader& operator=(const ModelLoader&) = delete;

    /// Cancels the load before, and starts to load a file or shape as open_document() does.
    void open(CloudArgument argument);
    void open(std::string name) { open(CloudArgument{.model = std::move(name)}); }
    /// Stops the load and waits for its end. Discards a result that was not taken.
    void cancel();

    struct Stage {
        std::string task;    ///< "reading bunny.obj"
        double share = 0.0;  ///< Progress of this task, in [0, 1].
    };
    /// Nothing while no load is in progress.
    std::optional<Stage> stage() const;

    struct Result {
        Document document;  ///< Empty if the load failed.
        std::string error;  ///< Why it failed.
    };
    /// The result of the last open(). Each result is returned once.
    std::optional<Result> take();

private:
    void load(std::stop_token stop, const CloudArgument& argument);
    void wake() const {
        if (wake_) wake_();
    }

    std::function<void()> wake_;
    mutable std::mutex mutex_;  // Guards the two members below.
    std::optional<Stage> stage_;
    std::optional<Result> result_;
    std::jthread thread_;  // Last: it is joined before the other members are destroyed.
};

}  // namespace rimline::tools
