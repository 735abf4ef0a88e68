// Nodes of a glTF file: the skeleton, and which node's mesh is read. Private to cage/gltf/. All of these throw Refusal.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"
#include "cage/message.h"

#include <cstdint>
#include <string>

namespace supple::cage::gltf {

[[nodiscard]] Skeleton readSkeleton(const Document& document);

/// The first node with a mesh and a skin, in scene order, then node order; else the first with a mesh.
[[nodiscard]] uint32_t chooseMeshNode(const Document& document, Warnings& warnings);

/// Makes the last row exactly 0 0 0 1; refuses a matrix in which it is something else.
void makeAffine(glm::mat4& matrix, const std::string& element);

} // namespace supple::cage::gltf
