#pragma once

// The models of a batch: files, folders and lists, in one order, and the part of them that a shard takes.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/command.h"

namespace rimline::tools {

struct BatchInput {
    std::string model;  ///< As commands take it.
    /// With `/`: within its folder; of a file that is named itself its path without root and `..`. {path} and
    /// shards are made of it.
    std::string name;

    std::string stem() const;  ///< Of the file, without folder and ending.
    std::string file() const;  ///< The same with its ending.
    std::string path() const;  ///< `name` without the ending.
    std::string ext() const;   ///< The ending without its dot. Empty for shapes.
};

/// One of `count` parts. A model is always in the same one, whatever other models there are.
struct Shard {
    std::uint32_t number = 1;  ///< From 1 to `count`.
    std::uint32_t count = 1;
    bool contains(const BatchInput& input) const noexcept;
};

/// `I/N`. Throws CLI::ValidationError.
Shard parse_shard(const std::string& text);

/// Of each source: a built-in shape, a model file, a folder with all models in it, its subfolders too, or @LIST, a text
/// file with one of these a line. Sorted by name within a folder; a file that occurs twice, by whatever path, counts
/// once. What is in the folder `outputs` is no model of a folder that holds it. What a list names, and what a folder
/// holds and cannot be read, is an input all the same: its subcommand says what is wrong. Throws Error{io} for a source
/// that does not exist, Error{cancelled}.
std::vector<BatchInput> find_batch_inputs(const std::vector<std::string>& sources,
                                          const std::string& outputs, const LongCall& call);

/// Equal for two names of one file or shape.
std::string place_of_model(const std::string& model);

/// 64-bit FNV-1a.
std::uint64_t fnv1a(const void* bytes, std::size_t size,
                    std::uint64_t hash = 0xcbf29ce484222325u) noexcept;

/// "fnv1a64:..." of the bytes of the file; of the name for a built-in shape. Throws Error{io}, Error{cancelled}.
std::string digest_of(const std::string& model, const LongCall& call);

}  // namespace rimline::tools
