#include <nlohmann/json.hpp>

#include "tools/commands/literal_origins.h"

namespace rimline::tools {

std::string difference_of(std::span<const LiteralTrial> trials) {
    for (const LiteralTrial& trial : trials)
        if (trial.is_complete && trial.differing > 0)
            return "octrees of the thesis, " + std::string(trial.culling) + ", " + trial.listing;
    return {};
}

nlohmann::ordered_json to_json(std::span<const LiteralTrial> trials) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const LiteralTrial& trial : trials)
        list.push_back({{"culling", trial.culling},
                        {"listing", trial.listing},
                        {"tree_edges", trial.tree_edges},
                        {"listed_edges", trial.listed_edges},
                        {"pbv_checks", trial.pbv_checks},
                        {"ebv_checks", trial.ebv_checks},
                        {"box_checks", trial.box_checks()},
                        {"edge_checks", trial.edge_checks},
                        {"face_checks", trial.face_checks},
                        {"missed_edges", trial.missed_edges},
                        {"repeated_edges", trial.repeated_edges}});
    return list;
}

}  // namespace rimline::tools
