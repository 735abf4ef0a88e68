#include "tests/support/side_by_side.h"

#include "cage/parts.h"

#include <utility>
#include <vector>

namespace supple::test {

cage::Character sideBySide(const cage::Cage& cage, const std::string& name, uint32_t count) {
    cage::Character c;
    c.name = name + "s";
    c.skeleton.nodes.resize(count);
    std::vector<cage::PartCage> parts;
    for (uint32_t p = 0; p < count; ++p) {
        cage::PartCage& part = parts.emplace_back();
        part.cage = cage;
        part.cage.sourceVertices.clear();
        for (uint32_t v = 0; v < part.cage.vertexCount(); ++v) {
            part.cage.positions[v].x += 6.0f * static_cast<float>(p);
            part.cage.sourceVertices.push_back(v);
            part.weights.influences.push_back({0, 1.0f});
        }
        for (uint32_t v = 0; v <= part.cage.vertexCount(); ++v) {
            part.weights.starts.push_back(v);
        }
        part.part.name = name + " " + std::to_string(p);
        part.part.node = p;
        part.part.joints = {p};
        part.sourceVertexCount = part.cage.vertexCount();
        c.skeleton.nodes[p].name = part.part.name;
        c.skeleton.parentsFirst.push_back(p);
        c.skin.joints.push_back(p);
        c.skin.inverseBinds.emplace_back(1.0f);
    }
    cage::joinParts(std::move(parts), c);
    return c;
}

} // namespace supple::test
