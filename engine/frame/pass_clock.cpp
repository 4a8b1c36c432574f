#include "engine/frame/pass_clock.h"

#include <utility>

#include "silhouette/error.h"

namespace rimline {

PassClock::PassClock(const DeviceContext& context, std::uint32_t slots, bool is_on)
    : context_(context) {
    if (!is_on) return;
    unit_ = timestamp_unit(context);
    if (unit_.valid_bits > 0) slots_.resize(slots);
}

void PassClock::start(Commands commands, std::uint32_t slot, std::uint32_t pass_count) {
    if (slots_.empty()) return;
    current_ = slot;
    Slot& frame = slots_[slot];
    frame.names.clear();
    const std::uint32_t needed = pass_count + 2;  // Of start() and start_again().
    if (frame.query_count < needed) {
        frame.query_count = 0;
        frame.queries = QueryPool(context_, VK_QUERY_TYPE_TIMESTAMP, needed, "times of passes");
        frame.query_count = needed;
    }
    frame.queries.record_reset(commands);
    stamp(commands, {});
}

void PassClock::start_again(Commands commands) {
    if (!slots_.empty()) stamp(commands, {});
}

void PassClock::end_pass(Commands commands, const char* name, std::optional<std::size_t> light) {
    if (slots_.empty()) return;
    stamp(commands, light ? std::string(name) + ", light " + std::to_string(*light) : name);
}

void PassClock::stamp(Commands commands, std::string name) {
    Slot& frame = slots_[current_];
    RIMLINE_CHECK(frame.names.size() < frame.query_count);
    frame.names.push_back(std::move(name));
    commands->CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                 frame.queries.handle(),
                                 static_cast<std::uint32_t>(frame.names.size() - 1));
}

std::vector<PassTime> PassClock::take(std::uint32_t slot) {
    if (slots_.empty() || slots_[slot].names.empty()) return {};
    Slot& frame = slots_[slot];
    std::vector<std::uint64_t> ticks(frame.names.size());
    std::vector<PassTime> passes;
    if (frame.queries.read_if_there(ticks))
        for (std::size_t i = 1; i < ticks.size(); ++i)
            if (!frame.names[i].empty())
                passes.push_back({frame.names[i], unit_.elapsed_ms(ticks[i - 1], ticks[i])});
    frame.names.clear();
    return passes;
}

void PassClock::forget(std::uint32_t slot) noexcept {
    if (!slots_.empty()) slots_[slot].names.clear();
}

}  // namespace rimline
