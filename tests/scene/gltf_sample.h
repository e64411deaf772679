/* Small glTF files made in memory, for the loader's tests and as seeds for its fuzz target. */
#ifndef TESTS_SCENE_GLTF_SAMPLE_H
#define TESTS_SCENE_GLTF_SAMPLE_H

#include <stddef.h>

/*
 * A file, as the parts in which it differs from the plainest one. Parts are JSON with ' for "; NULL takes the
 * default: one scene of one node with one mesh of one triangle, and the accessors below over one buffer.
 */
typedef struct gltf_sample {
    const char *name;
    const char *scenes, *nodes, *meshes, *accessors, *views;
    const char *buffers; /* default: the binary chunk of a .glb, a data: URI in a .gltf */
    const char *more;    /* further members of the root object, ending in a comma */
    const char *asset;
} gltf_sample;

/*
 * Accessors of the default buffer. Accessor i has bufferView i, but 5 adds sparse elements to 0, 6 has those alone,
 * and 8 is 7 normalised.
 *
 *  0 float  (0,0,0) (1,0,0) (1,1,0) (0,1,0)
 *  1, 2, 3  indices 0 1 2 0 2 3 of 8, 16 and 32 bits
 *  4 float, 16 bytes apart  (0,0,0) (2,0,0) (0,2,0)
 *  5, 6     elements 1 and 3 are (5,0,0) and (0,5,0)
 *  7, 8     int16, 8 bytes apart  (0,0,0) (32767,0,0) (0,-32768,0)
 *  9        int8 normalised, 4 bytes apart  (0,0,0) (127,0,0) (0,-128,0)
 * 10        uint16 normalised, 8 bytes apart  (0,0,0) (65535,0,0) (0,13107,0)
 * 11        uint8, 4 bytes apart  (0,0,0) (255,0,0) (0,51,0)
 * 12 float  (0,0,0) (NaN,0,0) (0,1,0)
 * 13 float  (0,0,0) (inf,0,0) (0,1,0)
 * 14 float  (0,0,0) (2e9,0,0) (0,1,0)
 */
#define GLTF_SAMPLE_VIEWS 15

/** The file as .glb; allocated with malloc, *size bytes. */
unsigned char *gltf_sample_glb(const gltf_sample *sample, size_t *size);

/** The file as .gltf with a data: URI; allocated with malloc, *size bytes and a final zero that is not counted. */
unsigned char *gltf_sample_text(const gltf_sample *sample, size_t *size);

/** The default buffer; allocated with malloc, *size bytes. */
unsigned char *gltf_sample_buffer(size_t *size);

/** A .glb of that JSON, with its quotes as they are, and that binary chunk (none if size is 0). */
unsigned char *gltf_sample_pack(const char *json, const unsigned char *binary, size_t binary_size, size_t *size);

/** Files that load, one for each feature. */
const gltf_sample *gltf_sample_list(size_t *count);

/** The entry of that name; ends the program if there is none. */
const gltf_sample *gltf_sample_find(const char *name);

#endif
