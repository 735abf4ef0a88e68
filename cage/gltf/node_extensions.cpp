#include "cage/gltf/node_extensions.h"

#include "cage/character.h"
#include "cage/message.h"
#include "cage/refusal.h"

namespace supple::cage::gltf {

void checkVisibility(const Json& node, const std::string& element) {
    if (!hasExtension(node, kNodeVisibility)) {
        return;
    }
    const Json* extension = objectMember(node.at("extensions"), kNodeVisibility, element);
    const Json* visible = extension == nullptr ? nullptr : member(*extension, "visible");
    if (visible != nullptr && !visible->isBoolean()) {
        refuse(within(element, kNodeVisibility) + " visible", "not a boolean");
    }
}

bool saysHidden(const Json& node) {
    if (!hasExtension(node, kNodeVisibility)) {
        return false;
    }
    const Json* visible = member(node.at("extensions").at(kNodeVisibility), "visible");
    return visible != nullptr && visible->isBoolean() && !visible->boolean();
}

std::vector<uint32_t> findHiders(const file::Model& model) {
    std::vector<uint32_t> hiders(model.nodes.size(), kNone);
    std::vector<uint32_t> stack;
    for (uint32_t root = 0; root < model.nodes.size(); ++root) {
        if (!model.nodes[root].hidden || hiders[root] != kNone) {
            continue;
        }
        // The nodes are a forest. What another hidden node has taken is taken with all that is below it.
        stack.assign(1, root);
        while (!stack.empty()) {
            const uint32_t node = stack.back();
            stack.pop_back();
            if (hiders[node] == kNone) {
                hiders[node] = root;
                stack.insert(stack.end(), model.nodes[node].children.begin(), model.nodes[node].children.end());
            }
        }
    }
    return hiders;
}

} // namespace supple::cage::gltf
