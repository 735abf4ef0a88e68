#include "runtime/arrays/node_arrays.h"

#include "cage/skeleton.h"

#include <cstring>

namespace supple::runtime {

namespace {

static_assert(SUPPLE_NO_NODE == cage::kNone);

void readVector(const float* from, const char* what, glm::vec3& to, Faults& faults) {
    if (from == nullptr) {
        return;
    }
    if (const char* fault = cage::faultOfCoordinates(from, 3)) {
        faults.add(std::string(what) + " is " + fault);
    }
    to = {from[0], from[1], from[2]};
}

void readNode(const SuppleNodeDesc& from, uint32_t nodeCount, cage::Node& node, Faults& faults) {
    node.name = orEmpty(from.name);
    node.parent = from.parent;
    if (from.parent != SUPPLE_NO_NODE && from.parent >= nodeCount) {
        faults.add("parent " + std::to_string(from.parent) + " of " + std::to_string(nodeCount));
    }
    if (from.matrix != nullptr) {
        node.hasMatrix = true;
        if (from.translation != nullptr || from.rotation != nullptr || from.scale != nullptr) {
            faults.add("both a matrix and a translation, rotation or scale");
        }
        readMatrix(from.matrix, "matrix", node.matrix, faults);
        return;
    }
    readVector(from.translation, "translation", node.translation, faults);
    readVector(from.scale, "scale", node.scale, faults);
    if (const float* q = from.rotation; q != nullptr) {
        faults.gather([&] {
            if (const char* fault = cage::faultOfCoordinates(q, 4)) {
                cage::refuse("rotation", fault);
            }
            node.rotation = cage::unitRotation({q[0], q[1], q[2], q[3]}, "rotation");
        });
    }
}

} // namespace

void readMatrix(const float* from, const std::string& what, glm::mat4& to, Faults& faults) {
    faults.gather([&] {
        if (const char* fault = cage::faultOfCoordinates(from, 16)) {
            cage::refuse(what, fault);
        }
        std::memcpy(&to[0][0], from, sizeof(to));
        cage::makeAffine(to, what);
    });
}

void readNodeArrays(const SuppleCharacterDesc& desc, cage::Skeleton& skeleton, cage::Refusals& refusals) {
    Faults all(refusals, "");
    const std::vector<SuppleNodeDesc> nodes = takeArray(desc.nodes, desc.nodeCount, "nodes", all);
    bool parents = nodes.size() == desc.nodeCount;
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        Faults faults(refusals, cage::at("node", i));
        readNode(nodes[i], desc.nodeCount, skeleton.nodes.emplace_back(), faults);
        parents = parents && (nodes[i].parent == SUPPLE_NO_NODE || nodes[i].parent < desc.nodeCount);
    }
    if (parents) {
        all.gather([&] { cage::orderParentsFirst(skeleton); });
    }
}

} // namespace supple::runtime
