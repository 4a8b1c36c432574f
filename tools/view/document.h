#pragma once

// What the window shows: a model, or a cloud.

#include <memory>
#include <string>

#include "tools/view/cloud_document.h"
#include "tools/view/model_document.h"

namespace rimline::tools {

class Document {
public:
    Document() = default;
    Document(std::unique_ptr<ModelDocument> model) : model_(std::move(model)) {}
    Document(std::unique_ptr<CloudDocument> cloud) : cloud_(std::move(cloud)) {}

    /// One of the two, the other null; both are before anything is shown.
    ModelDocument* model() const noexcept { return model_.get(); }
    CloudDocument* cloud() const noexcept { return cloud_.get(); }
    explicit operator bool() const noexcept { return model_ || cloud_; }

    const std::string& name() const noexcept { return model_ ? model_->name() : cloud_->name(); }
    Subject subject() const { return model_ ? Subject(model_->mesh()) : cloud_->subject(); }

private:
    std::unique_ptr<ModelDocument> model_;
    std::unique_ptr<CloudDocument> cloud_;
};

/// Opens the file or shape: as a cloud where that is asked for, where bad points are to be dropped, or where
/// it has no faces; else as a model. Throws what their constructors throw.
Document open_named(const CloudArgument& named, const BeginCall& begin);

}  // namespace rimline::tools
