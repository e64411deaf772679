/* Kd-trees kept in files: what takes minutes to build takes seconds to read. docs/kd-tree.md describes the format. */
#ifndef KERNELS_ACCEL_KDTREE_FILE_H
#define KERNELS_ACCEL_KDTREE_FILE_H

#include "kernels/accel/kdtree.h"

/**
 * Write a tree: nodes, lists, numbers of triangles and components, sets; neither sizes nor records, which follow from
 * those and the scene. Marks of occluders are not kept.
 *
 * @param s, options  what it was built from: they are the file's key
 *
 * Errors: those of base_output_begin and base_output_commit.
 */
base_status kdtree_write(const kdtree *tree, const scene *s, const kdtree_options *options, const char *path, base_error *err);

/**
 * Read a tree back: equal, byte for byte, to what was written.
 *
 * The file is not trusted: its key must be that of the scene and the options (jobs do not count), its length that which its
 * counts ask for, before anything is allocated for them; its checksum must be right, and every link, plane, entry and
 * number must be one that a tree of this scene may have.
 *
 * @param out  free with kdtree_destroy
 *
 * Errors: BASE_ERR_INPUT naming the path, BASE_ERR_NOMEM.
 */
base_status kdtree_read(const char *path, const scene *s, const kdtree_options *options, kdtree **out, base_error *err);

/**
 * The tree of a scene from a folder of such files, or built and put there.
 *
 * @param folder  NULL: no files, as kdtree_build; it is made if it is not there
 * @param out     free with kdtree_destroy
 * @param note    out: status BASE_OK, or why the file that is there was not used, or why none was written; the tree is
 *                right all the same
 *
 * Errors: those of kdtree_build.
 */
base_status kdtree_open(const scene *s, const kdtree_options *options, const char *folder, kdtree **out, base_error *note,
                        base_error *err);

#endif
