/** @file
 * Rimline for C, and for languages that call C.
 *
 * Objects are handles: a function that makes one says which function frees it. Arrays that a struct points to belong to
 * the object that filled it, and are valid as long as the comment there says. No function throws, and none ends the
 * program for a wrong argument: each that can fail returns a status, and describes the failure in `*error` if `error`
 * is not NULL; the caller frees it. Null handles are a RIMLINE_BAD_ARGUMENT, and may be freed.
 *
 * Structs that a later version may extend begin with `struct_size`: set it to sizeof before the call. Fields that the
 * library does not know are left alone, and fields that the caller does not know are not written.
 *
 * Threads: meshes may be used by any number of threads at a time. Threads that share a drawer or a renderer take turns.
 * Everything else is used by one thread at a time: threads that share a tracker lock it themselves, because its arrays
 * are those of the last move.
 *
 * Vertices are numbered as in the input, from 0; of equal positions the first stands for all. Edges are numbered by
 * the mesh (rimline_mesh_edge_vertices). Coordinates are within 2^60.
 */
#ifndef RIMLINE_H
#define RIMLINE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(_WIN32)
#define RIMLINE_API
#else
#define RIMLINE_API __attribute__((visibility("default")))
#endif

/** The version of the library that runs, "0.1.0". */
RIMLINE_API const char* rimline_version(void);

/* Failures. */

typedef enum rimline_status {
    RIMLINE_OK = 0,
    RIMLINE_BAD_ARGUMENT = 1, /**< An argument or an option is wrong. */
    RIMLINE_BAD_INPUT =
        2, /**< A file or value is wrong. The message names the file and the place. */
    RIMLINE_NO_DEVICE = 3,   /**< No Vulkan device is suitable. */
    RIMLINE_DEVICE_LOST = 4, /**< The GPU stopped. Free the renderer. */
    RIMLINE_IO = 5,          /**< The system could not read or write. */
    RIMLINE_TOO_LARGE = 6,   /**< A limit of the machine or of a format is exceeded. */
    RIMLINE_CANCELLED = 7,   /**< The progress function ended the call. */
    RIMLINE_OUT_OF_MEMORY = 8,
    RIMLINE_UNEXPECTED = 9
} rimline_status;

typedef struct rimline_error rimline_error;
RIMLINE_API rimline_status rimline_error_status(const rimline_error* error);
/** UTF-8, valid until the error is freed. */
RIMLINE_API const char* rimline_error_message(const rimline_error* error);
RIMLINE_API void rimline_error_free(rimline_error* error);

/* Long calls. */

/** Receives the finished share, 0 to 1, on the thread of the call. It never decreases. Returns 0 to go on. Between
 * two reports of a mesh of 300,000 faces lies a tenth of a second, or a second where views are chosen or a device draws;
 * of millions of faces, several seconds. Calls that it
 * makes with the drawer or renderer of the call, or that need what the call makes for its mesh, fail with
 * RIMLINE_BAD_ARGUMENT. */
typedef int (*rimline_progress_function)(double share, void* user);

/** NULL in place of a call: no progress, no end but the call's own. */
typedef struct rimline_call {
    size_t struct_size;
    rimline_progress_function progress;
    void* user;
} rimline_call;

/** An option of `rimline draw` or `rimline render`, without its dashes: {"style", "toon"}, {"eye", "1,2,3"}. A flag has
 * the value NULL: {"ground", NULL}. */
typedef struct rimline_option {
    const char* name;
    const char* value;
} rimline_option;

/* Silhouette points. */

typedef struct rimline_point {
    double x, y, z;
    int is_direction; /**< 0: a viewpoint. Else the direction towards the viewer, not zero. */
} rimline_point;

/* Bytes and numbers that the library made. */

typedef struct rimline_bytes rimline_bytes;
RIMLINE_API const void* rimline_bytes_data(const rimline_bytes* bytes);
RIMLINE_API size_t rimline_bytes_size(const rimline_bytes* bytes);
RIMLINE_API void rimline_bytes_free(rimline_bytes* bytes);

/* Meshes. */

typedef struct rimline_mesh rimline_mesh;

/** Reads OBJ, PLY, STL, OFF, glTF or GLB, or makes a built-in shape ("shape:knot:5000"). `path` is UTF-8. */
RIMLINE_API rimline_status rimline_mesh_load(const char* path, const rimline_call* call,
                                             rimline_mesh** mesh, rimline_error** error);
/** `positions`: 3 * vertex_count finite numbers. `corners`: 3 * face_count vertices, counter-clockwise from outside.
 * Both are copied. */
RIMLINE_API rimline_status rimline_mesh_create(const float* positions, size_t vertex_count,
                                               const uint32_t* corners, size_t face_count,
                                               const rimline_call* call, rimline_mesh** mesh,
                                               rimline_error** error);
/** What was left out or lost in reading or making the mesh, in UTF-8: the first message has index 0. NULL from their
 * number on. They belong to the mesh. */
RIMLINE_API const char* rimline_mesh_warning(const rimline_mesh* mesh, size_t index);
RIMLINE_API void rimline_mesh_free(rimline_mesh* mesh);

typedef struct rimline_mesh_info {
    size_t struct_size;
    uint64_t input_vertices; /**< With unused ones. */
    uint64_t vertices;       /**< Used ones; equal positions are one. */
    uint64_t faces;
    uint64_t edges;
    uint64_t border_edges; /**< Of one face. They are in no silhouette. */
    int is_closed;         /**< Every edge has an even number of faces. */
    int is_oriented;       /**< No edge has two faces that traverse it in the same direction. */
    double center[3];      /**< Of the bounding box of the used vertices. */
    double radius;         /**< The greatest distance from there to one. */
} rimline_mesh_info;

RIMLINE_API rimline_status rimline_mesh_get_info(const rimline_mesh* mesh, rimline_mesh_info* info,
                                                 rimline_error** error);
/** Where the vertices lie, with unused ones: 3 numbers each, valid until the mesh is freed. */
RIMLINE_API rimline_status rimline_mesh_positions(const rimline_mesh* mesh, const float** positions,
                                                  size_t* vertex_count, rimline_error** error);
/** Writes the three vertices of each of `count` faces to `vertices`, 3 * count numbers, counter-clockwise from outside; of
 * equal positions the first vertex. */
RIMLINE_API rimline_status rimline_mesh_face_vertices(const rimline_mesh* mesh,
                                                      const uint32_t* faces, size_t count,
                                                      uint32_t* vertices, rimline_error** error);
/** Writes the two vertices of each of `count` edges to `vertices`, 2 * count numbers. */
RIMLINE_API rimline_status rimline_mesh_edge_vertices(const rimline_mesh* mesh,
                                                      const uint32_t* edges, size_t count,
                                                      uint32_t* vertices, rimline_error** error);
/** The silhouette from a point: its edges as uint32_t in `*edges`, ascending. Tests all faces; for a point that moves
 * take a tracker. */
RIMLINE_API rimline_status rimline_mesh_silhouette(const rimline_mesh* mesh,
                                                   const rimline_point* point,
                                                   rimline_bytes** edges, rimline_error** error);

/* Trackers: the silhouette of a mesh from a point that moves. */

typedef struct rimline_tracker rimline_tracker;

/** What changed. The arrays are valid until the tracker moves again or is freed. */
typedef struct rimline_changes {
    size_t struct_size;
    uint64_t sequence;         /**< One more than that of the change before. */
    uint64_t silhouette_count; /**< Edges of the silhouette after the change: the slots in use. */
    const uint32_t* flipped;   /**< Faces that turned. */
    size_t flipped_count;
    const uint32_t* added; /**< Edges that joined the silhouette. */
    size_t added_count;
    const uint32_t* removed; /**< Edges that left it. */
    size_t removed_count;
    /** Pairs: a slot, and its new edge. A buffer has room for all slots if it is as long as the mesh has edges; the first
     * silhouette_count are in use. */
    const uint32_t* slots;
    size_t slot_count;
    const uint32_t*
        words; /**< Pairs: a word of face bits, and its new bits. Face f is bit f % 32 of word f / 32. */
    size_t word_count;
} rimline_changes;

/** The mesh may be freed before the tracker. */
RIMLINE_API rimline_status rimline_tracker_create(const rimline_mesh* mesh,
                                                  const rimline_point* point,
                                                  const rimline_call* call,
                                                  rimline_tracker** tracker, rimline_error** error);
RIMLINE_API void rimline_tracker_free(rimline_tracker* tracker);
/** Moves the tracker. Allocates nothing. `changes` may be NULL. */
RIMLINE_API rimline_status rimline_tracker_move(rimline_tracker* tracker,
                                                const rimline_point* point,
                                                rimline_changes* changes, rimline_error** error);
/** The edges of the silhouette, in the order of slots; valid until the tracker moves or is freed. A copy that is to
 * follow rimline_changes.slots needs room for all edges of the mesh (rimline_mesh_info.edges). */
RIMLINE_API rimline_status rimline_tracker_silhouette(const rimline_tracker* tracker,
                                                      const uint32_t** edges, size_t* count,
                                                      rimline_error** error);
/** All face bits, 32 a word; valid until the tracker moves or is freed. */
RIMLINE_API rimline_status rimline_tracker_face_words(const rimline_tracker* tracker,
                                                      const uint32_t** words, size_t* count,
                                                      rimline_error** error);

/* Line drawings with exact visibility. */

typedef struct rimline_drawer rimline_drawer;
typedef struct rimline_drawing rimline_drawing;

RIMLINE_API rimline_status rimline_drawer_create(const rimline_mesh* mesh, const rimline_call* call,
                                                 rimline_drawer** drawer, rimline_error** error);
RIMLINE_API void rimline_drawer_free(rimline_drawer* drawer);
/** `options`: those of `rimline draw` for camera, lines and page. The page is as large as the drawing by default. */
RIMLINE_API rimline_status rimline_drawer_draw(rimline_drawer* drawer,
                                               const rimline_option* options, size_t option_count,
                                               const rimline_call* call, rimline_drawing** drawing,
                                               rimline_error** error);
RIMLINE_API void rimline_drawing_free(rimline_drawing* drawing);

typedef enum rimline_line_kind {
    RIMLINE_SILHOUETTE = 0,
    RIMLINE_BORDER = 1,
    RIMLINE_CREASE = 2,
    RIMLINE_INTERSECTION = 3
} rimline_line_kind;

typedef struct rimline_line {
    size_t struct_size;
    rimline_line_kind kind;
    int is_hidden;
    int is_closed; /**< The last point goes on to the first. */
    const double*
        points; /**< Pairs in mm on the page, y downwards; valid until the drawing is freed. */
    size_t point_count;
} rimline_line;

typedef enum rimline_drawing_format {
    RIMLINE_SVG = 0,
    RIMLINE_PDF = 1,
    RIMLINE_DXF = 2
} rimline_drawing_format;

RIMLINE_API rimline_status rimline_drawing_page(const rimline_drawing* drawing, double* width_mm,
                                                double* height_mm, size_t* line_count,
                                                rimline_error** error);
RIMLINE_API rimline_status rimline_drawing_line(const rimline_drawing* drawing, size_t index,
                                                rimline_line* line, rimline_error** error);
/** `format`: a rimline_drawing_format. */
RIMLINE_API rimline_status rimline_drawing_encode(const rimline_drawing* drawing, int format,
                                                  rimline_bytes** file, rimline_error** error);

/* Pictures. */

typedef struct rimline_renderer rimline_renderer;
typedef struct rimline_picture rimline_picture;

/** `device`: gpu, cpu, a number or a part of its name; NULL: a discrete GPU if there is one. */
RIMLINE_API rimline_status rimline_renderer_create(const char* device, rimline_renderer** renderer,
                                                   rimline_error** error);
/** In a child of fork() it does nothing: the device is the parent's. */
RIMLINE_API void rimline_renderer_free(rimline_renderer* renderer);
/** `options`: those of `rimline render` for style, camera, lights and image, {"size", "640x480"}. */
RIMLINE_API rimline_status rimline_renderer_render(rimline_renderer* renderer,
                                                   const rimline_mesh* mesh,
                                                   const rimline_option* options,
                                                   size_t option_count, const rimline_call* call,
                                                   rimline_picture** picture,
                                                   rimline_error** error);
RIMLINE_API void rimline_picture_free(rimline_picture* picture);
/** Rows from the top, 4 bytes a pixel: red, green, blue (sRGB), straight alpha; valid until the picture is freed. */
RIMLINE_API rimline_status rimline_picture_pixels(const rimline_picture* picture, uint32_t* width,
                                                  uint32_t* height, const uint8_t** rgba,
                                                  rimline_error** error);
RIMLINE_API rimline_status rimline_picture_encode_png(const rimline_picture* picture,
                                                      rimline_bytes** file, rimline_error** error);

/* Best views. */

typedef struct rimline_view {
    double eye[3];
    double score;         /**< Votes times visible ratio, less from below, behind, and of ends. */
    double visible_ratio; /**< The visible share of the silhouette. */
} rimline_view;

/** Writes at most `capacity` viewpoints that together show the mesh best to `views`, and their number to `*count`, which
 * may be less. Without a renderer, rays on the CPU measure what is visible. */
RIMLINE_API rimline_status rimline_best_views(const rimline_mesh* mesh, rimline_renderer* renderer,
                                              size_t capacity, const rimline_call* call,
                                              rimline_view* views, size_t* count,
                                              rimline_error** error);

#ifdef __cplusplus
}
#endif

#endif
