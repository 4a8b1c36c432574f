#pragma once

// Where a scenario is played with faults, and how it is judged.
//
// A scenario is a function that calls the engine on a Stage, step by step, and shows what came of it:
//
//     RIMLINE_FAULT_SCENARIO("a picture of a model") {
//         const auto renderer = stage.make<Renderer>(stage.context(), k_plain);
//         stage.show(stage.step([&] { return renderer->render(stage.scene(), 32, 32); }).rgba);
//     }
//
// It becomes three test cases: call n of Vulkan fails, for every n; the device is lost at submit or wait
// n, for every n; allocation n of our own code fails, for every n. By default they take a sample of the
// n; each is tried by cases of the same names with the label `long`. A step that fails is made once more,
// and must then do; what is shown must be, bit for bit, what an undisturbed play shows; a lost device
// ends the play, and another on a new device must show it. No handle may be left, and the validation
// layer must have stayed silent.

#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/renderer.h"
#include "engine/tested_device.h"
#include "engine/vulkan/device_context.h"
#include "silhouette/hough/hough_octree.h"
#include "tests/engine/faults/failing_new.h"
#include "tests/engine/faults/vulkan_faults.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline::tests {

/// Models small enough to be drawn a thousand times.
struct FaultModels {
    FaultModels();
    Model knot, box, sheet;
};

class Stage {
public:
    Stage(const VulkanInstance& instance, const DeviceContext& context, const FaultModels& models)
        : instance_(instance), context_(context), models_(models) {}

    const VulkanInstance& instance() const noexcept { return instance_; }
    const DeviceContext& context() const noexcept { return context_; }
    const FaultModels& models() const noexcept { return models_; }
    /// A knot before a sheet with lines of another color, a light and a sun, in ink.
    Scene scene() const;

    /// The result of `call`, which is made again when an injected fault ended it.
    template <typename Call>
    auto step(Call&& call) -> decltype(call()) {
        try {
            const CountingNew counting;
            return call();
        } catch (const Error& error) {
            note(error);
            if (ends_with_device_ && error.code() == ErrorCode::device_lost) throw;
        } catch (const std::bad_alloc&) {
            note_bad_alloc();
        }
        return call();
    }

    /// The result of `call`, in which nothing fails: for what another scenario proves.
    template <typename Call>
    auto undisturbed(Call&& call) -> decltype(call()) {
        const NoFaults none;
        return call();
    }

    template <typename T, typename... Arguments>
    std::unique_ptr<T> make(const Arguments&... arguments) {
        return step([&] { return std::make_unique<T>(arguments...); });
    }

    /// Says that a lost device ends the scenario. Else the step is made again, with another device.
    void end_with_device() noexcept { ends_with_device_ = true; }

    /// Adds to what the scenario comes to.
    template <typename T>
    void show(const std::vector<T>& values) {
        const auto bytes = std::as_bytes(std::span(values));
        shown_.insert(shown_.end(), bytes.begin(), bytes.end());
    }

    const std::vector<std::byte>& shown() const noexcept { return shown_; }
    /// How many steps failed, and the codes they failed with.
    const std::vector<ErrorCode>& errors() const noexcept { return errors_; }
    int bad_allocs() const noexcept { return bad_allocs_; }

private:
    void note(const Error& error);
    void note_bad_alloc() { ++bad_allocs_; }

    const VulkanInstance& instance_;
    const DeviceContext& context_;
    const FaultModels& models_;
    std::vector<std::byte> shown_;
    std::vector<ErrorCode> errors_;
    int bad_allocs_ = 0;
    bool ends_with_device_ = false;
};

using Scenario = void (*)(Stage& stage);

/// How many of the faults are tried: a sample takes a few seconds, all take minutes.
enum class Extent { sample, all };

/// The bodies of a scenario's test cases.
void play_with_failures(Scenario scenario, Extent extent);
void play_with_lost_devices(Scenario scenario, Extent extent);
void play_with_failing_new(Scenario scenario, Extent extent);

}  // namespace rimline::tests

#define RIMLINE_FAULT_NAME_(line) fault_scenario_##line
#define RIMLINE_FAULT_NAME(line) RIMLINE_FAULT_NAME_(line)
#define RIMLINE_FAULT_CASE(sentence, play)                                                   \
    TEST_CASE(sentence) {                                                                    \
        rimline::tests::play(&RIMLINE_FAULT_NAME(__LINE__), rimline::tests::Extent::sample); \
    }                                                                                        \
    TEST_CASE(sentence " (each)" * doctest::test_suite("long")) {                            \
        rimline::tests::play(&RIMLINE_FAULT_NAME(__LINE__), rimline::tests::Extent::all);    \
    }
/// Defines a scenario and its test cases; the body sees `Stage& stage`.
#define RIMLINE_FAULT_SCENARIO(sentence)                                                 \
    static void RIMLINE_FAULT_NAME(__LINE__)(rimline::tests::Stage & stage);             \
    RIMLINE_FAULT_CASE(sentence ": whatever call of Vulkan fails", play_with_failures)   \
    RIMLINE_FAULT_CASE(sentence ": wherever the device is lost", play_with_lost_devices) \
    RIMLINE_FAULT_CASE(sentence ": whatever allocation fails", play_with_failing_new)    \
    static void RIMLINE_FAULT_NAME(__LINE__)(rimline::tests::Stage & stage)
