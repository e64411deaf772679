/* The view of packets of 256 rays between packets of 16 and multi-frusta tracing (Benthin and Wald 2009, 5.2), beside what the paper
 * says of them in words.
 *
 *   scene      rays     boxes against frusta  AABB tests / frusta's  speed against frusta  speed against packets of 16
 *   hall-60k   primary  -3.2%                 ...
 *   published  any      -4 to -3%                                    at most 50%
 */
#ifndef REPORTS_VIEWS_MFT_PACKET256_H
#define REPORTS_VIEWS_MFT_PACKET256_H

#include "reports/views/mft_table1.h"

/* Primary rays, or primary rays and soft shadows, of one scene; `packet16` says which. */
typedef struct mft_packet256_row {
    mft_row packet16, packet256, frusta; /* AABB tests are of 16 lanes; the algorithm of packet256 is that of packet16 */
    double boxes;                        /* tested for groups of 256 rays */
} mft_packet256_row;

/** All runs. NULL if out of memory. */
report_table *mft_packet256_counts(const mft_packet256_row *rows, size_t count, const char *caption);

/** Packets of 256 rays against frusta and against packets of 16, and the paper's words. NULL if out of memory. */
report_table *mft_packet256_ratios(const mft_packet256_row *rows, size_t count, const char *caption);

#endif
