/* tinygltf as this library uses it: JSON text to structures, no files and no pictures. Include it only from here. */
#ifndef SCENE_GLTF_TINYGLTF_HPP
#define SCENE_GLTF_TINYGLTF_HPP

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

#endif
