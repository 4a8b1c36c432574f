#pragma once

// What the two kinds of documents share: a name, a fixed address, and parts that are computed one after
// another while the window shows progress.

#include <string>
#include <utility>
#include <vector>

#include "engine/view_defaults.h"
#include "tools/options/model_argument.h"

namespace rimline::tools {

class DocumentBase {
public:
    virtual ~DocumentBase() = default;
    DocumentBase(const DocumentBase&) = delete;
    DocumentBase& operator=(const DocumentBase&) = delete;

    /// The file or shape:NAME[:FACES] that was opened.
    const std::string& name() const noexcept { return name_; }
    /// Of the file's reader (MeshSource::warnings).
    const std::vector<std::string>& warnings() const noexcept { return warnings_; }
    /// What a camera is fitted to. It holds a span of positions: the document must outlive it.
    virtual Subject subject() const = 0;

protected:
    explicit DocumentBase(std::string name, std::vector<std::string> warnings = {})
        : name_(std::move(name)), warnings_(std::move(warnings)) {}

    /// Returns make(begin(task)). Errors of `make` name the document.
    template <typename Make>
    auto make_part(const BeginCall& begin, const std::string& task, Make&& make) const {
        return about_model(name_, [&] { return make(begin(task)); });
    }

private:
    std::string name_;
    std::vector<std::string> warnings_;
};

}  // namespace rimline::tools
