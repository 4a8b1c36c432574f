# In place of the script of doctest_discover_tests(), with its variables. That one runs the program once for each case
# to learn its suite, which takes minutes under the address sanitizer. This one runs it once: its report in XML names
# the suites beside the cases.

execute_process(
    COMMAND ${TEST_EXECUTOR} "${TEST_EXECUTABLE}" --list-test-cases --reporters=xml
    OUTPUT_VARIABLE report
    RESULT_VARIABLE result
    WORKING_DIRECTORY "${TEST_WORKING_DIR}")
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${TEST_EXECUTABLE} does not list its cases: ${result}\n${report}")
endif()

# attribute(NAME ELEMENT VARIABLE): the value of an attribute of an XML element, empty if it is not there.
function(attribute name element variable)
    set(value)
    if(element MATCHES " ${name}=\"([^\"]*)\"")
        set(value "${CMAKE_MATCH_1}")
        string(REPLACE "&lt;" "<" value "${value}")
        string(REPLACE "&gt;" ">" value "${value}")
        string(REPLACE "&quot;" "\"" value "${value}")
        string(REPLACE "&amp;" "&" value "${value}")
    endif()
    set(${variable} "${value}" PARENT_SCOPE)
endfunction()

set(script)
string(REGEX MATCHALL "<TestCase [^\n]*" elements "${report}")
foreach(element IN LISTS elements)
    attribute(name "${element}" case)
    attribute(testsuite "${element}" suite)
    string(REPLACE "," "\\," filter "${case}")
    string(APPEND script
        "add_test([==[${TEST_PREFIX}${case}]==] [==[${TEST_EXECUTABLE}]==] [==[--test-case=${filter}]==])\n"
        "set_tests_properties([==[${TEST_PREFIX}${case}]==] PROPERTIES "
        "WORKING_DIRECTORY [==[${TEST_WORKING_DIR}]==]")
    foreach(property IN LISTS TEST_PROPERTIES)
        string(APPEND script " [==[${property}]==]")
    endforeach()
    if(suite)
        string(APPEND script " LABELS [==[${suite}]==]")
    endif()
    string(APPEND script ")\n")
endforeach()
file(WRITE "${CTEST_FILE}" "${script}")
