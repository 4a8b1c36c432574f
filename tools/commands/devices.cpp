// rimline devices: the Vulkan devices, and why each is or is not chosen.

#include <CLI/App.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_instance.h"
#include "tools/command.h"
#include "tools/options/option_types.h"

namespace rimline::tools {

namespace {

std::string version_text(std::uint32_t version) {
    return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(version));
}

class DevicesCommand final : public Command {
public:
    std::string name() const override { return "devices"; }
    std::string summary() const override {
        return "List the Vulkan devices and why each is chosen or not";
    }

    void add_options(CLI::App& app) override {
        add_device(app, request_,
                   "gpu, cpu, an index or a name: show which device this request chooses in "
                   "other subcommands");
        app.footer(
            "Examples:\n"
            "  rimline devices\n"
            "  rimline devices --device gpu --json");
    }

    ExitStatus run(const Context& context) override {
        const VulkanInstance instance;
        const std::vector<DeviceFacts> devices = describe_devices(instance);
        // Throws if no device is suitable. The message names what each device lacks.
        const DeviceChoice choice = choose_device(devices, request_);
        if (context.json)
            print_result(devices, choice);
        else
            print_summary(devices, choice);
        return ExitStatus::success;
    }

private:
    static void print_result(const std::vector<DeviceFacts>& devices, const DeviceChoice& choice) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (std::size_t i = 0; i < devices.size(); ++i) {
            const DeviceVerdict verdict = judge_device(devices[i]);
            list.push_back({{"index", i},
                            {"name", devices[i].name},
                            {"type", name_of(devices[i].type)},
                            {"driver", devices[i].driver},
                            {"vulkan", version_text(devices[i].api_version)},
                            {"usable", verdict.usable()},
                            {"lacks", verdict.lacks},
                            {"chosen", i == choice.index},
                            {"reason", choice.reasons[i]}});
        }
        print_json({{"devices", std::move(list)}});
    }

    static void print_summary(const std::vector<DeviceFacts>& devices, const DeviceChoice& choice) {
        for (std::size_t i = 0; i < devices.size(); ++i) {
            std::printf("%zu  %s\n", i, choice.reasons[i].c_str());
            std::printf("     Vulkan %s, %s\n", version_text(devices[i].api_version).c_str(),
                        devices[i].driver.c_str());
        }
    }

    std::string request_;
};

}  // namespace

std::unique_ptr<Command> make_devices_command() { return std::make_unique<DevicesCommand>(); }

}  // namespace rimline::tools
