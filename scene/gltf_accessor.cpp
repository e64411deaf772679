#include "scene/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>

#include "scene/gltf_failure.hpp"

namespace gltf {

namespace {

/* Bytes of a component; 0 if the specification has no such type. */
size_t component_bytes(int type)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0;
    }
}

/* Components of an element; 0 for matrices, which nothing here reads. */
size_t component_count(int type)
{
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return 1;
    case TINYGLTF_TYPE_VEC2:
        return 2;
    case TINYGLTF_TYPE_VEC3:
        return 3;
    case TINYGLTF_TYPE_VEC4:
        return 4;
    default:
        return 0;
    }
}

const uint8_t zero_element[16] = {0};

uint32_t read_unsigned(const uint8_t *p, int type)
{
    uint32_t value = p[0];
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
        return value;
    value |= uint32_t(p[1]) << 8;
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        return value;
    return value | uint32_t(p[2]) << 16 | uint32_t(p[3]) << 24;
}

/* A signed value from the low bits of its two's complement; normalised, as the specification says, into [-1, 1]. */
double signed_number(uint32_t bits, uint32_t largest, bool normalized)
{
    double value = bits > largest ? double(bits) - 2.0 * (double(largest) + 1) : double(bits);
    return normalized ? std::max(value / largest, -1.0) : value;
}

double read_number(const uint8_t *p, int type, bool normalized)
{
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return signed_number(p[0], 127, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return normalized ? p[0] / 255.0 : p[0];
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return signed_number(read_unsigned(p, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT), 32767, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return read_unsigned(p, type) / (normalized ? 65535.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return read_unsigned(p, type);
    default: {
        uint32_t bits = read_unsigned(p, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
        float value;
        memcpy(&value, &bits, sizeof value);
        return double(value);
    }
    }
}

} // namespace

/* `count` elements in a bufferView, every size checked. */
elements accessor::view(const document &doc, int view, size_t offset, size_t count, size_t element_bytes, bool strided) const
{
    if (size_t(view) >= doc.model.bufferViews.size())
        fail("accessor %zu: bufferView %d does not exist (there are %zu)", index_, view, doc.model.bufferViews.size());
    const tinygltf::BufferView &v = doc.model.bufferViews[size_t(view)];
    if (size_t(v.buffer) >= doc.buffers.size())
        fail("bufferView %d: buffer %d does not exist (there are %zu)", view, v.buffer, doc.buffers.size());
    const span &buffer = doc.buffers[size_t(v.buffer)];
    if (v.byteOffset > buffer.size || v.byteLength > buffer.size - v.byteOffset)
        fail("bufferView %d: needs %zu bytes of buffer %d, which has %zu", view, v.byteOffset + v.byteLength, v.buffer,
             buffer.size);
    size_t stride = strided && v.byteStride ? v.byteStride : element_bytes;
    if (stride < element_bytes)
        fail("bufferView %d: byteStride %zu is less than the %zu bytes of an element of accessor %zu", view, stride,
             element_bytes, index_);
    unsigned long long needed = count ? offset + 1ull * stride * (count - 1) + element_bytes : 0;
    if (needed > v.byteLength)
        fail("accessor %zu: needs %llu bytes of bufferView %d, which has %zu", index_, needed, view, v.byteLength);
    return {count ? buffer.data + v.byteOffset + offset : nullptr, stride};
}

accessor::accessor(const document &doc, size_t index) : index_(index)
{
    if (index >= doc.model.accessors.size())
        fail("accessor %zu does not exist (there are %zu)", index, doc.model.accessors.size());
    const tinygltf::Accessor &source = doc.model.accessors[index];
    size_t element_bytes = component_bytes(source.componentType) * component_count(source.type);
    if (element_bytes == 0)
        fail("accessor %zu: type or componentType %d cannot be read here", index, source.componentType);
    count_ = source.count;
    type_ = source.type;
    component_type_ = source.componentType;
    normalized_ = source.normalized;
    if (source.bufferView >= 0)
        dense_ = view(doc, source.bufferView, source.byteOffset, count_, element_bytes, true);
    else if (count_ > max_zero_elements)
        fail("accessor %zu: %zu elements without a bufferView; at most %zu are read", index, count_, max_zero_elements);
    if (source.sparse.isSparse)
        read_sparse(doc, source, element_bytes);
}

void accessor::read_sparse(const document &doc, const tinygltf::Accessor &source, size_t element_bytes)
{
    const auto &sparse = source.sparse;
    size_t index_bytes = component_bytes(sparse.indices.componentType);
    if (sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        sparse.indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail("accessor %zu: sparse.indices: componentType %d is not an unsigned integer", index_,
             sparse.indices.componentType);
    if (size_t(sparse.count) > count_)
        fail("accessor %zu: sparse.count %d is more than count %zu", index_, sparse.count, count_);
    sparse_type_ = sparse.indices.componentType;
    sparse_count_ = size_t(sparse.count);
    size_t indices_offset = size_t(sparse.indices.byteOffset), values_offset = size_t(sparse.values.byteOffset);
    sparse_indices_ = view(doc, sparse.indices.bufferView, indices_offset, sparse_count_, index_bytes, false);
    sparse_values_ = view(doc, sparse.values.bufferView, values_offset, sparse_count_, element_bytes, false);
    for (size_t i = 0, next = 0; i < sparse_count_; i++) {
        size_t at = read_unsigned(sparse_indices_.first + i * index_bytes, sparse_type_);
        if (at < next)
            fail("accessor %zu: sparse.indices are not in rising order", index_);
        if (at >= count_)
            fail("accessor %zu: sparse index %zu is out of range (%zu elements)", index_, at, count_);
        next = at + 1;
    }
}

const uint8_t *accessor::element(size_t i) const
{
    size_t low = 0, high = sparse_count_;
    while (low < high) { /* the first sparse element at or after i */
        size_t middle = low + (high - low) / 2;
        if (read_unsigned(sparse_indices_.first + middle * sparse_indices_.stride, sparse_type_) < i)
            low = middle + 1;
        else
            high = middle;
    }
    if (low < sparse_count_ && read_unsigned(sparse_indices_.first + low * sparse_indices_.stride, sparse_type_) == i)
        return sparse_values_.first + low * sparse_values_.stride;
    return dense_.first ? dense_.first + i * dense_.stride : zero_element;
}

double accessor::number(size_t i, int component) const
{
    return read_number(element(i) + size_t(component) * component_bytes(component_type_), component_type_, normalized_);
}

uint32_t accessor::integer(size_t i) const
{
    return read_unsigned(element(i), component_type_);
}

} // namespace gltf
