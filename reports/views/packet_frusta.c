#include "reports/views/packet_frusta.h"

#include "reports/views/mft_paper.h"

static void add_side(report_table *t, const char *scene, const char *algorithm, const packet_frusta_side *s)
{
    const uint64_t numbers[] = {s->rays, s->tri_accesses, s->tri_after_culling, s->aabb_tests, s->isect_tests, s->count_cycles, s->issue_cycles};
    report_table_begin_row(t);
    report_table_add_text(t, scene);
    report_table_add_text(t, algorithm);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        report_table_add_real(t, (double)numbers[i]);
    report_table_add_missing(t); /* published */
    report_table_add_real(t, (double)s->issue_cycles / (double)s->rays);
}

static void add_paper_side(report_table *t, size_t scene, mft_algorithm algorithm)
{
    const mft_paper_row row = mft_paper_row_of(scene, algorithm);
    report_table_begin_row(t);
    report_table_add_text(t, mft_scenes[scene].name);
    report_table_add_text(t, mft_algorithm_names[algorithm]);
    report_table_add_real(t, mft_paper_pixels);
    for (int m = 0; m < MFT_CYCLES; m++)
        report_table_add_real(t, row.value[m]);
    report_table_add_missing(t); /* the models' */
    report_table_add_missing(t);
    report_table_add_real(t, row.value[MFT_CYCLES]);
    report_table_add_real(t, row.value[MFT_CYCLES] / mft_paper_pixels);
}

report_table *packet_frusta_counts(const packet_frusta_row *rows, size_t count, const char *caption)
{
    static const char *const names[] = {"rays", "triangle accesses", "after culling", "AABB tests", "intersection tests",
                                        "cycles, count model", "cycles, issue model", "cycles, published"};
    report_table *t = report_table_create("Primary rays: packets against multi-frusta tracing");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    report_table_add_column(t, &(report_column){.name = "algorithm"});
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        report_table_add_real_column(t, names[i], NULL, 0);
    report_table_add_real_column(t, "cycles per ray", NULL, 1);
    report_table_begin_group(t, "measured");
    for (size_t i = 0; i < count; i++) {
        add_side(t, rows[i].scene, "P-Packet", &rows[i].packet);
        add_side(t, rows[i].scene, "P-Frusta", &rows[i].frusta);
    }
    report_table_begin_group(t, "published: Benthin and Wald 2009, Table 1");
    for (size_t i = 0; i < MFT_SCENES; i++) {
        add_paper_side(t, i, MFT_P_PACKET);
        add_paper_side(t, i, MFT_P_FRUSTA);
    }
    report_table_add_note(t, "The built-in scenes stand in for the paper's: they share the number of triangles and nothing else, and hold "
                             "other cameras. The paper's cycles are those of its own simulator of a core, of which it tells little; the issue "
                             "model's are those of one thread that has a core to itself and always hits its cache, and stalls that "
                             "other threads would hide count in full. Compare ratios. Cycles per ray: issue model or published.");
    report_table_add_note(t, "AABB tests and intersection tests are 16-lane operations: one box or triangle against 16 rays or 16 frusta.");
    return t;
}

static void add_ratio(report_table *t, uint64_t packet, uint64_t frusta)
{
    report_table_add_real(t, (double)packet / (double)frusta);
}

report_table *packet_frusta_reductions(const packet_frusta_row *rows, size_t count, const char *caption)
{
    static const char *const names[] = {"triangle accesses", "after culling", "AABB tests", "intersection tests",
                                        "cycles, count model", "cycles, issue model", "cycles, published"};
    report_table *t = report_table_create("Reductions: packets / frusta");
    report_table_set_caption(t, caption);
    report_table_add_column(t, &(report_column){.name = "scene"});
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        report_table_add_real_column(t, names[i], NULL, 2);
    report_table_begin_group(t, "measured");
    for (size_t i = 0; i < count; i++) {
        const packet_frusta_side *p = &rows[i].packet, *f = &rows[i].frusta;
        report_table_begin_row(t);
        report_table_add_text(t, rows[i].scene);
        add_ratio(t, p->tri_accesses, f->tri_accesses);
        add_ratio(t, p->tri_after_culling, f->tri_after_culling);
        add_ratio(t, p->aabb_tests, f->aabb_tests);
        add_ratio(t, p->isect_tests, f->isect_tests);
        add_ratio(t, p->count_cycles, f->count_cycles);
        add_ratio(t, p->issue_cycles, f->issue_cycles);
        report_table_add_missing(t); /* published */
    }
    report_table_begin_group(t, "published: Benthin and Wald 2009, Table 1");
    for (size_t i = 0; i < MFT_SCENES; i++) {
        const mft_paper_row packet = mft_paper_row_of(i, MFT_P_PACKET), frusta = mft_paper_row_of(i, MFT_P_FRUSTA);
        report_table_begin_row(t);
        report_table_add_text(t, mft_scenes[i].name);
        for (int m = 0; m < MFT_METRICS; m++) {
            for (int model = 0; m == MFT_CYCLES && model < 2; model++)
                report_table_add_missing(t); /* the models' */
            report_table_add_real(t, packet.value[m] / frusta.value[m]);
        }
    }
    report_table_add_note(t, "Published ratios are formed from the published, rounded counts; two cells of the Fern and Fairy Forest rows are "
                             "uncertain readings (reports/papers/mft_table1.csv).");
    return t;
}
