#include "cli/identity.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "cli/version.h"
#include "kernels/job.h"
#include "reports/table.h"

static const char schema[] = "lanetrace-trace-1";
static const char units_prefix[] = "units_"; /* of counters that stand under "units" */

enum { RATIO_DECIMALS = 6, UNITS_PREFIX = sizeof units_prefix - 1 };

static json_t *integer(uint64_t value) { return json_integer((json_int_t)value); }

/* The parameters that the kernel takes. */
static json_t *params_json(const kernel_info *kernel, const kernel_params *params)
{
    size_t count;
    const kernel_param_info *table = kernel_param_list(&count);
    json_t *object = json_object();
    for (size_t i = 0; i < count; i++) {
        unsigned value = kernel_param_get(params, &table[i]);
        if (kernel->params >> i & 1)
            json_object_set_new(object, table[i].name, table[i].values ? json_string(table[i].values[value]) : integer(value));
    }
    if (params->samples) {
        json_object_set_new(object, "samples", integer(params->samples));
        json_object_set_new(object, "light_scale", report_json_real(params->light_scale, RATIO_DECIMALS));
    }
    return object;
}

static json_t *bvh_json(const bvh *tree)
{
    const double leaves = tree->leaf_count ? (double)tree->leaf_count : 1;
    json_t *object = json_object();
    json_object_set_new(object, "kind", json_string("bvh"));
    json_object_set_new(object, "nodes", integer(tree->inner_count + tree->leaf_count));
    json_object_set_new(object, "leaves", integer(tree->leaf_count));
    json_object_set_new(object, "depth", integer(tree->depth));
    json_object_set_new(object, "triangles", integer(tree->record_count));
    json_object_set_new(object, "degenerate", integer(tree->degenerate_count));
    json_object_set_new(object, "triangles_per_leaf", report_json_real((double)tree->record_count / leaves, RATIO_DECIMALS));
    json_object_set_new(object, "sah_cost", report_json_real(tree->sah_cost, RATIO_DECIMALS));
    return object;
}

static json_t *kdtree_json(const kdtree *tree)
{
    const size_t full = tree->leaf_count - tree->empty_count;
    json_t *object = json_object();
    json_object_set_new(object, "kind", json_string("kdtree"));
    json_object_set_new(object, "nodes", integer(tree->inner_count + tree->leaf_count));
    json_object_set_new(object, "leaves", integer(tree->leaf_count));
    json_object_set_new(object, "empty_leaves", integer(tree->empty_count));
    json_object_set_new(object, "flat_leaves", integer(tree->flat_count));
    json_object_set_new(object, "covered_leaves", integer(tree->covered_count));
    json_object_set_new(object, "enclosed_leaves", integer(tree->enclosed_count));
    json_object_set_new(object, "depth", integer(tree->depth));
    json_object_set_new(object, "triangles", integer(tree->record_count));
    json_object_set_new(object, "degenerate", integer(tree->degenerate_count));
    json_object_set_new(object, "references", integer(tree->list_count));
    json_object_set_new(object, "triangles_per_leaf", report_json_real((double)tree->list_count / (full ? (double)full : 1), RATIO_DECIMALS));
    json_object_set_new(object, "sah_cost", report_json_real(tree->sah_cost, RATIO_DECIMALS));
    return object;
}

static json_t *scene_json(const run_result *r)
{
    char hash[20];
    json_t *object = json_object();
    snprintf(hash, sizeof hash, "%016" PRIx64, r->scene->hash);
    json_object_set_new(object, "name", json_string(r->scene->name));
    json_object_set_new(object, "triangles", integer(r->scene->triangle_count));
    json_object_set_new(object, "hash", json_string(hash));
    json_object_set_new(object, "camera", json_string(r->camera->name));
    json_object_set_new(object, "accel", r->tree ? bvh_json(r->tree) : kdtree_json(r->kdtree));
    return object;
}

json_t *identity_json(const run_result *r)
{
    json_t *object = json_object(), *image = json_object();
    json_object_set_new(image, "width", integer(r->options.width));
    json_object_set_new(image, "height", integer(r->options.height));
    json_object_set_new(object, "kernel", json_string(r->options.kernel->name));
    json_object_set_new(object, "params", params_json(r->options.kernel, &r->options.params));
    json_object_set_new(object, "scene", scene_json(r));
    json_object_set_new(object, "image", image);
    return object;
}

json_t *identity_counts_json(const run_result *r)
{
    json_t *object = json_object(), *units = json_object();
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++) {
        const char *name = kernel_counter_table[i].name;
        if (!(r->options.kernel->counters >> i & 1))
            continue;
        if (strncmp(name, units_prefix, UNITS_PREFIX) == 0)
            json_object_set_new(units, name + UNITS_PREFIX, integer(r->counts.n[i]));
        else
            json_object_set_new(object, name, integer(r->counts.n[i]));
    }
    json_object_set_new(object, "units", units);
    return object;
}

char *identity_head_text(const run_result *r)
{
    json_t *head = json_object(), *run = identity_json(r);
    json_object_set_new(head, "schema", json_string(schema));
    json_object_set_new(head, "version", json_string(VERSION_NUMBER));
    json_object_update(head, run);
    if (r->job->filtered)
        json_object_set_new(head, "first_pass", integer(kernel_job_first_pass(r->job)));
    char *text = json_dumps(head, JSON_COMPACT);
    json_decref(run);
    json_decref(head);
    return text;
}

char *identity_tail_text(const run_result *r)
{
    json_t *tail = json_object();
    json_object_set_new(tail, "counts", identity_counts_json(r));
    char *text = json_dumps(tail, JSON_COMPACT);
    json_decref(tail);
    return text;
}

/* The member of an object that must be there and of that type; else *value is NULL. */
static base_status member(const char *path, const json_t *object, const char *key, json_type type, json_t **value, base_error *err)
{
    *value = json_object_get(object, key);
    if (*value && json_typeof(*value) == type)
        return BASE_OK;
    return base_fail(err, BASE_ERR_INPUT, path, "what was run: '%s' is %s", key, *value ? "of the wrong type" : "missing");
}

static base_status positive(const char *path, const json_t *object, const char *key, json_int_t max, unsigned *out, base_error *err)
{
    json_t *value;
    base_status status = member(path, object, key, JSON_INTEGER, &value, err);
    if (status != BASE_OK)
        return status;
    json_int_t number = json_integer_value(value);
    if (number < 1 || number > max)
        return base_fail(err, BASE_ERR_INPUT, path, "what was run: '%s' is not in 1..%lld", key, (long long)max);
    *out = (unsigned)number;
    return BASE_OK;
}

/* One counter, by its name with prefix. */
static base_status read_count(const char *path, const char *prefix, const char *key, const json_t *value, identity *out, base_error *err)
{
    for (int i = 0; i < KERNEL_COUNTER_COUNT; i++) {
        const char *name = kernel_counter_table[i].name;
        if (strncmp(name, prefix, strlen(prefix)) != 0 || strcmp(name + strlen(prefix), key) != 0)
            continue;
        if (!json_is_integer(value) || json_integer_value(value) < 0)
            return base_fail(err, BASE_ERR_INPUT, path, "what was counted: '%s' is no count", key);
        out->kernel.counters |= UINT64_C(1) << i;
        out->counts.n[i] = (uint64_t)json_integer_value(value);
        return BASE_OK;
    }
    return base_fail(err, BASE_ERR_INPUT, path, "what was counted: this program has no counter '%s%s'", prefix, key);
}

static base_status read_counts(const char *path, const json_t *tail, identity *out, base_error *err)
{
    json_t *counts, *units, *value;
    const char *key;
    base_status status = member(path, tail, "counts", JSON_OBJECT, &counts, err);
    if (status == BASE_OK)
        status = member(path, counts, "units", JSON_OBJECT, &units, err);
    if (status != BASE_OK)
        return status;
    json_object_foreach(units, key, value)
        if (status == BASE_OK)
            status = read_count(path, units_prefix, key, value, out, err);
    json_object_foreach(counts, key, value)
        if (status == BASE_OK && value != units)
            status = read_count(path, "", key, value, out, err);
    if (status == BASE_OK && out->counts.n[KERNEL_rays] == 0)
        return base_fail(err, BASE_ERR_INPUT, path, "what was counted: no rays");
    return status;
}

static base_status read_run(const char *path, json_t *head, identity *out, base_error *err)
{
    json_t *kernel, *params, *place, *name, *image, *version = json_object_get(head, "schema");
    if (!json_is_string(version) || strcmp(json_string_value(version), schema) != 0)
        return base_fail(err, BASE_ERR_INPUT, path, "what was run: its schema is not '%s'", schema);
    base_status status = member(path, head, "kernel", JSON_STRING, &kernel, err);
    if (status == BASE_OK)
        status = member(path, head, "params", JSON_OBJECT, &params, err);
    if (status == BASE_OK)
        status = member(path, head, "scene", JSON_OBJECT, &place, err);
    if (status == BASE_OK)
        status = member(path, place, "name", JSON_STRING, &name, err);
    if (status == BASE_OK)
        status = positive(path, place, "triangles", UINT32_MAX, &out->triangles, err);
    if (status == BASE_OK)
        status = member(path, head, "image", JSON_OBJECT, &image, err);
    if (status == BASE_OK)
        status = positive(path, image, "width", JOB_MAX_SIZE, &out->width, err);
    if (status == BASE_OK)
        status = positive(path, image, "height", JOB_MAX_SIZE, &out->height, err);
    if (status != BASE_OK)
        return status;
    out->json = json_pack("{s:O, s:O, s:O, s:O}", "kernel", kernel, "params", params, "scene", place, "image", image);
    out->kernel.name = json_string_value(kernel);
    const kernel_info *known = kernel_find(out->kernel.name);
    out->kernel.phases = known ? known->phases : UINT64_MAX;
    out->scene_name = json_string_value(name);
    return out->json ? BASE_OK : base_fail(err, BASE_ERR_NOMEM, path, "out of memory");
}

/* How many tiles come before a second pass: all, if nothing is said. */
static base_status read_passes(const char *path, const json_t *head, uint32_t tiles, identity *out, base_error *err)
{
    out->first_pass = tiles;
    return json_object_get(head, "first_pass") ? positive(path, head, "first_pass", tiles, &out->first_pass, err) : BASE_OK;
}

/* Parse one of the trace's texts. */
static base_status parse(const char *path, const char *text, json_t **out, base_error *err)
{
    json_error_t wrong;
    *out = json_loads(text, JSON_REJECT_DUPLICATES, &wrong);
    if (!json_is_object(*out)) {
        json_decref(*out);
        *out = NULL;
        return base_fail(err, BASE_ERR_INPUT, path, "what was run: no JSON object");
    }
    return BASE_OK;
}

base_status identity_read(const char *path, const trace_reader *trace, identity *out, base_error *err)
{
    json_t *head = NULL, *tail = NULL;
    *out = (identity){0};
    base_status status = parse(path, trace_reader_head_text(trace), &head, err);
    if (status == BASE_OK)
        status = parse(path, trace_reader_tail_text(trace), &tail, err);
    if (status == BASE_OK)
        status = read_run(path, head, out, err);
    if (status == BASE_OK)
        status = read_passes(path, head, trace_reader_tiles(trace), out, err);
    if (status == BASE_OK)
        status = read_counts(path, tail, out, err);
    json_decref(head);
    json_decref(tail);
    return status;
}

void identity_destroy(identity *id)
{
    json_decref(id->json);
    *id = (identity){0};
}
