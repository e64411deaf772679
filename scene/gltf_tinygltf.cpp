/* The body of tinygltf, compiled here and not linked from a shared library: so the sanitizers and the fuzzer see it,
   and the program starts without its picture libraries. */
#include <fstream> /* the header needs it even with TINYGLTF_NO_FS */

#define TINYGLTF_IMPLEMENTATION
#include "scene/gltf_tinygltf.hpp"
