/* Writes traces of random streams for the fuzz target: `write_trace_seeds FOLDER`: whole files, and tiles as columns. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zstd.h>

#include "tests/traces/streams.h"
#include "traces/encoder.h"
#include "traces/writer.h"

static int write_columns(const char *path, const trace_tile *tile)
{
    unsigned char *columns = malloc(tile->plain_size);
    FILE *file = fopen(path, "wb");
    int good = columns && file && ZSTD_decompress(columns, tile->plain_size, tile->bytes, tile->size) == tile->plain_size &&
               fputc('C', file) == 'C' && fwrite(&tile->events, sizeof tile->events, 1, file) == 1 &&
               fwrite(columns, tile->plain_size, 1, file) == 1;
    free(columns);
    return (file && fclose(file) == 0) & good;
}

static int write_seed(const char *folder, base_random *random, int number, trace_encoder *encoder)
{
    char columns[4096], path[4096];
    trace_tile tile;
    trace_writer *writer = NULL;
    stream s = stream_random(random, base_random_bits(random) % 300);
    snprintf(columns, sizeof columns, "%s/columns-%d", folder, number);
    snprintf(path, sizeof path, "%s/file-%d.ltr", folder, number);
    trace_encoder_begin(encoder);
    trace_encoder_events(encoder, s.events, (uint32_t)s.count);
    stream_free(&s);
    int good = trace_encoder_end(encoder, &tile, NULL) == BASE_OK && write_columns(columns, &tile) &&
               trace_writer_create(path, 1, "{}", &writer, NULL) == BASE_OK &&
               trace_writer_put(writer, 0, &tile, NULL) == BASE_OK && trace_writer_commit(writer, "{}", NULL) == BASE_OK;
    trace_writer_destroy(&writer);
    return good;
}

int main(int argc, char **argv)
{
    base_random random = {.state = 1};
    trace_encoder *encoder = NULL;
    if (argc != 2) {
        fprintf(stderr, "usage: write_trace_seeds FOLDER\n");
        return 2;
    }
    int good = trace_encoder_create(&encoder, NULL) == BASE_OK;
    for (int i = 0; good && i < 20; i++)
        good = write_seed(argv[1], &random, i, encoder);
    trace_encoder_destroy(&encoder);
    if (!good)
        perror(argv[1]);
    return good ? 0 : 1;
}
