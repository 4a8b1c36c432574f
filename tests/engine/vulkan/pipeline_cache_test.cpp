#include "engine/vulkan/pipeline_cache.h"

#include <doctest/doctest.h>

#include <cstring>
#include <fstream>
#include <random>

#include "engine/vulkan/functions.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/tools/scratch_folder.h"

namespace rimline {
namespace {

std::vector<std::byte> bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<std::byte> bytes(std::filesystem::file_size(path));
    file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
    return bytes;
}

void write(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

VkPhysicalDeviceProperties made_up_device() {
    VkPhysicalDeviceProperties device{.vendorID = 7, .deviceID = 11};
    for (std::uint8_t i = 0; i < VK_UUID_SIZE; ++i) device.pipelineCacheUUID[i] = 3 * i;
    return device;
}

std::vector<std::byte> data_of(const VkPhysicalDeviceProperties& device) {
    VkPipelineCacheHeaderVersionOne header{.headerSize = sizeof header,
                                           .headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE,
                                           .vendorID = device.vendorID,
                                           .deviceID = device.deviceID};
    std::memcpy(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE);
    std::vector<std::byte> data(sizeof header + 100, std::byte{42});
    std::memcpy(data.data(), &header, sizeof header);
    return data;
}

TEST_CASE("a cache file gives back what the driver gave") {
    const VkPhysicalDeviceProperties device = made_up_device();
    const std::vector<std::byte> data = data_of(device);
    const std::vector<std::byte> file = pipeline_file_of(data);
    CHECK(std::ranges::equal(driver_data_of(file, device), data));
}

TEST_CASE("a cache file of another device or driver gives nothing") {
    const std::vector<std::byte> file = pipeline_file_of(data_of(made_up_device()));
    VkPhysicalDeviceProperties other = made_up_device();
    ++other.deviceID;
    CHECK(driver_data_of(file, other).empty());
    other = made_up_device();
    ++other.vendorID;
    CHECK(driver_data_of(file, other).empty());
    other = made_up_device();
    ++other.pipelineCacheUUID[15];
    CHECK(driver_data_of(file, other).empty());
}

TEST_CASE("a damaged cache file gives nothing, whichever byte is wrong or missing") {
    const VkPhysicalDeviceProperties device = made_up_device();
    const std::vector<std::byte> file = pipeline_file_of(data_of(device));
    for (std::size_t i = 0; i < file.size(); ++i) {
        CAPTURE(i);
        CHECK(driver_data_of(std::span(file).first(i), device).empty());
        std::vector<std::byte> damaged = file;
        damaged[i] ^= std::byte{16};
        CHECK(driver_data_of(damaged, device).empty());
    }
    std::vector<std::byte> longer = file;
    longer.push_back({});
    CHECK(driver_data_of(longer, device).empty());
}

TEST_CASE("a device keeps its pipelines in a folder, and replaces a file that is of no use") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::ScratchFolder scratch;
    const std::filesystem::path folder = scratch / "new" / "folder";
    const auto open = [&] {
        const TestedDevice device(gpu->instance(), tests::requested_device(), folder);
        CHECK(device.context().pipeline_cache != VK_NULL_HANDLE);
        CHECK(device.face_bits_agree());
    };
    open();
    REQUIRE(std::filesystem::exists(folder));
    const auto only_file = [&] {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            files.push_back(entry.path());
        REQUIRE(files.size() == 1);
        return files.front();
    };
    const std::vector<std::byte> first = bytes_of(only_file());
    VkPhysicalDeviceProperties properties;
    gpu->context().vk->GetPhysicalDeviceProperties(gpu->context().physical_device, &properties);
    CHECK_FALSE(driver_data_of(first, properties).empty());

    const auto written = std::filesystem::last_write_time(only_file());
    open();
    // All that is there was there before.
    CHECK(std::filesystem::last_write_time(only_file()) == written);

    std::vector<std::byte> damaged = first;
    damaged.at(damaged.size() - 1) ^= std::byte{1};
    for (const std::vector<std::byte>& content : {damaged, std::vector<std::byte>{}}) {
        write(only_file(), content);
        open();
        CHECK_FALSE(driver_data_of(bytes_of(only_file()), properties).empty());
    }
}

TEST_CASE("a cache folder that cannot be made is no error") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::ScratchFolder scratch;
    const std::filesystem::path file = scratch / "file";
    write(file, {});
    const TestedDevice device(gpu->instance(), tests::requested_device(), file / "folder");
    CHECK(device.context().pipeline_cache != VK_NULL_HANDLE);
}

}  // namespace
}  // namespace rimline
