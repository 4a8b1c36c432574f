#include "silhouette/methods/alias_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "silhouette/error.h"

namespace rimline {

AliasTable::AliasTable(std::span<const double> weights) : columns_(weights.size()) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> height(weights.size());  // 1 is a full column.
    std::vector<std::uint32_t> low;
    std::vector<std::uint32_t> high;
    for (std::uint32_t i = 0; i < weights.size(); ++i) {
        RIMLINE_CHECK(weights[i] > 0.0 && std::isfinite(sum));
        height[i] = weights[i] / sum * static_cast<double>(weights.size());
        (height[i] < 1.0 ? low : high).push_back(i);
        columns_[i] = {0xffffffffu, i};
    }
    // A low column is filled from a high one, which may be low afterwards. Columns that rounding leaves in
    // either list are full.
    while (!low.empty() && !high.empty()) {
        const std::uint32_t i = low.back();
        const std::uint32_t j = high.back();
        low.pop_back();
        columns_[i] = {static_cast<std::uint32_t>(height[i] * 0x1p32), j};
        height[j] -= 1.0 - height[i];
        if (height[j] >= 1.0) continue;
        high.pop_back();
        low.push_back(j);
    }
}

}  // namespace rimline
