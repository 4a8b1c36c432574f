/* Follows a camera around a model and writes a drawing: rimline.h in C.
 *
 *     silhouette MODEL DRAWING.svg
 */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "rimline.h"

/* The error is read after the call: arguments are evaluated in any order. */
static void stop_on(rimline_status status, rimline_error** error) {
    if (status == RIMLINE_OK) return;
    fprintf(stderr, "silhouette: %s\n", rimline_error_message(*error));
    rimline_error_free(*error);
    exit(1);
}

int main(int argc, char** argv) {
    rimline_error* error = NULL;
    rimline_mesh* mesh;
    rimline_mesh_info info = {sizeof info};
    rimline_tracker* tracker;
    rimline_changes changes = {sizeof changes};
    rimline_point eye = {0.0, 0.0, 0.0, 0};
    rimline_drawer* drawer;
    rimline_drawing* drawing;
    rimline_bytes* svg;
    char place[100];
    const rimline_option options[] = {{"eye", place}, {"hidden", "dashed"}, {"keep-coincident", NULL}};
    FILE* file;
    int frame;

    if (argc != 3) {
        fprintf(stderr, "usage: silhouette MODEL DRAWING.svg\n");
        return 2;
    }
    stop_on(rimline_mesh_load(argv[1], NULL, &mesh, &error), &error);
    stop_on(rimline_mesh_get_info(mesh, &info, &error), &error);

    eye.x = info.center[0] + 3.0 * info.radius;
    eye.y = info.center[1] + info.radius;
    eye.z = info.center[2];
    stop_on(rimline_tracker_create(mesh, &eye, NULL, &tracker, &error), &error);
    for (frame = 1; frame <= 10; ++frame) {
        eye.x = info.center[0] + 3.0 * info.radius * cos(0.01 * frame);
        eye.z = info.center[2] + 3.0 * info.radius * sin(0.01 * frame);
        stop_on(rimline_tracker_move(tracker, &eye, &changes, &error), &error);
        printf("frame %2d: %u edges, %u joined, %u left\n", frame, (unsigned)changes.silhouette_count,
               (unsigned)changes.added_count, (unsigned)changes.removed_count);
    }

    /* From where the camera is now. */
    snprintf(place, sizeof place, "%.9g,%.9g,%.9g", eye.x, eye.y, eye.z);
    stop_on(rimline_drawer_create(mesh, NULL, &drawer, &error), &error);
    stop_on(rimline_drawer_draw(drawer, options, 3, NULL, &drawing, &error), &error);
    stop_on(rimline_drawing_encode(drawing, RIMLINE_SVG, &svg, &error), &error);
    file = fopen(argv[2], "wb");
    if (file == NULL || fwrite(rimline_bytes_data(svg), 1, rimline_bytes_size(svg), file) != rimline_bytes_size(svg) ||
        fclose(file) != 0) {
        perror(argv[2]);
        return 1;
    }

    rimline_bytes_free(svg);
    rimline_drawing_free(drawing);
    rimline_drawer_free(drawer);
    rimline_tracker_free(tracker);
    rimline_mesh_free(mesh);
    return 0;
}
