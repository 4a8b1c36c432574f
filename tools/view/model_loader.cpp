#include "tools/view/model_loader.h"

#include <CLI/Error.hpp>
#include <exception>
#include <new>
#include <utility>

namespace rimline::tools {

namespace {

// Least increase of progress that wakes the window.
constexpr double k_min_step = 0.01;

}  // namespace

ModelLoader::~ModelLoader() { cancel(); }

void ModelLoader::cancel() {
    if (thread_.joinable()) {
        thread_.request_stop();
        thread_.join();
    }
    const std::lock_guard lock(mutex_);
    stage_.reset();
    result_.reset();
}

void ModelLoader::open(CloudArgument argument) {
    cancel();
    stage_ = Stage{"opening " + argument.model, 0.0};
    thread_ = std::jthread([this, argument = std::move(argument)](std::stop_token stop) {
        load(std::move(stop), argument);
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

void ModelLoader::load(std::stop_token stop, const CloudArgument& argument) {
    const std::string& name = argument.model;
    const auto begin = [&](const std::string& task) {
        {
            const std::lock_guard lock(mutex_);
            stage_ = Stage{task, 0.0};
        }
        wake();
        return LongCall{stop, [this](double share) {
                            {
                                const std::lock_guard lock(mutex_);
                                if (share < stage_->share + k_min_step) return;
                                stage_->share = share;
                            }
                            wake();
                        }};
    };
    Result result;
    try {
        result.document = open_document(argument, begin);
    } catch (const Error& error) {
        result.error = error.code() == ErrorCode::cancelled ? "" : error.what();
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
        stage_.reset();
        if (!stop.stop_requested()) result_ = std::move(result);
    }
    wake();
}

}  // namespace rimline::tools
