# cmake -DCLANG_FORMAT=PATH -P formatted.cmake, from the root: fails where clang-format would change a
# source, and names it.
if(NOT CLANG_FORMAT)
    message("SKIPPED: no clang-format-14")
    return()
endif()
file(GLOB_RECURSE sources silhouette/*.h silhouette/*.cpp engine/*.h engine/*.cpp shaders/*.h
    tools/*.h tools/*.cpp tests/*.h tests/*.cpp)
execute_process(COMMAND ${CLANG_FORMAT} --dry-run --Werror ${sources} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "run clang-format -i on the files named above")
endif()
