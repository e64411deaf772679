/* A session: kernels of the user's own, counted and timed on a simulated machine.
 *
 *     lanetrace_session *s;
 *     lrb_segment xs;
 *     lrb_ctx *c;
 *     lanetrace_open(&(lanetrace_options){.name = "saxpy"}, &s, &err);
 *     lanetrace_map(s, "x", x, sizeof x, &xs, &err);
 *     lanetrace_begin(s, &c, &err);         from here on the ops of this thread are accounted for
 *     saxpy(c, lrb_segment_at(xs, 0), n);   written with lrb_ ops, or with intrinsics (lanetrace/lrbni_intrinsics.h)
 *     lanetrace_end(s, &err);
 *     lanetrace_print(s, stdout, &err);
 *     lanetrace_close(&s);
 *
 * What lies between begin and end is a piece of work. Each piece is timed from an empty pipeline, like a tile of a picture;
 * pieces may run on several host threads at once, and the sums do not depend on which. A kernel is compiled with
 * LRB_LEVEL 2 (LRB_RECORD) to be timed; LRB_LEVEL 1 (LRB_COUNT) is enough for the model `count`, and LRB_LEVEL 0 leaves
 * nothing to account for. Public C interface; the errors are those of lrbni/base/status.h.
 */
#ifndef LANETRACE_SESSION_H
#define LANETRACE_SESSION_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "lrbni/base/status.h"
#include "lrbni/ctx.h"

typedef struct lanetrace_session lanetrace_session;

/* What a session is asked for; a zero is a default. The strings need not outlive lanetrace_open. */
typedef struct lanetrace_options {
    const char *name;          /* of what is run, for the reports; "kernel" */
    const char *machine;       /* a built-in machine's name or the path of a description; "larrabee" */
    const char *model;         /* "count" or "issue" (docs/machine-model.md); "issue" */
    const char *const *set;    /* `sets` overrides of the machine, as "vector_alu.latency=5" */
    size_t sets;
    const char *const *phases; /* names of the phases 0, 1, ... that the kernel marks, `phase_count` of them, at most 16 */
    size_t phase_count;
} lanetrace_options;

/**
 * Open a session; close it with lanetrace_close.
 *
 * @param options  NULL: all defaults
 * @param out      receives the session; NULL after a failure
 *
 * Errors: BASE_ERR_USAGE (no such machine, model or field, too many phases), BASE_ERR_INPUT (a description that is wrong),
 * BASE_ERR_NOMEM.
 */
base_status lanetrace_open(const lanetrace_options *options, lanetrace_session **out, base_error *err);

/** Free a session, which may be NULL, and set the pointer to NULL. No piece may be under way. */
void lanetrace_close(lanetrace_session **s);

/**
 * Give an array an address on the simulated machine, behind all arrays mapped before and a multiple of 4096 whatever its host
 * address is. Between pieces only.
 *
 * @param name  for errors
 * @param host  `size` bytes, owned by the caller, at this place until lanetrace_unmap or lanetrace_close
 * @param out   for lrb_segment_at; may be NULL
 *
 * Errors: BASE_ERR_USAGE if it overlaps an array that is mapped, BASE_ERR_INPUT if the simulated memory (2 GiB of arrays) is
 * full, BASE_ERR_NOMEM.
 */
base_status lanetrace_map(lanetrace_session *s, const char *name, void *host, size_t size, lrb_segment *out, base_error *err);

/** Forget the array that was mapped at `host`, before its memory is freed; nothing if there is none. Between pieces only. */
void lanetrace_unmap(lanetrace_session *s, const void *host);

/**
 * Begin a piece of work on the calling thread.
 *
 * @param c  receives the context of its ops, owned by the session, valid until lanetrace_end; may be NULL
 *
 * Errors: BASE_ERR_USAGE if the thread has a piece under way, BASE_ERR_NOMEM.
 */
base_status lanetrace_begin(lanetrace_session *s, lrb_ctx **c, base_error *err);

/**
 * End the calling thread's piece of work.
 *
 * Errors: BASE_ERR_USAGE if there is none, or if its kernel was compiled without the events that the model needs;
 * BASE_ERR_INPUT if it touched more unmapped memory than there are addresses; BASE_ERR_NOMEM.
 */
base_status lanetrace_end(lanetrace_session *s, base_error *err);

/** The context of the calling thread's piece of work; NULL if it has none. */
lrb_ctx *lanetrace_ctx(void);

/**
 * Simulated address of a byte of host memory, for the calling thread's piece of work: within a mapped array that array's;
 * anywhere else by the order in which the piece first touches each line of 64 bytes, so that no host address reaches a result
 * but its last six bits. Another piece may give an unmapped line another address.
 */
uint32_t lanetrace_address(const void *host);

/** Totals of all pieces that have ended. */
uint64_t lanetrace_cycles(const lanetrace_session *s);
uint64_t lanetrace_ops(const lanetrace_session *s);

/** How often an op was executed, by its id in ops.def ("add_ps"); 0 for one that there is not. */
uint64_t lanetrace_op_count(const lanetrace_session *s, const char *op);

/**
 * Write ops, cycles and where the cycles went: as a table, and as JSON (schema lanetrace-session-1, docs/interface.md).
 * The same digits on every host. Errors: BASE_ERR_NOMEM; that the stream took the bytes is for the caller to check.
 */
base_status lanetrace_print(const lanetrace_session *s, FILE *out, base_error *err);
base_status lanetrace_write_json(const lanetrace_session *s, FILE *out, base_error *err);

#endif
