#include "skinning/soft_nodes.h"

#include "shaders/shared/pose.h"
#include "skinning/cloth_mesh.h"
#include "skinning/delta_mush.h"

#include <algorithm>

namespace supple::skinning {

using cage::kNone;

bool jiggles(const cage::Character& character, uint32_t vertex) {
    const cage::SkinWeights& weights = character.weights;
    return !weights.jiggles.empty() && weights.jiggles[vertex].index != kNone &&
           (weights.cloths.empty() || weights.cloths[vertex].index == kNone);
}

std::vector<uint32_t> deformWork(const cage::Character& character) {
    std::vector<uint32_t> work(character.cage.vertexCount(), 0);
    for (const cage::MorphTarget& target : character.morphs.targets) {
        for (const uint32_t vertex : target.vertices) {
            ++work[vertex];
        }
    }
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        const uint32_t pairs = (character.weights.starts[v + 1] - character.weights.starts[v] + 1) / 2;
        work[v] += std::max(pairs, static_cast<uint32_t>(kMostMushInfluences));
    }
    return work;
}

void markSoftNodes(const cage::Character& character, ClipTable& table) {
    const auto mark = [&](uint32_t node) {
        for (; node != kNone; node = character.skeleton.nodes[node].parent) {
            if (table.places[node] == kNone) {
                continue;
            }
            uint32_t& flags = table.words[4 * size_t{shared::kNodeElements * table.places[node]} + 1];
            if ((flags & shared::kNodeOfSoft) != 0) {
                return;
            }
            flags |= shared::kNodeOfSoft;
        }
    };
    bool any = false;
    const auto markVertex = [&](uint32_t v) {
        any = true;
        for (uint32_t i = character.weights.starts[v]; i < character.weights.starts[v + 1]; ++i) {
            mark(character.skin.joints[character.weights.influences[i].joint]);
        }
    };
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        if (jiggles(character, v)) {
            markVertex(v);
        }
    }
    for (const ClothMesh& mesh : clothMeshes(character)) {
        for (const uint32_t v : mesh.vertices) {
            markVertex(v);
        }
    }
    for (const cage::Cloth& cloth : character.cloths) {
        for (const uint32_t collider : cloth.colliders) {
            mark(character.springBones.colliders[collider].node);
        }
    }
    for (const uint32_t node : table.driverNodes) {
        if (any) {
            mark(node);
        }
    }
}

} // namespace supple::skinning
