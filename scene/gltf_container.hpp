/* The outside of a glTF file: bytes, and where JSON and binary data lie in them. */
#ifndef SCENE_GLTF_CONTAINER_HPP
#define SCENE_GLTF_CONTAINER_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gltf {

/* Larger files are refused, and so are files whose buffers are larger together. */
constexpr size_t max_file_bytes = size_t(1) << 31;

/* Objects and arrays within each other; a scene needs about ten. Parsers recurse, so this bounds their stack. */
constexpr int max_json_depth = 256;

/* Bytes that somebody else owns. */
struct span {
    const uint8_t *data = nullptr;
    size_t size = 0;
};

/* The two parts of a file, which point into it; `binary` is empty in a .gltf. */
struct container {
    bool is_glb = false;
    span json, binary;
};

/**
 * The contents of a regular file, or its first `limit` bytes.
 *
 * Errors (failure): cannot be opened or read, not a regular file, more than max_file_bytes.
 */
std::vector<uint8_t> read_file(const std::string &path, size_t limit = max_file_bytes);

/**
 * Find JSON and binary data in a .glb (known by its magic number) or the text of a .gltf.
 *
 * Errors (failure): GLB header or chunk sizes that do not fit the file, another version than 2, JSON nested
 * deeper than max_json_depth.
 */
container split(span file);

} // namespace gltf

#endif
