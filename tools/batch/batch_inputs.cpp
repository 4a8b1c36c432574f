#include "tools/batch/batch_inputs.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>

#include "tools/options/model_argument.h"

namespace rimline::tools {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view k_byte_order_mark = "\xef\xbb\xbf";

class InputFinder {
public:
    InputFinder(const std::string& outputs, const LongCall& call) : call_(call) {
        std::error_code unreadable;
        outputs_ = fs::weakly_canonical(outputs, unreadable);
    }

    void add(const std::string& source) {
        if (source.starts_with('@')) return add_list(source.substr(1));
        try {
            check_model_name(source);
        } catch (const CLI::ValidationError& error) {
            throw UsageError(error.what());
        }
        std::error_code unreadable;
        if (!is_built_in_shape(source) && !fs::exists(fs::status(source, unreadable)))
            throw Error(ErrorCode::io, source + ": cannot read: there is no such file or folder");
        add_named(source);
    }

    std::vector<BatchInput> inputs;

private:
    // What does not exist is taken, too, as a file or as a shape: it fails alone.
    void add_named(const std::string& source) {
        if (is_built_in_shape(source)) {
            std::string name = source;
            std::ranges::replace(name, ':', '_');
            return take(source, name);
        }
        std::error_code unreadable;
        if (!fs::is_directory(source, unreadable)) return take(source, name_of(source));
        add_folder(source);
    }

    // The path without a root and without steps upwards.
    static std::string name_of(const std::string& file) {
        fs::path name;
        for (const fs::path& part : fs::path(file).lexically_normal().relative_path())
            if (part != "..") name /= part;
        return name.generic_string();
    }

    // The same files by the same names whatever order the system lists them in: all folders before links to folders,
    // which may lead to the same ones, and back.
    void add_folder(const std::string& folder) {
        std::set<fs::path> entered;
        std::vector<fs::path> files, folders{folder};
        while (!folders.empty()) {
            std::vector<fs::path> links;
            for (const fs::path& start : folders) walk(start, entered, files, links);
            std::ranges::sort(links);
            folders = std::move(links);
        }
        std::ranges::sort(files);
        for (const fs::path& file : files)
            take(file.string(), file.lexically_relative(folder).generic_string());
    }

    // As ._model.obj, in which macOS keeps what other file systems cannot of model.obj, and .git.
    static bool is_hidden(const fs::path& path) {
        return path.filename().native().starts_with('.');
    }

    // Finds the models below a folder, and the links to folders there, which are not followed.
    void walk(const fs::path& folder, std::set<fs::path>& entered, std::vector<fs::path>& files,
              std::vector<fs::path>& links) {
        std::vector<fs::path> folders{folder};
        while (!folders.empty()) {
            const fs::path next = std::move(folders.back());
            folders.pop_back();
            std::error_code error, unreadable;
            const fs::path place = fs::weakly_canonical(next, unreadable);
            if (!entered.insert(place).second || (place == outputs_ && entered.size() > 1))
                continue;
            fs::directory_iterator entry(next, error);
            for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
                call_.checkpoint(0.0);
                if (is_hidden(entry->path())) continue;
                if (entry->is_directory(unreadable))
                    (entry->is_symlink(unreadable) ? links : folders).push_back(entry->path());
                else if (is_model_file_name(entry->path()) &&
                         (entry->is_regular_file(unreadable) || !entry->exists(unreadable)))
                    files.push_back(entry->path());
            }
            if (error) files.push_back(next);
        }
    }

    void add_list(const std::string& name) {
        std::error_code unreadable;
        if (fs::is_directory(name, unreadable))
            throw Error(ErrorCode::io, name + ": this is a folder, no list: name it without the @");
        std::ifstream list(name);
        if (!list) throw Error(ErrorCode::io, name + ": cannot read: there is no such list");
        std::string line;
        for (std::uint64_t number = 1; std::getline(list, line); ++number) {
            call_.checkpoint(0.0);
            if (number == 1 && line.starts_with(k_byte_order_mark))
                line.erase(0, k_byte_order_mark.size());
            if (line.ends_with('\r')) line.pop_back();
            if (line.empty() || line.starts_with('#')) continue;
            if (line.starts_with('@'))
                throw Error(ErrorCode::bad_input, name + ":" + std::to_string(number) +
                                                      ": a list in a list: name models here");
            add_named(line);
        }
        if (list.bad()) throw Error(ErrorCode::io, name + ": cannot read");
    }

    void take(const std::string& model, const std::string& name) {
        if (known_.insert(place_of_model(model)).second) inputs.push_back({model, name});
    }

    const LongCall& call_;
    fs::path outputs_;
    std::set<std::string> known_;
};

}  // namespace

std::string place_of_model(const std::string& model) {
    std::error_code unreadable;
    return is_built_in_shape(model) ? model : fs::weakly_canonical(model, unreadable).string();
}

std::string BatchInput::stem() const { return fs::path(name).stem().string(); }
std::string BatchInput::file() const { return fs::path(name).filename().string(); }
std::string BatchInput::path() const { return fs::path(name).replace_extension().generic_string(); }

std::string BatchInput::ext() const {
    const std::string ending = fs::path(name).extension().string();
    return ending.empty() ? ending : ending.substr(1);
}

bool Shard::contains(const BatchInput& input) const noexcept {
    return fnv1a(input.name.data(), input.name.size()) % count == number - 1;
}

Shard parse_shard(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
        const auto count = std::from_chars(number.ptr + 1, end, shard.count);
        if (count.ec == std::errc() && count.ptr == end && shard.number >= 1 &&
            shard.number <= shard.count)
            return shard;
    }
    throw CLI::ValidationError("--shard", "expected I/N with I from 1 to N, not '" + text + "'");
}

std::vector<BatchInput> find_batch_inputs(const std::vector<std::string>& sources,
                                          const std::string& outputs, const LongCall& call) {
    InputFinder finder(outputs, call);
    for (const std::string& source : sources) finder.add(source);
    return std::move(finder.inputs);
}

std::uint64_t fnv1a(const void* bytes, std::size_t size, std::uint64_t hash) noexcept {
    const auto* byte = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ byte[i]) * 0x100000001b3u;
    return hash;
}

std::string digest_of(const std::string& model, const LongCall& call) {
    std::uint64_t hash = fnv1a("", 0);
    if (is_built_in_shape(model)) {
        hash = fnv1a(model.data(), model.size());
    } else {
        std::error_code unreadable;
        const fs::file_status status = fs::status(model, unreadable);
        if (fs::exists(status) && !fs::is_regular_file(status))  // It may never end, or begin.
            throw FileError(model, "is not a regular file; copy its contents to one");
        std::ifstream file(model, std::ios::binary);
        if (!file) throw Error(ErrorCode::io, model + ": cannot read");
        std::array<char, 1 << 16> buffer;
        while (file.read(buffer.data(), buffer.size()), file.gcount() > 0) {
            call.checkpoint(0.0);
            hash = fnv1a(buffer.data(), static_cast<std::size_t>(file.gcount()), hash);
        }
        if (file.bad()) throw Error(ErrorCode::io, model + ": cannot read");
    }
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
    return "fnv1a64:" + std::string(digits.data());
}

}  // namespace rimline::tools
