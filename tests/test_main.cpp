// The main program of all doctest tests. A run fails in which nothing was checked: where no case has the name that
// was asked for, or where a case ended without an assertion and did not say that it was skipped.

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstdio>

#include "tests/skip.h"

namespace {

bool g_is_any_skipped = false;
bool g_has_checked_nothing = false;

struct Guard final : doctest::IReporter {
    explicit Guard(const doctest::ContextOptions&) {}

    void test_case_start(const doctest::TestCaseData& data) override {
        name_ = data.m_name;
        rimline::tests::case_skipped = false;
    }
    void test_case_end(const doctest::CurrentTestCaseStats& stats) override {
        g_is_any_skipped |= rimline::tests::case_skipped;
        if (stats.numAssertsCurrentTest == 0 && !rimline::tests::case_skipped)
            report("a case without an assertion: ", name_);
    }
    void test_run_end(const doctest::TestRunStats& stats) override {
        if (stats.numTestCasesPassingFilters == 0) report("no case has this name", "");
    }

    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}

private:
    static void report(const char* what, const char* name) {
        std::printf("NOTHING CHECKED: %s%s\n", what, name);
        g_has_checked_nothing = true;
    }

    const char* name_ = "";
};

REGISTER_LISTENER("guard", 1, Guard);

}  // namespace

int main(int argc, char** argv) {
    const int status = doctest::Context(argc, argv).run();
    if (status == 0 && g_has_checked_nothing) return 1;
    if (status == 0 && g_is_any_skipped) return rimline::tests::k_skipped_status;
    return status;
}
