#include "tools/run_times.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

namespace rimline::tools {
namespace {

TEST_CASE("the table has each step and the sum") {
    RunTimes times(RunTimes::Clock::now() - std::chrono::milliseconds(500));
    times.end("reading");
    const std::string table = times.table();
    CHECK(table.starts_with("  reading "));
    CHECK(table.find("0.50") != std::string::npos);
    CHECK(table.find("\n  in all ") != std::string::npos);
    CHECK(table.ends_with(" s\n"));
}

TEST_CASE("the steps of a run add up to the time since it began") {
    const auto started = RunTimes::Clock::now() - std::chrono::milliseconds(250);
    RunTimes times(started);
    times.end("reading");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    times.end("drawing");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    times.end("writing");
    times.end("drawing");
    const nlohmann::ordered_json json = times.json();
    CHECK(json.size() == 4);
    CHECK(json["reading"].get<double>() >= 250.0);
    CHECK(json["drawing"].get<double>() >= 20.0);
    CHECK(json["writing"].get<double>() >= 20.0);
    const double sum = json["reading"].get<double>() + json["drawing"].get<double>() +
                       json["writing"].get<double>();
    CHECK(std::abs(sum - json["total"].get<double>()) < 1e-6);
    const double clock_ms =
        std::chrono::duration<double, std::milli>(RunTimes::Clock::now() - started).count();
    CHECK(times.total_ms() <= clock_ms);
    CHECK(times.total_ms() > clock_ms - 100.0);
}

TEST_CASE("the sentence leaves out what takes no time") {
    RunTimes times(RunTimes::Clock::now() - std::chrono::milliseconds(500));
    times.end("reading");
    times.end("index");
    const std::string sentence = times.sentence();
    CHECK(sentence.find(" s: reading 0.5") != std::string::npos);
    CHECK(sentence.find("index") == std::string::npos);
    CHECK(RunTimes(RunTimes::Clock::now()).sentence() == "0.00 s");
}

}  // namespace
}  // namespace rimline::tools
