// Textures of a glTF file with their images and samplers, and how its objects refer to them. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <string>
#include <vector>

namespace supple::cage::gltf {

/// The file's textures, in its order: how each is sampled, `image` of a core format and `alternateImage` of an
/// extension, also where these are missing. One that is faulty has no image. Throws Refusal.
[[nodiscard]] std::vector<Texture> readTextures(const Json& root, Leniency& leniency, Warnings& warnings);

/// The UV set and the transform that a textureInfo names, and the sampler of its texture. The images are as
/// readTextures() has them. A UV set beyond the second is kept as it is. Throws Refusal.
[[nodiscard]] Texture readTextureInfo(const Document& document, const Json& info, const std::string& element);

} // namespace supple::cage::gltf
