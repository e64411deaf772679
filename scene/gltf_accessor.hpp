/* Accessors of a glTF file: typed elements in a buffer, strided, sparse or both; read one at a time, never copied. */
#ifndef SCENE_GLTF_ACCESSOR_HPP
#define SCENE_GLTF_ACCESSOR_HPP

#include <cstddef>
#include <cstdint>

#include "scene/gltf_document.hpp"

namespace gltf {

/* An accessor without a bufferView is all zeros but for its sparse elements; files that ask for more are refused. */
constexpr size_t max_zero_elements = size_t(1) << 20;

/* Elements that lie side by side, already checked to be within their buffer. */
struct elements {
    const uint8_t *first = nullptr;
    size_t stride = 0;
};

/* A checked accessor. Points into the document's buffers. */
class accessor {
public:
    /** Errors (failure): a bufferView, buffer or size that does not fit; sparse indices not in rising order. */
    accessor(const document &doc, size_t index);

    size_t count() const { return count_; }
    int type() const { return type_; }                     /* TINYGLTF_TYPE_... */
    int component_type() const { return component_type_; } /* TINYGLTF_COMPONENT_TYPE_... */

    /** Component `component` of element `i` < count() as a number, normalised if the accessor says so. */
    double number(size_t i, int component) const;

    /** Element `i` < count() of a SCALAR of unsigned integers. */
    uint32_t integer(size_t i) const;

private:
    const uint8_t *element(size_t i) const;
    elements view(const document &doc, int view, size_t offset, size_t count, size_t element_bytes, bool strided) const;
    void read_sparse(const document &doc, const tinygltf::Accessor &source, size_t element_bytes);

    size_t index_, count_;
    int type_, component_type_;
    bool normalized_;
    elements dense_;
    size_t sparse_count_ = 0;
    int sparse_type_ = 0;
    elements sparse_indices_, sparse_values_;
};

} // namespace gltf

#endif
