#include "scene/gltf_container.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "scene/gltf_failure.hpp"

namespace gltf {

namespace {

std::string reason(int error)
{
    return std::generic_category().message(error);
}

uint32_t read_u32(const uint8_t *p)
{
    return uint32_t(p[0]) | uint32_t(p[1]) << 8 | uint32_t(p[2]) << 16 | uint32_t(p[3]) << 24;
}

/* The chunk that starts at *offset, which moves past it. */
span next_chunk(span file, size_t *offset, uint32_t *type)
{
    if (file.size - *offset < 8)
        fail("GLB chunk at byte %zu: its header is cut off", *offset);
    size_t size = read_u32(file.data + *offset);
    size_t left = file.size - *offset - 8;
    *type = read_u32(file.data + *offset + 4);
    if (size > left)
        fail("GLB chunk at byte %zu: has %zu bytes, but the file only %zu more", *offset, size, left);
    span chunk = {file.data + *offset + 8, size};
    *offset += 8 + size;
    return chunk;
}

container split_glb(span file)
{
    const uint32_t type_json = 0x4e4f534a, type_binary = 0x004e4942;
    if (file.size < 12)
        fail("GLB header is cut off: %zu bytes instead of 12", file.size);
    uint32_t version = read_u32(file.data + 4), length = read_u32(file.data + 8), type;
    if (version != 2)
        fail("GLB version %u instead of 2", version);
    if (length != file.size)
        fail("GLB header says %u bytes, but the file has %zu", length, file.size);
    container parts;
    size_t offset = 12;
    parts.is_glb = true;
    parts.json = next_chunk(file, &offset, &type);
    if (type != type_json)
        fail("first GLB chunk is not JSON");
    if (offset < file.size) {
        span second = next_chunk(file, &offset, &type);
        if (type == type_binary)
            parts.binary = second;
    }
    while (offset < file.size) /* the specification lets others follow, to be skipped */
        next_chunk(file, &offset, &type);
    return parts;
}

void check_depth(span json)
{
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < json.size; i++) {
        uint8_t c = json.data[i];
        if (in_string) {
            if (c == '\\')
                i++;
            else if (c == '"')
                in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '{' || c == '[') {
            if (++depth > max_json_depth)
                fail("JSON is nested more than %d deep", max_json_depth);
        } else if (c == '}' || c == ']') {
            depth--;
        }
    }
}

} // namespace

std::vector<uint8_t> read_file(const std::string &path, size_t limit)
{
    struct stat info;
    if (stat(path.c_str(), &info) != 0)
        fail("cannot open: %s", reason(errno).c_str());
    if (!S_ISREG(info.st_mode))
        fail("not a regular file");
    if (uint64_t(info.st_size) > max_file_bytes)
        fail("larger than 2 GiB");
    std::unique_ptr<FILE, int (*)(FILE *)> file(fopen(path.c_str(), "rb"), fclose);
    if (!file)
        fail("cannot open: %s", reason(errno).c_str());
    std::vector<uint8_t> bytes(std::min(static_cast<size_t>(info.st_size), limit));
    errno = 0;
    if (!bytes.empty() && fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
        fail("cannot read: %s", errno ? reason(errno).c_str() : "the file became shorter");
    return bytes;
}

container split(span file)
{
    container parts;
    if (file.size > max_file_bytes)
        fail("larger than 2 GiB");
    if (file.size >= 4 && memcmp(file.data, "glTF", 4) == 0)
        parts = split_glb(file);
    else
        parts.json = file;
    if (parts.json.size == 0)
        fail("empty file");
    check_depth(parts.json);
    return parts;
}

} // namespace gltf
