/* Writes the samples of tests/scene as files for the fuzz target: `write_gltf_seeds FOLDER`. */
#include <stdio.h>
#include <stdlib.h>

#include "tests/scene/gltf_sample.h"

static int write_seed(const char *folder, const char *name, const char *extension, const unsigned char *data, size_t size)
{
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s.%s", folder, name, extension) >= (int)sizeof path)
        return 0;
    FILE *file = fopen(path, "wb");
    if (!file)
        return 0;
    int ok = fwrite(data, 1, size, file) == size;
    return fclose(file) == 0 && ok;
}

int main(int argc, char **argv)
{
    size_t count;
    const gltf_sample *samples = gltf_sample_list(&count);
    if (argc != 2) {
        fprintf(stderr, "usage: write_gltf_seeds FOLDER\n");
        return 2;
    }
    for (size_t i = 0; i < count; i++) {
        size_t glb_size, text_size;
        unsigned char *glb = gltf_sample_glb(&samples[i], &glb_size), *text = gltf_sample_text(&samples[i], &text_size);
        int ok = write_seed(argv[1], samples[i].name, "glb", glb, glb_size) &&
                 write_seed(argv[1], samples[i].name, "gltf", text, text_size);
        free(glb);
        free(text);
        if (!ok) {
            perror(argv[1]);
            return 1;
        }
    }
    return 0;
}
