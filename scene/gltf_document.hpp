/* A glTF file read and checked: the part of its JSON that makes a scene, and its buffers. */
#ifndef SCENE_GLTF_DOCUMENT_HPP
#define SCENE_GLTF_DOCUMENT_HPP

#include <deque>
#include <string>
#include <vector>

#include "scene/gltf_container.hpp"
#include "scene/gltf_tinygltf.hpp"

namespace gltf {

/* Move-only would do; it is made once and passed by reference. `buffers` may point into the file's own bytes. */
struct document {
    tinygltf::Model model;                 /* its own buffers stay empty */
    std::vector<span> buffers;             /* each cut to its byteLength */
    std::deque<std::vector<uint8_t>> owned; /* what did not come with the file */
};

/**
 * Read the JSON and the buffers of a file.
 *
 * Fields that do not matter to a scene (pictures, animations, other attributes, ...) are dropped unread; the others
 * must have the type that the specification gives them.
 *
 * @param file    must outlive the document
 * @param folder  where external buffers are, with its final slash; NULL: there can be none
 *
 * Errors (failure): bad JSON, a field missing or of the wrong type, a required extension that is not known, a
 * buffer that cannot be read or is too short.
 */
document read_document(span file, const std::string *folder);

} // namespace gltf

#endif
