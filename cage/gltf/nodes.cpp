#include "cage/gltf/nodes.h"

#include "cage/gltf/node_extensions.h"
#include "cage/limits.h"
#include "cage/refusal.h"
#include "cage/skeleton.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace supple::cage::gltf {
namespace {

using file::Model;

std::vector<uint32_t> nodesOfScene(const Model& model, size_t scene) {
    std::vector<uint32_t> order;
    std::vector<uint8_t> seen(model.nodes.size(), 0);
    const auto& roots = model.scenes[scene].nodes;
    std::vector<uint32_t> stack(roots.begin(), roots.end());
    while (!stack.empty()) {
        const uint32_t node = stack.back();
        stack.pop_back();
        if (seen[node] != 0) {
            continue;
        }
        seen[node] = 1;
        order.push_back(node);
        const auto& children = model.nodes[node].children;
        stack.insert(stack.end(), children.begin(), children.end());
    }
    return order;
}

void checkPlacing(std::span<const float> values, const std::string& element) {
    if (const char* fault = faultOfCoordinates(values.data(), values.size())) {
        refuse(element, fault);
    }
}

/// Where a node stands under its parent.
void readPlace(const Document& document, size_t number, Node& node) {
    const auto& from = document.model.nodes[number];
    const std::string element = at("node", number);
    if (!from.matrix.empty()) {
        node.hasMatrix = true;
        for (int k = 0; k < 16; ++k) {
            node.matrix[k / 4][k % 4] = static_cast<float>(from.matrix[static_cast<size_t>(k)]);
        }
        checkPlacing({&node.matrix[0][0], 16}, element + " matrix");
        makeAffine(node.matrix, element + " matrix", *document.leniency);
        return;
    }
    for (int k = 0; k < 3; ++k) {
        if (!from.translation.empty()) {
            node.translation[k] = static_cast<float>(from.translation[static_cast<size_t>(k)]);
        }
        if (!from.scale.empty()) {
            node.scale[k] = static_cast<float>(from.scale[static_cast<size_t>(k)]);
        }
    }
    checkPlacing({&node.translation[0], 3}, element + " translation");
    checkPlacing({&node.scale[0], 3}, element + " scale");
    if (!from.rotation.empty()) {
        const auto& q = from.rotation;
        document.leniency->leaveOut([&] {
            node.rotation = unitRotation({q[0], q[1], q[2], q[3]}, element + " rotation");
        });
    }
}

/// A file of clips alone is none that cannot be read.
std::string insteadOfMeshes(const Model& model) {
    return model.animations.empty() ? ""
                                    : ", but " + counted(model.animations.size(), "clip", "clips") +
                                          ": it is no character, but a file of clips for one";
}

/// Nodes of the scene whose meshes are read, but for those that are hidden.
std::vector<uint32_t> findSceneNodes(const Document& document, std::optional<uint32_t> scene, Warnings& warnings) {
    const Model& model = document.model;
    if (model.meshes.empty()) {
        document.leniency->refuseAll({"meshes: none" + insteadOfMeshes(model)});
    }
    if (scene && *scene >= model.scenes.size()) {
        refuse(at("scene", *scene), "the file has " + counted(model.scenes.size(), "scene", "scenes"));
    }
    const auto hasNoMesh = [&](uint32_t node) { return model.nodes[node].mesh < 0; };
    std::vector<uint32_t> all(model.nodes.size());
    std::iota(all.begin(), all.end(), 0u);
    std::erase_if(all, hasNoMesh);
    if (all.empty()) {
        document.leniency->refuseAll({"nodes: none has a mesh" + insteadOfMeshes(model)});
    }
    if (model.scenes.empty()) {
        return all;
    }
    const size_t chosen = scene ? *scene : model.defaultScene >= 0 ? static_cast<size_t>(model.defaultScene) : 0;
    std::vector<uint32_t> nodes = nodesOfScene(model, chosen);
    std::sort(nodes.begin(), nodes.end());
    std::erase_if(nodes, hasNoMesh);
    if (nodes.empty() && scene) {
        refuse(at("scene", chosen), "no mesh");
    }
    if (nodes.empty()) {
        warn(warnings, at("scene", chosen), "no mesh; all nodes of the file with meshes are read");
        return all;
    }
    if (nodes.size() < all.size()) {
        warn(warnings, at("scene", chosen),
             counted(all.size() - nodes.size(), "node with a mesh is", "nodes with meshes are") +
                 " not in this scene; left out");
    }
    return nodes;
}

} // namespace

Skeleton readSkeleton(const Document& document) {
    const Model& model = document.model;
    Skeleton skeleton;
    const size_t count = model.nodes.size();
    skeleton.nodes.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const auto& from = model.nodes[i];
        skeleton.nodes[i].name = from.name;
        for (const int child : from.children) {
            skeleton.nodes[static_cast<size_t>(child)].parent = static_cast<uint32_t>(i);
        }
    }
    for (size_t i = 0; i < count; ++i) {
        Node placed = skeleton.nodes[i];
        if (document.leniency->gather([&] { readPlace(document, i, placed); })) {
            skeleton.nodes[i] = std::move(placed);
        }
    }
    orderParentsFirst(skeleton);
    return skeleton;
}

std::vector<uint32_t> findMeshNodes(const Document& document, std::optional<uint32_t> scene, Warnings& warnings) {
    std::vector<uint32_t> nodes = findSceneNodes(document, scene, warnings);
    const std::vector<uint32_t> hiders = findHiders(document.model);
    const auto isHidden = [&](uint32_t node) { return hiders[node] != kNone; };
    if (std::all_of(nodes.begin(), nodes.end(), isHidden)) {
        document.leniency->refuseAll({std::string("nodes: all that have meshes are hidden by ") + kNodeVisibility +
                                      ", the first is " + at("node", nodes.front())});
    }
    for (const uint32_t node : nodes) {
        if (isHidden(node)) {
            warn(warnings, at("node", node),
                 std::string("hidden by ") + kNodeVisibility +
                     (hiders[node] == node ? "" : " of " + at("node", hiders[node])) + "; left out");
        }
    }
    std::erase_if(nodes, isHidden);
    return nodes;
}

} // namespace supple::cage::gltf
