#include "reports/views/mlrta_adaptive.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "reports/views/mlrta_paper.h"

enum { CLASSES = 80 }; /* of complexity, two to a doubling */

const double mlrta_rate_samples[MLRTA_RATES] = {0.25, 1, 4, 16};
static const char *const rate_names[MLRTA_RATES] = {"1/4", "1", "4", "16"};
static const char *const way_names[MLRTA_WAYS] = {"evenly", "by the root of the complexity", "by complexity, best steps", "by error"};

static double error_of(const mlrta_adaptive_scene *scene, int rate)
{
    double sum = 0;
    for (size_t i = 0; i < scene->count; i++)
        sum += scene->tiles[i].error[rate];
    return sum;
}

/* What the rates in scene->rates come to. */
static mlrta_sampling sampling_of(const mlrta_adaptive_scene *scene)
{
    mlrta_sampling s = {0};
    double error = 0, chance = 0;
    for (size_t i = 0; i < scene->count; i++) {
        const mlrta_adaptive_tile *tile = &scene->tiles[i];
        const int rate = scene->rates[i];
        s.rays += tile->rays[rate] / scene->pixels;
        s.cycles += tile->cycles[rate] / scene->pixels;
        s.share[rate] += 1.0 / (double)scene->count;
        error += tile->error[rate];
    }
    for (int rate = 0; rate < MLRTA_RATES; rate++)
        chance += s.share[rate] * error_of(scene, rate);
    s.rmse = sqrt(error / (3 * scene->pixels));
    s.by_chance = sqrt(chance / (3 * scene->pixels));
    return s;
}

static mlrta_sampling evenly(const mlrta_adaptive_scene *scene, int rate)
{
    memset(scene->rates, rate, scene->count);
    return sampling_of(scene);
}

/* s samples for s^2 times `nodes`. */
static mlrta_sampling by_root(const mlrta_adaptive_scene *scene, double nodes)
{
    for (size_t i = 0; i < scene->count; i++) {
        int rate = 0;
        while (rate + 1 < MLRTA_RATES && scene->tiles[i].complexity >= nodes * mlrta_rate_samples[rate + 1] * mlrta_rate_samples[rate + 1])
            rate++;
        scene->rates[i] = (unsigned char)rate;
    }
    return sampling_of(scene);
}

/* A squared error is worth `price` times as many rays. */
static mlrta_sampling by_error(const mlrta_adaptive_scene *scene, double price)
{
    for (size_t i = 0; i < scene->count; i++) {
        const mlrta_adaptive_tile *tile = &scene->tiles[i];
        int best = 0;
        for (int rate = 1; rate < MLRTA_RATES; rate++)
            if (price * tile->error[rate] + tile->rays[rate] < price * tile->error[best] + tile->rays[best])
                best = rate;
        scene->rates[i] = (unsigned char)best;
    }
    return sampling_of(scene);
}

/* Tiles of least to most complexity, in classes: exact, so the same on every host. */
static int class_of(double complexity)
{
    int exponent;
    const double part = frexp(1 + complexity, &exponent); /* 1/2 <= part < 1 */
    const int class = 2 * (exponent - 1) + (part >= 0.75);
    return class < CLASSES ? class : CLASSES - 1;
}

/* Sums over the classes below one. */
typedef struct class_sums {
    double rays[CLASSES + 1][MLRTA_RATES], error[CLASSES + 1][MLRTA_RATES];
} class_sums;

static class_sums sum_classes(const mlrta_adaptive_scene *scene)
{
    class_sums sums = {0};
    for (size_t i = 0; i < scene->count; i++)
        for (int rate = 0; rate < MLRTA_RATES; rate++) {
            const int at = class_of(scene->tiles[i].complexity) + 1;
            sums.rays[at][rate] += scene->tiles[i].rays[rate];
            sums.error[at][rate] += scene->tiles[i].error[rate];
        }
    for (int at = 1; at <= CLASSES; at++)
        for (int rate = 0; rate < MLRTA_RATES; rate++) {
            sums.rays[at][rate] += sums.rays[at - 1][rate];
            sums.error[at][rate] += sums.error[at - 1][rate];
        }
    return sums;
}

/* The sum with rate r for the classes from step r on, up to the next step. */
static double with_steps(double (*below)[MLRTA_RATES], const int steps[MLRTA_RATES + 1])
{
    double sum = 0;
    for (int rate = 0; rate < MLRTA_RATES; rate++)
        sum += below[steps[rate + 1]][rate] - below[steps[rate]][rate];
    return sum;
}

/* The cheapest steps whose error is no more than `error`; those of `even` are where nothing is better. */
static mlrta_sampling by_steps(const mlrta_adaptive_scene *scene, double error, int even)
{
    class_sums sums = sum_classes(scene);
    double fewest = HUGE_VAL;
    int best[MLRTA_RATES + 1] = {0};
    for (int a = 0; a <= CLASSES; a++)
        for (int b = a; b <= CLASSES; b++)
            for (int c = b; c <= CLASSES; c++) {
                const int steps[MLRTA_RATES + 1] = {0, a, b, c, CLASSES};
                const double rays = with_steps(sums.rays, steps);
                if (rays < fewest && with_steps(sums.error, steps) <= error) {
                    fewest = rays;
                    memcpy(best, steps, sizeof best);
                }
            }
    for (size_t i = 0; i < scene->count; i++) {
        int rate = even;
        for (int r = 0; r < MLRTA_RATES; r++)
            if (class_of(scene->tiles[i].complexity) >= best[r] && class_of(scene->tiles[i].complexity) < best[r + 1])
                rate = r;
        scene->rates[i] = (unsigned char)rate;
    }
    return sampling_of(scene);
}

/* More and more samples, from the least everywhere to the most; `at` counts up. */
static mlrta_sampling sweep(const mlrta_adaptive_scene *scene, mlrta_way way, int at, double factor)
{
    double most = 1;
    for (size_t i = 0; i < scene->count; i++)
        most = fmax(most, scene->tiles[i].complexity);
    for (int i = 0; i < at; i++)
        most *= factor;
    return way == MLRTA_BY_ROOT ? by_root(scene, 2 * most) : by_error(scene, 1 / most);
}

mlrta_sampling mlrta_choose_samples(const mlrta_adaptive_scene *scene, mlrta_way way, int rate)
{
    const mlrta_sampling even = evenly(scene, rate);
    const double squares = 3 * scene->pixels * even.rmse * even.rmse, fine = 0.96875;
    if (way == MLRTA_BY_STEPS)
        return by_steps(scene, squares * (1 + 0x1p-40), rate); /* the even rate is one of the choices, whatever is rounded */
    if (way == MLRTA_EVENLY)
        return even;
    int at = 0, enough = 2000;
    while (at < enough && sweep(scene, way, at, fine).rmse > even.rmse)
        at++;
    return sweep(scene, way, at, fine);
}

static void add_row(report_table *t, const mlrta_adaptive_scene *scene, int rate, mlrta_way way)
{
    const mlrta_sampling even = evenly(scene, rate), s = mlrta_choose_samples(scene, way, rate);
    report_table_begin_row(t);
    report_table_add_text(t, scene->name);
    report_table_add_text(t, rate_names[rate]);
    report_table_add_text(t, way_names[way]);
    report_table_add_real(t, s.rmse);
    report_table_add_real(t, way == MLRTA_EVENLY ? (double)NAN : s.by_chance);
    for (int r = 0; r < MLRTA_RATES; r++)
        report_table_add_real(t, 100 * s.share[r]);
    report_table_add_real(t, s.rays);
    report_table_add_real(t, s.cycles);
    report_table_add_real(t, way == MLRTA_EVENLY ? (double)NAN : 100 * (1 - s.rays / even.rays));
    report_table_add_real(t, way == MLRTA_EVENLY ? (double)NAN : 100 * (1 - s.cycles / even.cycles));
}

static void add_notes(report_table *t)
{
    char note[300];
    snprintf(note, sizeof note, "Published: adaptive anti-aliasing by complexity saves %.0f%% of the rays at equal quality, a preliminary result on "
                                "pictures that are not named.", mlrta_paper_text("all", "adaptive anti-aliasing", "rays_saved"));
    report_table_add_note(t, note);
    report_table_add_note(t, "By the root: the fewest rays with samples in proportion to the square root of the complexity. Best steps: the three "
                             "complexities at which samples change are chosen with the reference at hand. By error: each tile's error is known; no "
                             "measure can do better. By chance: the RMSE to expect if as many tiles had each number of samples, but not which.");
}

report_table *mlrta_adaptive_table(const mlrta_adaptive_scene *scenes, size_t count, const char *caption)
{
    report_table *t = report_table_create("Samples by complexity against even samples, at equal error of the picture");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "as good as", .unit = "samples", .align = REPORT_ALIGN_RIGHT});
    report_table_add_column(t, &(report_column){.name = "samples given"});
    report_table_add_real_column(t, "RMSE", NULL, 5);
    report_table_add_real_column(t, "by chance", NULL, 5);
    for (int r = 0; r < MLRTA_RATES; r++) {
        char name[40];
        snprintf(name, sizeof name, "tiles with %s", rate_names[r]);
        report_table_add_real_column(t, name, "%", 1);
    }
    report_table_add_real_column(t, "rays", "a pixel", 3);
    report_table_add_real_column(t, "cycles", "a pixel", 1);
    report_table_add_real_column(t, "rays saved", "%", 1);
    report_table_add_real_column(t, "cycles saved", "%", 1);
    for (size_t i = 0; i < count; i++)
        for (int rate = 1; rate + 1 < MLRTA_RATES; rate++) {
            report_table_begin_group(t, NULL);
            for (int way = 0; way < MLRTA_WAYS; way++)
                add_row(t, &scenes[i], rate, (mlrta_way)way);
        }
    add_notes(t);
    return t;
}

void mlrta_adaptive_plot_of(const mlrta_adaptive_scene *scene, mlrta_adaptive_plot *out)
{
    static const mlrta_way ways[MLRTA_ADAPTIVE_CURVES] = {MLRTA_EVENLY, MLRTA_BY_ROOT, MLRTA_BY_ERROR};
    snprintf(out->title, sizeof out->title, "Error against rays, %.150s", scene->name);
    for (int i = 0; i < MLRTA_ADAPTIVE_CURVES; i++) {
        const size_t count = ways[i] == MLRTA_EVENLY ? MLRTA_RATES : MLRTA_ADAPTIVE_POINTS;
        for (size_t p = 0; p < count; p++) {
            const mlrta_sampling s = ways[i] == MLRTA_EVENLY ? evenly(scene, (int)p) : sweep(scene, ways[i], (int)p, 0.5);
            out->rays[i][p] = s.rays;
            out->rmse[i][p] = s.rmse;
        }
        out->series[i] = (report_series){.name = way_names[ways[i]], .x = out->rays[i], .y = out->rmse[i], .count = count, .line = REPORT_LINE_POINTS};
    }
}
