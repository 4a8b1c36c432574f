# Debian packages, made by `cmake --build ... --target package`:
#
#   rimline           the program, its manual page, completion, desktop entry
#   librimline1       the shared library for C
#   librimline-dev    rimline.h, the C++ libraries, their headers and CMake package
#   python3-rimline   the Python package
#
# The last two and librimline1 hold what RIMLINE_C and RIMLINE_PYTHON build.
set(components program development)
if(TARGET rimline_c)
    list(APPEND components library)
endif()
if(TARGET rimline_python)
    list(APPEND components python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rimline)
set(CPACK_PACKAGE_CONTACT "Rimline <rimline@users.noreply.github.com>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

# Each package has its own, in place of the project's.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(rest "Silhouettes are found in an index over the planes of the mesh, and updated
by what changes while a camera or a light moves. Rimline draws ink lines,
strokes, vector drawings and shadow volumes.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME rimline)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "silhouettes of 3D models: found, kept up to date, drawn\n${rest}")
# The Vulkan loader is opened when a picture is drawn.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libvulkan1")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, python3-rimline")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME librimline1)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "silhouettes of 3D models - shared library for C\n${rest}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libvulkan1")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
    "${CMAKE_CURRENT_LIST_DIR}/shlibs;${CMAKE_CURRENT_LIST_DIR}/triggers")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME librimline-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "silhouettes of 3D models - headers and C++ libraries\n${rest}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libglm-dev, libhwy-dev, libjpeg62-turbo-dev, libpng-dev, libtbb-dev, libtinyobjloader-dev, libvulkan-dev")
if(TARGET rimline_c)
    string(PREPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "librimline1 (= ${PROJECT_VERSION}), ")
endif()

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-rimline)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "silhouettes of 3D models - Python 3 package\n${rest}")
if(TARGET rimline_python)
    execute_process(COMMAND ${RIMLINE_PYTHON_EXECUTABLE} -c
            "import sys; print('python3 (>= %d.%d), python3 (<< %d.%d)' % (sys.version_info[:2] + (sys.version_info[0], sys.version_info[1] + 1)))"
        OUTPUT_VARIABLE versions OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${versions}, python3-numpy, libvulkan1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-tqdm, python3-vtk9")
endif()

# Each package has its copyright and changelog.
set(changelog ${PROJECT_BINARY_DIR}/documents/changelog.gz)
add_custom_command(OUTPUT ${changelog}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/documents
    COMMAND gzip -9nc ${CMAKE_CURRENT_LIST_DIR}/changelog > ${changelog}
    DEPENDS ${CMAKE_CURRENT_LIST_DIR}/changelog)
add_custom_target(rimline_changelog ALL DEPENDS ${changelog})
foreach(component IN LISTS components)
    string(TOUPPER ${component} name)
    set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
    install(FILES ${CMAKE_CURRENT_LIST_DIR}/copyright ${changelog} DESTINATION ${folder} COMPONENT ${component})
endforeach()

include(CPack)
