/* The view of MFT Table 1's primary rows: packets against frusta, measured, beside the published values.
 *
 *   scene          algorithm  rays       #tris    +culling  #AABB    #isec    cycles (count)  cycles (issue)  per ray
 *   rooms-804      P-Packet   1,048,576  170,515  ...
 *                  P-Frusta   1,048,576   42,962  ...
 */
#ifndef REPORTS_VIEWS_PACKET_FRUSTA_H
#define REPORTS_VIEWS_PACKET_FRUSTA_H

#include <stdint.h>

#include "reports/table.h"

/* One algorithm on one scene. */
typedef struct packet_frusta_side {
    uint64_t rays, tri_accesses, tri_after_culling, aabb_tests, isect_tests;
    uint64_t count_cycles, issue_cycles;
} packet_frusta_side;

typedef struct packet_frusta_row {
    const char *scene;
    uint64_t triangles;
    packet_frusta_side packet, frusta;
} packet_frusta_row;

/** What was counted, scene by scene, then the paper's four scenes; NULL if out of memory. */
report_table *packet_frusta_counts(const packet_frusta_row *rows, size_t count, const char *caption);

/** The reductions, packets / frusta, then the paper's; NULL if out of memory. */
report_table *packet_frusta_reductions(const packet_frusta_row *rows, size_t count, const char *caption);

#endif
