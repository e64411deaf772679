/* How the parts of the glTF loader fail: an exception that scene_gltf_load turns into a base_error. */
#ifndef SCENE_GLTF_FAILURE_HPP
#define SCENE_GLTF_FAILURE_HPP

#include <cstdarg>
#include <cstdio>
#include <stdexcept>

namespace gltf {

/* what() is the `why` of the base_error: one sentence that names the field. */
struct failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/** Throw a failure whose text is made as by printf. */
[[noreturn]]
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
inline void fail(const char *format, ...)
{
    char text[512];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    throw failure(text);
}

} // namespace gltf

#endif
