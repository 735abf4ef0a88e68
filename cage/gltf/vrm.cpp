#include "cage/gltf/vrm.h"

#include <algorithm>
#include <string>
#include <vector>

namespace supple::cage::gltf {
namespace {

/// What an extension of the file, or a member of it, would do.
constexpr struct {
    const char* extension;
    const char* member;
    const char* what;
} kVrmUses[] = {
    {"VRM", "firstPerson", "first-person flags"},
    {"VRMC_vrm", "firstPerson", "first-person flags"},
    {"VRMC_vrm", "lookAt", "gaze"},
    {"VRM", "materialProperties", "toon materials"},
};

bool hasNodeConstraints(const Json& root) {
    const Json nodes = table(root, "nodes");
    return std::any_of(nodes.begin(), nodes.end(),
                       [](const Json& node) { return hasExtension(node, "VRMC_node_constraint"); });
}

} // namespace

void nameUnusedVrm(const Json& root, Warnings& warnings) {
    std::vector<std::string> unused;
    for (const auto& [extension, part, what] : kVrmUses) {
        if (hasExtension(root, extension) && member(root.at("extensions").at(extension), part) != nullptr &&
            std::find(unused.begin(), unused.end(), what) == unused.end()) {
            unused.emplace_back(what);
        }
    }
    if (hasNodeConstraints(root)) {
        unused.emplace_back("node constraints");
    }
    if (unused.empty()) {
        return;
    }
    std::string list = unused[0];
    for (size_t i = 1; i < unused.size(); ++i) {
        list += (i + 1 < unused.size() ? ", " : " and ") + unused[i];
    }
    warn(warnings, "VRM", list + " are not used");
}

} // namespace supple::cage::gltf
