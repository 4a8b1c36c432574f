/* Prints the sizes, offsets and numbers of rimline.h that programs are compiled with. */

#include <stddef.h>
#include <stdio.h>

#include "rimline.h"

#define SIZE(type) printf("size %s %u\n", #type, (unsigned)sizeof(type))
#define FIELD(type, field) printf("field %s.%s %u\n", #type, #field, (unsigned)offsetof(type, field))
#define NUMBER(name) printf("number %s %d\n", #name, (int)name)

int main(void) {
    NUMBER(RIMLINE_OK);
    NUMBER(RIMLINE_BAD_ARGUMENT);
    NUMBER(RIMLINE_BAD_INPUT);
    NUMBER(RIMLINE_NO_DEVICE);
    NUMBER(RIMLINE_DEVICE_LOST);
    NUMBER(RIMLINE_IO);
    NUMBER(RIMLINE_TOO_LARGE);
    NUMBER(RIMLINE_CANCELLED);
    NUMBER(RIMLINE_OUT_OF_MEMORY);
    NUMBER(RIMLINE_UNEXPECTED);
    NUMBER(RIMLINE_SILHOUETTE);
    NUMBER(RIMLINE_BORDER);
    NUMBER(RIMLINE_CREASE);
    NUMBER(RIMLINE_INTERSECTION);
    NUMBER(RIMLINE_SVG);
    NUMBER(RIMLINE_PDF);
    NUMBER(RIMLINE_DXF);
    SIZE(rimline_status);
    SIZE(rimline_line_kind);
    SIZE(rimline_drawing_format);
    SIZE(rimline_call);
    FIELD(rimline_call, struct_size);
    FIELD(rimline_call, progress);
    FIELD(rimline_call, user);
    SIZE(rimline_option);
    FIELD(rimline_option, name);
    FIELD(rimline_option, value);
    SIZE(rimline_point);
    FIELD(rimline_point, x);
    FIELD(rimline_point, y);
    FIELD(rimline_point, z);
    FIELD(rimline_point, is_direction);
    SIZE(rimline_mesh_info);
    FIELD(rimline_mesh_info, struct_size);
    FIELD(rimline_mesh_info, input_vertices);
    FIELD(rimline_mesh_info, vertices);
    FIELD(rimline_mesh_info, faces);
    FIELD(rimline_mesh_info, edges);
    FIELD(rimline_mesh_info, border_edges);
    FIELD(rimline_mesh_info, is_closed);
    FIELD(rimline_mesh_info, is_oriented);
    FIELD(rimline_mesh_info, center);
    FIELD(rimline_mesh_info, radius);
    SIZE(rimline_changes);
    FIELD(rimline_changes, struct_size);
    FIELD(rimline_changes, sequence);
    FIELD(rimline_changes, silhouette_count);
    FIELD(rimline_changes, flipped);
    FIELD(rimline_changes, flipped_count);
    FIELD(rimline_changes, added);
    FIELD(rimline_changes, added_count);
    FIELD(rimline_changes, removed);
    FIELD(rimline_changes, removed_count);
    FIELD(rimline_changes, slots);
    FIELD(rimline_changes, slot_count);
    FIELD(rimline_changes, words);
    FIELD(rimline_changes, word_count);
    SIZE(rimline_line);
    FIELD(rimline_line, struct_size);
    FIELD(rimline_line, kind);
    FIELD(rimline_line, is_hidden);
    FIELD(rimline_line, is_closed);
    FIELD(rimline_line, points);
    FIELD(rimline_line, point_count);
    SIZE(rimline_view);
    FIELD(rimline_view, eye);
    FIELD(rimline_view, score);
    FIELD(rimline_view, visible_ratio);
    return 0;
}
