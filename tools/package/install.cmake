# What `cmake --install` puts down beside the program: the libraries that were built, their headers
# under include/rimline/, and the package that find_package(Rimline) reads. Included last, when all
# targets are known.
include(CMakePackageConfigHelpers)

set(rimline_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Rimline)

install(TARGETS rimline_silhouette EXPORT RimlineTargets)
# Not the headers that only the library's own sources share.
install(DIRECTORY silhouette DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rimline
    FILES_MATCHING PATTERN "*.h"
    REGEX "/shapes/(circle|shape_makers|tube)\\.h$" EXCLUDE
    REGEX "/formats/(byte_scanner|file_format|gltf_[a-z]+|obj_scan|ply_body|ply_header|readers|source_file|text_scanner|tinygltf)\\.h$"
        EXCLUDE
    REGEX "/hough/(block_kernels|interleaved_bits|octree_order|reserved_bytes|rounded_float|v_sphere)\\.h$" EXCLUDE
    REGEX "/field/(field_kernels|field_sums|many_values|plane_clusters)\\.h$" EXCLUDE
    REGEX "/points/(border_(bend|chains|gaps|repair|tracing)|each_point|fan|neighbor_lists|neighborhood|open_point|point_order|robust_umbrellas|star_choice|supplement|thesis_fan|thesis_umbrellas)\\.h$" EXCLUDE
    REGEX "/[a-z_]+-inl\\.h$" EXCLUDE
    
    REGEX "/hough/service/latest_value\\.h$" EXCLUDE
    REGEX "/hough/baselines/(alias_table|brute_force_methods|cone_tree|dual_tree|edge_[a-z]+|followed_silhouette|gauss_map|instruction_set|octree_methods|packed_tree|plane_[a-z]+|quadric_tree|randomised|scaled_direction)\\.h$"
        EXCLUDE)
set(RIMLINE_HAS_ENGINE OFF)
if(TARGET rimline_engine)
    set(RIMLINE_HAS_ENGINE ON)
    install(TARGETS rimline_engine EXPORT RimlineTargets)
    # The engine's headers name the layouts they share with the shaders.
    install(DIRECTORY engine shaders DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rimline
        FILES_MATCHING PATTERN "*.h")
endif()

install(EXPORT RimlineTargets NAMESPACE rimline:: DESTINATION ${rimline_package_folder})
configure_package_config_file(tools/package/RimlineConfig.cmake.in ${PROJECT_BINARY_DIR}/RimlineConfig.cmake
    INSTALL_DESTINATION ${rimline_package_folder})
# Nothing is promised between 0.x versions.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/RimlineConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/RimlineConfig.cmake ${PROJECT_BINARY_DIR}/RimlineConfigVersion.cmake
    DESTINATION ${rimline_package_folder})
