/* The table that kernels/embed.py writes. Private to kernels/sources.c. */
#ifndef KERNELS_SOURCE_TEXTS_H
#define KERNELS_SOURCE_TEXTS_H

#include "kernels/sources.h"

extern const kernel_source kernel_source_texts[];
extern const size_t kernel_source_text_count;

#endif
