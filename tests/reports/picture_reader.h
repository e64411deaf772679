/* Reads pictures back with OpenImageIO, for the tests of the writer. */
#ifndef TESTS_REPORTS_PICTURE_READER_H
#define TESTS_REPORTS_PICTURE_READER_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct picture {
    int width, height, channels;
    char names[16][32]; /* of the channels */
    char types[16][16]; /* "uint8", "float", "uint", "half", as OpenImageIO names them, in the file */
    char color_space[32];
    char date[32];
    /* width * height * channels samples, each converted to double without scaling */
    double *samples; /* for free() */
} picture;

/** 1, or 0 if the file cannot be read as a picture. */
int picture_read(const char *path, picture *out);

/** Index of a channel, -1 if there is none of that name. */
int picture_channel(const picture *p, const char *name);

#ifdef __cplusplus
}
#endif
#endif
