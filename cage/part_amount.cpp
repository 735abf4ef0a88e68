#include "cage/part_amount.h"

#include "cage/limits.h"
#include "cage/refusal.h"

namespace supple::cage {
namespace {

void addTo(uint64_t& sum, uint64_t more, uint64_t most, const char* what, const std::string& element) {
    sum += more;
    if (sum > most) {
        refuse(element, "with its mesh, there are more than " + std::to_string(most) + " " + what, ErrorCode::limit);
    }
}

} // namespace

void PartAmount::add(const PartCage& part, const std::string& element) {
    addTo(parts_, 1, kMaxParts, "meshes", element);
    addTo(vertices_, part.sourceVertexCount, kMaxVertices, "vertices", element);
    addTo(corners_, part.cage.cornerCount(), kMaxCorners, "corners", element);
    for (const MorphTarget& target : part.morphs.targets) {
        addTo(displacements_, target.vertices.size(), kMaxDisplacements, "displacements of morph targets", element);
    }
}

} // namespace supple::cage
