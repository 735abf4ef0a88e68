// What is painted on vertices by lists of SUPPLE_deformers, each entry by a vertex attribute. Private to cage/gltf/.
#pragma once

#include "cage/character.h"
#include "cage/gltf/document.h"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace supple::cage::gltf {

/// Weights from 0 to 1, one a vertex, of an attribute that `name` calls. Throws Refusal.
[[nodiscard]] std::vector<float> readPaintedWeights(const Document& document, int accessor, size_t count,
                                                    const std::string& name);
/// The name of an attribute of weights that are painted, which must begin with _. Throws Refusal.
[[nodiscard]] std::string paintedName(const Json& from, const char* key, const std::string& element);

/// The accessor of a primitive that has an attribute, or -1.
[[nodiscard]] int paintedAccessor(const file::Primitive& primitive, const std::string& name);

/// An entry: the vertex attribute that has its weights, and what messages call it.
struct Painted {
    std::string weights, place;
    bool isPainted = false; ///< a vertex has a weight of it, be it the most or not
};

/// The list `key` of a mesh, `most` entries at most. Calls read(entry, place) for each that has an attribute of its
/// own; one that it refuses is left out.
[[nodiscard]] std::vector<Painted> readPainted(const Document& document, size_t meshIndex, const char* key, size_t most,
                                               const std::function<void(const Json&, const std::string&)>& read);

/// The accessors of a primitive that have the weights, by entry; -1: it is not painted. Appends them.
void findPainted(const file::Primitive& primitive, std::span<const Painted> painted, std::vector<int>& accessors);

/// Appends what a primitive's `count` vertices have. A vertex that several entries are painted on has the one with most
/// weight, the first of equal ones. `weights` stays empty until a vertex has some.
void appendPaintedWeights(const Document& document, std::span<const int> accessors, size_t firstVertex, size_t count,
                          const std::string& element, std::span<Painted> painted, std::vector<PaintedWeight>& weights);

/// Leaves out entries that no vertex has, of all vertices of a mesh, and returns the others, rising. One that is
/// painted nowhere is a fault; one that has the most weight nowhere is not.
[[nodiscard]] std::vector<size_t> usedPainted(const Document& document, std::span<const Painted> painted,
                                              std::vector<PaintedWeight>& weights);

} // namespace supple::cage::gltf
