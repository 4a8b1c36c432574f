#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "tests/skip.h"

int main(int argc, char** argv) {
    const int status = doctest::Context(argc, argv).run();
    if (status == 0 && rimline::tests::case_skipped) return rimline::tests::k_skipped_status;
    return status;
}
