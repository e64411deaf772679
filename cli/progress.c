#include "cli/progress.h"

#include <stdio.h>
#include <unistd.h>

#include "cli/clock.h"

enum { WIDTH = 40 };
static const double first_after = 0.3, redraw_after = 0.1; /* seconds */

progress progress_begin(const char *label, size_t total, bool wanted)
{
    progress p = {.label = label, .total = total, .shown = wanted && isatty(STDERR_FILENO)};
    atomic_init(&p.done, 0);
    p.start = p.last = clock_seconds();
    return p;
}

void progress_step(progress *p, unsigned worker)
{
    size_t done = atomic_fetch_add_explicit(&p->done, 1, memory_order_relaxed) + 1;
    if (!p->shown || worker != 0)
        return;
    double now = clock_seconds();
    if (now - p->start < first_after || now - p->last < redraw_after)
        return;
    p->last = now;
    int full = (int)(done * WIDTH / p->total);
    double left = (now - p->start) * (double)(p->total - done) / (double)done;
    fprintf(stderr, "\r%-18s [%.*s%*s] %3d %%  %.0f s left ", p->label, full, "########################################",
            WIDTH - full, "", (int)(done * 100 / p->total), left);
    fflush(stderr);
}

void progress_end(progress *p)
{
    if (p->shown && p->last > p->start)
        fprintf(stderr, "\r\033[K");
}
