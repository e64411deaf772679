/* Where the bytes of a glTF buffer come from: the file itself, a data: URI, another file. */
#ifndef SCENE_GLTF_BUFFER_HPP
#define SCENE_GLTF_BUFFER_HPP

#include <deque>
#include <string>
#include <vector>

#include "scene/gltf_container.hpp"

namespace gltf {

/* What the file says about a buffer. */
struct buffer_place {
    size_t index;              /* for errors */
    size_t size;               /* its byteLength */
    const std::string *uri;    /* NULL: none, so it is the binary chunk */
    const span *binary;        /* NULL unless this may be the binary chunk of a .glb */
    const std::string *folder; /* of external files, with its final slash; NULL: there can be none */
};

/**
 * The first `size` bytes of a buffer; what was not in memory before is put into *owned.
 *
 * Errors (failure): fewer bytes than `size`, base64 that is none, a path that is absolute or holds `..`, a file that
 * cannot be read.
 */
span read_buffer(const buffer_place &place, std::deque<std::vector<uint8_t>> *owned);

} // namespace gltf

#endif
