/* FNV-1a, 64 bits: names the contents of scenes and machine descriptions in statistics. Not for security. */
#ifndef LRBNI_BASE_HASH_H
#define LRBNI_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define BASE_HASH_START UINT64_C(0xcbf29ce484222325)

/** Continue a hash over `size` bytes; start from BASE_HASH_START. Multi-byte data must be little-endian in memory. */
static inline uint64_t base_hash(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *byte = (const unsigned char *)data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ byte[i]) * UINT64_C(0x100000001b3);
    return hash;
}

#endif
