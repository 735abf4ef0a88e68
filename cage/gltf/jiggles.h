// What jiggles of a glTF file: `jiggle` of SUPPLE_deformers. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// With the vertex attribute that has its weights, and what messages call it.
struct PaintedJiggle {
    Jiggle jiggle;
    std::string weights, place;
    bool isPainted = false; ///< a vertex has a weight of it, be it the most or not
};

/// Those of a mesh.
[[nodiscard]] std::vector<PaintedJiggle> readJiggles(const Document& document, size_t meshIndex);

/// The accessors of a primitive that have the weights, by jiggle; -1: it is not painted.
[[nodiscard]] std::vector<int> jiggleAccessors(const file::Primitive& primitive,
                                               std::span<const PaintedJiggle> jiggles);

/// Appends what a primitive's `count` vertices have. A vertex that several jiggles are painted on has the one with most
/// weight, the first of equal ones. `weights` stays empty until a vertex has some.
void appendJiggleWeights(const Document& document, std::span<const int> accessors, size_t firstVertex, size_t count,
                         const std::string& element, std::span<PaintedJiggle> jiggles,
                         std::vector<JiggleWeight>& weights);

/// Leaves out jiggles that no vertex has, of all vertices of a mesh. One that is painted nowhere is a fault; one that
/// has the most weight nowhere is not.
[[nodiscard]] std::vector<Jiggle> usedJiggles(const Document& document, std::span<const PaintedJiggle> jiggles,
                                              std::vector<JiggleWeight>& weights);

} // namespace supple::cage::gltf
