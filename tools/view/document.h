#pragma once

// What the window shows: a model or a cloud.

#include <memory>
#include <string>
#include <vector>

#include "tools/view/cloud_document.h"
#include "tools/view/model_document.h"

namespace rimline::tools {

class Document {
public:
    /// Empty.
    Document() = default;
    Document(std::unique_ptr<ModelDocument> model) : model_(std::move(model)) {}
    Document(std::unique_ptr<CloudDocument> cloud) : cloud_(std::move(cloud)) {}

    /// At most one of the two is not null. Both are null in an empty document.
    ModelDocument* model() const noexcept { return model_.get(); }
    CloudDocument* cloud() const noexcept { return cloud_.get(); }
    explicit operator bool() const noexcept { return model_ || cloud_; }

    /// Not for an empty document.
    const std::string& name() const noexcept { return content().name(); }
    const std::vector<std::string>& warnings() const noexcept { return content().warnings(); }
    Subject subject() const { return content().subject(); }

private:
    const DocumentBase& content() const noexcept {
        if (model_) return *model_;
        return *cloud_;
    }

    std::unique_ptr<ModelDocument> model_;
    std::unique_ptr<CloudDocument> cloud_;
};

/// Opens a file or a built-in shape. The result is a cloud if `argument` has as_points or drop_bad, or if
/// the file has no faces; else a model. Throws what the constructors of both throw.
Document open_document(const CloudArgument& argument, const BeginCall& begin);

}  // namespace rimline::tools
