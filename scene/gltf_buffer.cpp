#include "scene/gltf_buffer.hpp"

#include <cstring>

#include "scene/gltf_failure.hpp"

namespace gltf {

namespace {

int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::vector<uint8_t> decode_base64(size_t index, const char *text, size_t size)
{
    std::vector<uint8_t> bytes;
    uint32_t bits = 0;
    while (size > 0 && text[size - 1] == '=')
        size--;
    bytes.reserve(size / 4 * 3 + 3);
    for (size_t i = 0; i < size; i++) {
        int digit = base64_digit(text[i]);
        if (digit < 0)
            fail("buffer %zu: uri: character %zu of the data is not base64", index, i);
        bits = bits << 6 | static_cast<uint32_t>(digit);
        if (i % 4 != 0) /* each digit after the first of four completes a byte */
            bytes.push_back(static_cast<uint8_t>(bits >> (6 - 2 * (i % 4))));
    }
    if (size % 4 == 1)
        fail("buffer %zu: uri: the base64 data are cut off", index);
    return bytes;
}

int hex_digit(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* A relative path from a URI: %20 becomes a blank. */
std::string decode_path(const std::string &uri)
{
    std::string path;
    for (size_t i = 0; i < uri.size(); i++) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
            path += static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2]));
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

/* A scene may not name files outside its own folder. */
bool leaves_folder(const std::string &path)
{
    static const std::string never("\\:\0", 3);
    if (path.empty() || path[0] == '/' || path.find_first_of(never) != path.npos)
        return true;
    for (size_t start = 0; start <= path.size();) {
        size_t end = path.find('/', start);
        end = end == path.npos ? path.size() : end;
        if (path.compare(start, end - start, "..") == 0)
            return true;
        start = end + 1;
    }
    return false;
}

std::vector<uint8_t> read_external(const buffer_place &place)
{
    std::string path = decode_path(*place.uri);
    if (leaves_folder(path))
        fail("buffer %zu: uri '%s' is not a path inside the file's folder", place.index, path.substr(0, 200).c_str());
    if (!place.folder)
        fail("buffer %zu: uri '%s' names another file, but this scene is in memory", place.index, path.substr(0, 200).c_str());
    try {
        return read_file(*place.folder + path, place.size);
    } catch (const failure &e) {
        fail("buffer %zu: uri '%s': %s", place.index, path.substr(0, 200).c_str(), e.what());
    }
}

} // namespace

span read_buffer(const buffer_place &place, std::deque<std::vector<uint8_t>> *owned)
{
    span bytes;
    if (place.uri) {
        static const char scheme[] = "data:", marker[] = ";base64,";
        if (place.uri->compare(0, strlen(scheme), scheme) == 0) {
            size_t start = place.uri->find(marker);
            if (start == place.uri->npos)
                fail("buffer %zu: uri: data that are not base64", place.index);
            start += strlen(marker);
            owned->push_back(decode_base64(place.index, place.uri->data() + start, place.uri->size() - start));
        } else {
            owned->push_back(read_external(place));
        }
        bytes = {owned->back().data(), owned->back().size()};
    } else if (place.binary) {
        bytes = *place.binary;
    } else {
        fail("buffer %zu: has no uri", place.index);
    }
    if (bytes.size < place.size)
        fail("buffer %zu: byteLength is %zu, but there are %zu bytes", place.index, place.size, bytes.size);
    bytes.size = place.size;
    return bytes;
}

} // namespace gltf
