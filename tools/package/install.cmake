# What `cmake --install` copies beside the program: the libraries that were built, their public headers
# under include/rimline/, and the package that find_package(Rimline) reads. Included last, when all
# targets are known.
include(CMakePackageConfigHelpers)
include(${CMAKE_CURRENT_LIST_DIR}/public_headers.cmake)

set(rimline_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Rimline)

# rimline_install(TARGET HEADERS...): installs a library with these headers, named from the root.
function(rimline_install target)
    list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE headers)
    target_sources(${target}
        PUBLIC FILE_SET public_headers TYPE HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
    install(TARGETS ${target} EXPORT RimlineTargets ARCHIVE COMPONENT development
        FILE_SET public_headers DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rimline COMPONENT development)
endfunction()

rimline_install(rimline_silhouette ${rimline_silhouette_headers})
set(RIMLINE_HAS_ENGINE OFF)
if(TARGET rimline_engine)
    set(RIMLINE_HAS_ENGINE ON)
    rimline_install(rimline_engine ${rimline_engine_headers})
endif()

install(EXPORT RimlineTargets NAMESPACE rimline:: DESTINATION ${rimline_package_folder} COMPONENT development)
configure_package_config_file(tools/package/RimlineConfig.cmake.in ${PROJECT_BINARY_DIR}/RimlineConfig.cmake
    INSTALL_DESTINATION ${rimline_package_folder})
# 0.x versions are compatible only within a minor version.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/RimlineConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/RimlineConfig.cmake ${PROJECT_BINARY_DIR}/RimlineConfigVersion.cmake
    DESTINATION ${rimline_package_folder} COMPONENT development)

# The desktop's entry of the window, and the types of files that it opens.
if(TARGET rimline_view)
    install(FILES tools/package/io.github.rimline.Rimline.desktop
        DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)
    install(FILES tools/package/io.github.rimline.Rimline.metainfo.xml
        DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo COMPONENT program)
    install(FILES tools/package/io.github.rimline.Rimline.svg
        DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT program)
    install(FILES tools/package/rimline.xml
        DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT program)
endif()

include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
