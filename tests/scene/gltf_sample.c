#include "tests/scene/gltf_sample.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define POOL_BYTES 512

/* Little-endian writer over the default buffer. */
typedef struct pool {
    unsigned char bytes[POOL_BYTES];
    size_t size;
    size_t view_offset[GLTF_SAMPLE_VIEWS], view_size[GLTF_SAMPLE_VIEWS], view_stride[GLTF_SAMPLE_VIEWS];
} pool;

static void put(pool *p, uint32_t value, int bytes)
{
    for (int i = 0; i < bytes; i++)
        p->bytes[p->size++] = (unsigned char)(value >> 8 * i);
}

static void put_float(pool *p, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(p, bits, 4);
}

static void begin_view(pool *p, int view, size_t stride)
{
    while (p->size % 4)
        put(p, 0, 1);
    p->view_offset[view] = p->size;
    p->view_stride[view] = stride;
}

static void end_view(pool *p, int view)
{
    p->view_size[view] = p->size - p->view_offset[view];
}

static void put_floats(pool *p, int view, size_t stride, const float *vertices, int count)
{
    begin_view(p, view, stride);
    for (int i = 0; i < count; i++) {
        for (int axis = 0; axis < 3; axis++)
            put_float(p, vertices[3 * i + axis]);
        if (stride == 16)
            put_float(p, 9);
    }
    end_view(p, view);
}

/* Three vertices (0,0,0) (x,0,0) (0,y,0) of integers, padded to four components. */
static void put_integers(pool *p, int view, int bytes, int x, int y)
{
    begin_view(p, view, (size_t)(4 * bytes));
    for (int vertex = 0; vertex < 3; vertex++)
        for (int axis = 0; axis < 4; axis++)
            put(p, (uint32_t)(vertex == 1 && axis == 0 ? x : vertex == 2 && axis == 1 ? y : 0), bytes);
    end_view(p, view);
}

static void fill_pool(pool *p)
{
    static const float quad[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    static const float two[3][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
    static const float sparse[2][3] = {{5, 0, 0}, {0, 5, 0}};
    float odd[3][3] = {{0, 0, 0}, {NAN, 0, 0}, {0, 1, 0}};
    memset(p, 0, sizeof *p);
    put_floats(p, 0, 0, quad[0], 4);
    for (int view = 1; view <= 3; view++) {
        begin_view(p, view, 0);
        for (int i = 0; i < 6; i++)
            put(p, (uint32_t)"\0\1\2\0\2\3"[i], 1 << (view - 1));
        end_view(p, view);
    }
    put_floats(p, 4, 16, two[0], 3);
    begin_view(p, 5, 0);
    put(p, 1, 2);
    put(p, 3, 2);
    end_view(p, 5);
    put_floats(p, 6, 0, sparse[0], 2);
    put_integers(p, 7, 2, 32767, -32768);
    put_integers(p, 8, 2, 32767, -32768);
    put_integers(p, 9, 1, 127, -128);
    put_integers(p, 10, 2, 65535, 13107);
    put_integers(p, 11, 1, 255, 51);
    put_floats(p, 12, 0, odd[0], 3);
    odd[1][0] = INFINITY;
    put_floats(p, 13, 0, odd[0], 3);
    odd[1][0] = 2e9f;
    put_floats(p, 14, 0, odd[0], 3);
}

static const char default_accessors[] =
    "[{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3'},"
    "{'bufferView':1,'componentType':5121,'count':6,'type':'SCALAR'},"
    "{'bufferView':2,'componentType':5123,'count':6,'type':'SCALAR'},"
    "{'bufferView':3,'componentType':5125,'count':6,'type':'SCALAR'},"
    "{'bufferView':4,'componentType':5126,'count':3,'type':'VEC3'},"
    "{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3','sparse':{'count':2,"
    "'indices':{'bufferView':5,'componentType':5123},'values':{'bufferView':6}}},"
    "{'componentType':5126,'count':4,'type':'VEC3','sparse':{'count':2,"
    "'indices':{'bufferView':5,'componentType':5123},'values':{'bufferView':6}}},"
    "{'bufferView':7,'componentType':5122,'count':3,'type':'VEC3'},"
    "{'bufferView':7,'componentType':5122,'count':3,'type':'VEC3','normalized':true},"
    "{'bufferView':9,'componentType':5120,'count':3,'type':'VEC3','normalized':true},"
    "{'bufferView':10,'componentType':5123,'count':3,'type':'VEC3','normalized':true},"
    "{'bufferView':11,'componentType':5121,'count':3,'type':'VEC3'},"
    "{'bufferView':12,'componentType':5126,'count':3,'type':'VEC3'},"
    "{'bufferView':13,'componentType':5126,'count':3,'type':'VEC3'},"
    "{'bufferView':14,'componentType':5126,'count':3,'type':'VEC3'}]";

#define ONE_MESH(primitive) "[{'primitives':[" primitive "]}]"
#define LIGHT "'extras':{'light':{'corner':[1,5,2],'u':[3000000000e-9,0,0],'v':[0,0,4]}}"

static const gltf_sample samples[] = {
    {.name = "triangle", .meshes = ONE_MESH("{'attributes':{'POSITION':4}}")},
    {.name = "indices8", .meshes = ONE_MESH("{'attributes':{'POSITION':0},'indices':1}")},
    {.name = "indices16", .meshes = ONE_MESH("{'attributes':{'POSITION':0},'indices':2,'mode':4}")},
    {.name = "indices32", .meshes = ONE_MESH("{'attributes':{'POSITION':0},'indices':3}")},
    {.name = "strip", .meshes = ONE_MESH("{'attributes':{'POSITION':0},'indices':2,'mode':5}")},
    {.name = "fan", .meshes = ONE_MESH("{'attributes':{'POSITION':0},'mode':6}")},
    {.name = "sparse", .meshes = ONE_MESH("{'attributes':{'POSITION':5},'indices':1}")},
    {.name = "sparse_zeros", .meshes = ONE_MESH("{'attributes':{'POSITION':6},'indices':1}")},
    {.name = "int16", .meshes = ONE_MESH("{'attributes':{'POSITION':7}}")},
    {.name = "int16_normalized",
     .meshes = ONE_MESH("{'attributes':{'POSITION':8}}"),
     .more = "'extensionsRequired':['KHR_mesh_quantization'],"},
    {.name = "int8_normalized", .meshes = ONE_MESH("{'attributes':{'POSITION':9}}")},
    {.name = "uint16_normalized", .meshes = ONE_MESH("{'attributes':{'POSITION':10}}")},
    {.name = "uint8", .meshes = ONE_MESH("{'attributes':{'POSITION':11}}")},
    {.name = "points_between", .meshes = "[{'primitives':[{'attributes':{'POSITION':0},'mode':0},{'attributes':{'POSITION':4}},"
                                         "{'attributes':{'POSITION':0},'mode':3}]}]"},
    {.name = "materials",
     .meshes = "[{'primitives':[{'attributes':{'POSITION':4},'material':1},{'attributes':{'POSITION':4}},"
               "{'attributes':{'POSITION':4},'material':0}]}]",
     .more = "'materials':[{'pbrMetallicRoughness':{'baseColorFactor':[0.5,0.25,1,1]}},{'name':'plain'}],"},
    {.name = "tree",
     .scenes = "[{'nodes':[3]},{'nodes':[2,0]}]",
     .nodes = "[{'children':[1],'translation':[10,0,0]},{'mesh':0,'scale':[2,2,2],'rotation':[0,0,0.70710678,0.70710678]},"
              "{'mesh':1,'matrix':[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,-7,1]},{'mesh':0}]",
     .meshes = "[{'primitives':[{'attributes':{'POSITION':4}}]},{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}]",
     .more = "'scene':1,"},
    {.name = "mirror", .nodes = "[{'mesh':0,'scale':[-1,1,1]}]"},
    {.name = "cameras",
     .scenes = "[{'nodes':[0,1,2,3]}]",
     .nodes = "[{'mesh':0},{'camera':1,'name':'flat'},{'camera':0,'name':'side','translation':[1,2,3],"
              "'rotation':[0,0.70710678,0,0.70710678],'scale':[3,3,3]},{'camera':0}]",
     .more = "'cameras':[{'type':'perspective','name':'lens','perspective':{'yfov':0.75,'znear':0.1}},"
             "{'type':'orthographic','orthographic':{'xmag':1,'ymag':1,'zfar':2,'znear':1}}],"},
    {.name = "lights",
     .scenes = "[{'nodes':[0,1,2,3,4]}]",
     .nodes = "[{'mesh':0,'extras':{'light':true}},{'extensions':{'KHR_lights_punctual':{'light':0}}},"
              "{'translation':[50,0,0]," LIGHT "},{'translation':[1,2,3],'extensions':{'KHR_lights_punctual':{'light':1}}},"
              "{'extras':{'light':{'corner':[0,0,0],'u':[1,0,0],'v':[0,1,0]}}}]",
     .more = "'extensionsRequired':['KHR_lights_punctual','KHR_materials_unlit'],"
             "'extensions':{'KHR_lights_punctual':{'lights':[{'type':'spot'},{'type':'point'}]}},"},
    {.name = "no_scenes", .scenes = "[]", .nodes = "[{'children':[1]},{'mesh':0}]"},
    {.name = "ignored",
     .nodes = "[{'mesh':0,'skin':0,'weights':[1],'extras':[[[{}]]]}]",
     .more = "'images':[{'uri':'missing.png'},{'bufferView':99,'mimeType':'image/png'}],'textures':[{'source':77}],"
             "'animations':[{'channels':'none'}],'skins':[{}],'samplers':[1],'extensionsUsed':['X_unknown'],"},
};

const gltf_sample *gltf_sample_list(size_t *count)
{
    *count = sizeof samples / sizeof samples[0];
    return samples;
}

const gltf_sample *gltf_sample_find(const char *name)
{
    for (size_t i = 0; i < sizeof samples / sizeof samples[0]; i++)
        if (strcmp(samples[i].name, name) == 0)
            return &samples[i];
    abort();
}

/* A growing text; every append is checked by abort, as this is test code. */
typedef struct text {
    char *data;
    size_t size;
} text;

static void append(text *t, const char *more, int quotes)
{
    size_t n = strlen(more);
    t->data = realloc(t->data, t->size + n + 1);
    if (!t->data)
        abort();
    for (size_t i = 0; i <= n; i++)
        t->data[t->size + i] = quotes && more[i] == '\'' ? '"' : more[i];
    t->size += n;
}

static void append_views(text *t, const pool *p)
{
    char view[128];
    append(t, "[", 0);
    for (int i = 0; i < GLTF_SAMPLE_VIEWS; i++) {
        int n = snprintf(view, sizeof view, "%s{'buffer':0,'byteOffset':%zu,'byteLength':%zu", i ? "," : "", p->view_offset[i],
                         p->view_size[i]);
        if (p->view_stride[i])
            snprintf(view + n, sizeof view - (size_t)n, ",'byteStride':%zu}", p->view_stride[i]);
        else
            snprintf(view + n, sizeof view - (size_t)n, "}");
        append(t, view, 1);
    }
    append(t, "]", 0);
}

static void append_base64(text *t, const unsigned char *data, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t bits = 0;
        for (size_t j = 0; j < 3; j++)
            bits = bits << 8 | (i + j < size ? data[i + j] : 0);
        char four[5] = {digits[bits >> 18], digits[bits >> 12 & 63], digits[bits >> 6 & 63], digits[bits & 63], 0};
        if (i + 1 >= size)
            four[2] = '=';
        if (i + 2 >= size)
            four[3] = '=';
        append(t, four, 0);
    }
}

static text make_json(const gltf_sample *s, const pool *p, int embed)
{
    text t = {0};
    char buffer[64];
    append(&t, "{'asset':", 1);
    append(&t, s->asset ? s->asset : "{'version':'2.0'}", 1);
    append(&t, ",", 0);
    append(&t, s->more ? s->more : "", 1);
    append(&t, "'scenes':", 1);
    append(&t, s->scenes ? s->scenes : "[{'nodes':[0]}]", 1);
    append(&t, ",'nodes':", 1);
    append(&t, s->nodes ? s->nodes : "[{'mesh':0}]", 1);
    append(&t, ",'meshes':", 1);
    append(&t, s->meshes ? s->meshes : "[{'primitives':[{'attributes':{'POSITION':4}}]}]", 1);
    append(&t, ",'accessors':", 1);
    append(&t, s->accessors ? s->accessors : default_accessors, 1);
    append(&t, ",'bufferViews':", 1);
    if (s->views)
        append(&t, s->views, 1);
    else
        append_views(&t, p);
    append(&t, ",'buffers':", 1);
    if (s->buffers) {
        append(&t, s->buffers, 1);
    } else {
        snprintf(buffer, sizeof buffer, "[{'byteLength':%zu", p->size);
        append(&t, buffer, 1);
        if (embed) {
            append(&t, ",'uri':'data:application/octet-stream;base64,", 1);
            append_base64(&t, p->bytes, p->size);
            append(&t, "'", 1);
        }
        append(&t, "}]", 0);
    }
    append(&t, "}", 0);
    return t;
}

unsigned char *gltf_sample_text(const gltf_sample *sample, size_t *size)
{
    pool p;
    fill_pool(&p);
    text t = make_json(sample, &p, 1);
    *size = t.size;
    return (unsigned char *)t.data;
}

unsigned char *gltf_sample_buffer(size_t *size)
{
    pool p;
    fill_pool(&p);
    unsigned char *copy = malloc(p.size);
    if (!copy)
        abort();
    memcpy(copy, p.bytes, p.size);
    *size = p.size;
    return copy;
}

static void store(unsigned char *to, size_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (unsigned char)(value >> 8 * i);
}

unsigned char *gltf_sample_pack(const char *json, const unsigned char *binary, size_t binary_size, size_t *size)
{
    size_t json_size = strlen(json), json_room = (json_size + 3) / 4 * 4, binary_room = (binary_size + 3) / 4 * 4;
    *size = 20 + json_room + (binary_size ? 8 + binary_room : 0);
    unsigned char *glb = calloc(1, *size);
    if (!glb)
        abort();
    memcpy(glb, "glTF", 4);
    store(glb + 4, 2);
    store(glb + 8, *size);
    store(glb + 12, json_room);
    memcpy(glb + 16, "JSON", 4);
    memset(glb + 20, ' ', json_room);
    memcpy(glb + 20, json, json_size);
    if (binary_size) {
        store(glb + 20 + json_room, binary_room);
        memcpy(glb + 24 + json_room, "BIN", 4);
        memcpy(glb + 28 + json_room, binary, binary_size);
    }
    return glb;
}

unsigned char *gltf_sample_glb(const gltf_sample *sample, size_t *size)
{
    pool p;
    fill_pool(&p);
    text t = make_json(sample, &p, 0);
    unsigned char *glb = gltf_sample_pack(t.data, p.bytes, p.size, size);
    free(t.data);
    return glb;
}
