#pragma once

// All silhouette methods (method_info.h) on one model, in four tables: extraction and updates, for viewpoints
// and for directions. A method that is not exact has a recall, the share of the silhouette that it finds.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/contenders.h"
#include "tools/command.h"

namespace rimline::tools {

struct MethodsOptions {
    std::uint32_t viewpoints = 300;  ///< And as many directions.
    std::uint32_t frames = 720;      ///< Of each turn by half a degree a frame.
    std::uint32_t rounds = 5;
};

struct MethodTable {
    std::string name;
    std::vector<Times> methods;   ///< In the order of method_info.h, the octree first.
    std::vector<double> recalls;  ///< One a method; 1 for exact methods.
};

struct MethodsResult {
    std::string model;
    std::uint32_t faces = 0;
    struct Build {
        std::string method;
        double ms;
    };
    std::vector<Build> builds;  ///< One construction of each method.
    std::vector<MethodTable> tables;
    std::string difference{};  ///< The first from brute force; nothing is timed then.
};

MethodsResult bench_methods(const std::string& model, const Mesh& mesh,
                            const MethodsOptions& options, const Context& context);

void print_result(const MethodsResult& result);
nlohmann::ordered_json to_json(const MethodsResult& result);

}  // namespace rimline::tools
