# rimline_embed_shaders(TARGET shaders...): compiles GLSL to SPIR-V at build time and embeds it. For
# line.geom the target's sources can include "line_geom.h", which defines `const uint32_t line_geom[]`.
# The SPIR-V files are in the build folder of the target, where a test validates them.
find_program(RIMLINE_GLSLANG glslangValidator REQUIRED)

function(rimline_embed_shaders target)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/shaders)  # Targets of other folders may embed the same shader.
    file(MAKE_DIRECTORY ${folder})
    foreach(shader ${ARGN})
        string(REPLACE "." "_" name ${shader})
        set(compile ${RIMLINE_GLSLANG} --quiet -V --target-env vulkan1.3
            -I${PROJECT_SOURCE_DIR}/shaders ${PROJECT_SOURCE_DIR}/shaders/${shader})
        add_custom_command(
            OUTPUT ${folder}/${name}.h ${folder}/${shader}.spv
            COMMAND ${compile} --depfile ${folder}/${name}.d --vn ${name} -o ${folder}/${name}.h
            COMMAND ${compile} -o ${folder}/${shader}.spv
            DEPENDS ${PROJECT_SOURCE_DIR}/shaders/${shader}
            DEPFILE ${folder}/${name}.d
            COMMENT "Shader ${shader}"
            VERBATIM)
        target_sources(${target} PRIVATE ${folder}/${name}.h)
        list(APPEND spirv ${folder}/${shader}.spv)
    endforeach()
    target_include_directories(${target} PRIVATE ${folder})
    set_property(TARGET ${target} PROPERTY RIMLINE_SPIRV ${spirv})
endfunction()
