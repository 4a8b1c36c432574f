#include "tools/view/model_loader.h"

#include <CLI/Error.hpp>
#include <exception>
#include <new>
#include <utility>

#include "tools/command.h"
#include "tools/view/view_arguments.h"

namespace rimline::tools {

namespace {

// Least increase of progress that wakes the window.
constexpr double k_min_step = 0.01;

}  // namespace

void ModelLoader::cancel() {
    load_.thread.request_stop();
    if (load_.thread.joinable()) cancelled_.push_back(std::move(load_));
    load_ = {};
    std::erase_if(cancelled_, [](const Load& load) { return load.has_ended->load(); });
    const std::lock_guard lock(mutex_);
    stage_.reset();
    result_.reset();
}

void ModelLoader::open(const std::string& name) {
    // Else it would be an option.
    open(std::vector{(name.starts_with('-') ? "./" : "") + name});
}

void ModelLoader::open(std::vector<std::string> arguments) {
    std::string name = arguments.front();
    start(std::move(name), [arguments = std::move(arguments)](const BeginCall& begin) {
        ParsedView parsed = open_view(arguments, begin);
        return Result{.view = std::move(parsed.view),
                      .kind = parsed.is_scene_file ? Kind::scene : Kind::document,
                      .error = {}};
    });
}

void ModelLoader::arrange(Arrangement arrangement) {
    std::string name = arrangement.added.empty() ? "the scene" : arrangement.added.front();
    start(std::move(name), [arrangement = std::move(arrangement)](const BeginCall& begin) {
        const std::vector<PlacedModel> models = place_added(arrangement, begin);
        return Result{.view = open_view(view_arguments(models, arrangement.up), begin).view,
                      .kind = Kind::arrangement,
                      .error = {}};
    });
}

void ModelLoader::start(std::string name, Work work) {
    cancel();
    stage_ = Stage{"opening " + name, 0.0};
    load_.has_ended = std::make_shared<std::atomic<bool>>(false);
    load_.thread = std::jthread([this, has_ended = load_.has_ended, name = std::move(name),
                                 work = std::move(work)](const std::stop_token& stop) {
        load(stop, name, work);
        has_ended->store(true);
    });
}

std::optional<ModelLoader::Stage> ModelLoader::stage() const {
    const std::lock_guard lock(mutex_);
    return stage_;
}

std::optional<ModelLoader::Result> ModelLoader::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

// A load that was cancelled changes nothing any more: what it would change is another one's.
void ModelLoader::load(const std::stop_token& stop, const std::string& name, const Work& work) {
    const auto begin = [&](const std::string& task) {
        {
            const std::lock_guard lock(mutex_);
            if (!stop.stop_requested()) stage_ = Stage{task, 0.0};
        }
        wake();
        return LongCall{stop, [this, stop](double share) {
                            {
                                const std::lock_guard lock(mutex_);
                                if (stop.stop_requested()) return;
                                if (share < stage_->share + k_min_step) return;
                                stage_->share = share;
                            }
                            wake();
                        }};
    };
    Result result;
    try {
        result = work(begin);
    } catch (const Error& error) {
        result.error = error.code() == ErrorCode::cancelled ? "" : error.what();
    } catch (const UsageError& error) {
        result.error = error.what();
    } catch (const CLI::ParseError& error) {
        result.error = error.what();
    } catch (const std::bad_alloc&) {
        result.error = name + ": there is not enough memory for it";
    } catch (const std::exception& error) {
        // An exception that left the thread would end the program.
        result.error = name + ": unexpected: " + error.what();
    }
    {
        const std::lock_guard lock(mutex_);
        if (stop.stop_requested()) return;
        stage_.reset();
        result_ = std::move(result);
    }
    wake();
}

}  // namespace rimline::tools
