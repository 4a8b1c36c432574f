"""checking_cases.py PROGRAM: a test program fails where it checks nothing (tests/test_main.cpp).

PROGRAM is made of checking_cases.cpp.
"""
import subprocess
import sys


def check(status, said, *arguments):
    result = subprocess.run([sys.argv[1], *arguments], capture_output=True, text=True, timeout=60)
    assert result.returncode == status, (arguments, result.returncode, result.stdout)
    assert ("NOTHING CHECKED" in result.stdout) == bool(said), (arguments, result.stdout)
    assert said in result.stdout, (arguments, result.stdout)


check(0, "", "--test-case=checks something")
check(0, "", "--test-case=checks something in one of two parts")
check(1, "", "--test-case=checks something\\, which is wrong")
check(1, "a case without an assertion: checks nothing\n", "--test-case=checks nothing")
check(1, "a case without an assertion: checks nothing in two parts\n", "--test-case=checks nothing in two parts")
check(77, "", "--test-case=is skipped")
check(77, "", "--test-case=is skipped after a check")
check(1, "no case has this name\n", "--test-case=checks somethin")
# A skipped case does not excuse the next, and what CTest asks is no run.
check(1, "checks nothing\n", "--test-case=is skipped,checks nothing")
check(0, "", "--list-test-cases")
check(0, "", "--test-case=no such case", "--list-test-suites")
