/* More markers in the stream: kernels that are compiled at LRB_RECORD with LRB_ANNOTATED defined put one before every op that
 * is not written in the line of the one before it, and one for each source that was made LRB_FAR ops ago or more
 * (lrb_at_line and lrb_put_far, lrbni/ctx.h). Nothing else of the stream changes.
 *
 * Each op becomes a macro of its own name, which names the line to a function around the op. A call of an op stands on one
 * line of the source: which line a compiler takes for a call over several is its own affair.
 */
#ifndef LRBNI_ANNOTATE_H
#define LRBNI_ANNOTATE_H

#include "lrbni/ops/scalar.h"
#include "lrbni/op_lines.h" /* made by lrbni/op_lines.py */

#endif
