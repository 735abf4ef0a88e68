#include "cage/split/creases.h"

#include "cage/refusal.h"
#include "cage/sharp_features.h"

#include <map>
#include <string>
#include <utility>

namespace supple::cage::split {
namespace {

/// Creases and corners of primitives. What they name is a cage vertex by its number where the mesh numbers them,
/// else a vertex of the primitive.
class PrimitiveLists {
public:
    PrimitiveLists(const Mesh& mesh, std::span<const uint32_t> cageVertices, Cage& cage, Leniency& leniency,
                   Warnings& warnings)
        : byNumber_(!mesh.cageNumbers.empty() && mesh.numberSource == WeldSource::cageExtension),
          cageVertices_(cageVertices), cage_(cage), leniency_(leniency), warnings_(warnings) {
        for (uint32_t v = 0; v < mesh.cageNumbers.size(); ++v) {
            // Any vertex of a number will do, but one without a face only where none has a face.
            uint32_t& vertex = ofNumber_.try_emplace(mesh.cageNumbers[v], cageVertices[v]).first->second;
            vertex = vertex == kNone ? cageVertices[v] : vertex;
        }
    }

    void addCreasesOf(const Primitive& primitive) {
        const SharpList& list = *primitive.creases;
        std::vector<Crease> creases; // all of them or, if one is refused, none
        EntryFaults faults(list.element);
        for (size_t i = 0; i < list.sharpnesses.size(); ++i) {
            const uint32_t a = vertexOf(primitive, list, 2 * i);
            const uint32_t b = vertexOf(primitive, list, 2 * i + 1);
            if (a == kNone || b == kNone) {
                faults.add(2 * i, "a crease at a vertex without a face");
            } else if (a == b) {
                refuse(item(list.element, 2 * i), "both ends are one vertex of the cage");
            } else {
                creases.push_back({a, b, list.sharpnesses[i], static_cast<uint32_t>(i)});
            }
        }
        std::vector<uint32_t> sets(list.sharpnesses.size(), kNone);
        leniency_.leaveOut([&] { sets = setsOf(primitive); });
        for (Crease& crease : creases) {
            crease.set = sets[crease.set];
            features_.addCrease(crease, cage_);
        }
        faults.report(warnings_);
    }

    void addCornersOf(const Primitive& primitive) {
        const SharpList& list = *primitive.corners;
        std::vector<SharpVertex> corners;
        EntryFaults faults(list.element);
        for (size_t i = 0; i < list.sharpnesses.size(); ++i) {
            const uint32_t vertex = vertexOf(primitive, list, i);
            if (vertex == kNone) {
                faults.add(i, "a vertex without a face");
            } else {
                corners.push_back({vertex, list.sharpnesses[i]});
            }
        }
        for (const SharpVertex& corner : corners) {
            features_.addCorner(corner.vertex, corner.sharpness, cage_);
        }
        faults.report(warnings_);
    }

    void addScalarsOf(const Primitive& primitive) {
        const SharpList& list = *primitive.scalars;
        std::vector<CreaseScalar> scalars;
        EntryFaults faults(list.element);
        for (size_t i = 0; i < list.sharpnesses.size(); ++i) {
            const uint32_t vertex = vertexOf(primitive, list, 2 * i);
            const uint32_t toward = vertexOf(primitive, list, 2 * i + 1);
            if (vertex == kNone || toward == kNone) {
                faults.add(2 * i, "a crease scalar at a vertex without a face");
            } else if (vertex == toward) {
                refuse(item(list.element, 2 * i), "both ends are one vertex of the cage");
            } else {
                scalars.push_back({vertex, toward, list.sharpnesses[i]});
            }
        }
        cage_.creaseScalars.insert(cage_.creaseScalars.end(), scalars.begin(), scalars.end());
        faults.report(warnings_);
    }

private:
    /// The set of each of a primitive's creases.
    std::vector<uint32_t> setsOf(const Primitive& primitive) {
        std::vector<uint32_t> sets(primitive.creases->sharpnesses.size(), kNone);
        for (size_t number = 0; number < primitive.creaseSets.size(); ++number) {
            const CreaseSet& set = primitive.creaseSets[number];
            for (const uint32_t crease : set.creases) {
                if (crease >= sets.size() || sets[crease] != kNone) {
                    refuse(primitive.element + " crease set " + quoted(set.name),
                           "crease " + std::to_string(crease) +
                               (crease >= sets.size()
                                    ? " is out of range: the primitive has " + std::to_string(sets.size())
                                    : " is in a set already"));
                }
                sets[crease] = static_cast<uint32_t>(number);
            }
        }
        std::vector<uint32_t> ofCage;
        for (const CreaseSet& set : primitive.creaseSets) {
            ofCage.push_back(creaseSetOf(set.name, cage_));
        }
        for (uint32_t& set : sets) {
            set = set == kNone ? kNone : ofCage[set];
        }
        return sets;
    }

    /// kNone for a vertex without a face.
    uint32_t vertexOf(const Primitive& primitive, const SharpList& list, size_t index) const {
        const uint32_t number = list.vertices[index];
        if (byNumber_) {
            const auto found = ofNumber_.find(number);
            if (found == ofNumber_.end()) {
                refuse(item(list.element, index), "the mesh has no cage vertex " + std::to_string(number));
            }
            return found->second;
        }
        if (number >= primitive.vertexCount) {
            refuse(item(list.element, index), "vertex " + std::to_string(number) +
                                                  " is out of range: the primitive has " +
                                                  std::to_string(primitive.vertexCount));
        }
        return cageVertices_[primitive.firstVertex + number];
    }

    const bool byNumber_; ///< lists have cage numbers
    std::span<const uint32_t> cageVertices_;
    Cage& cage_;
    Leniency& leniency_;
    Warnings& warnings_;
    SharpFeatures features_;
    std::map<uint32_t, uint32_t>
        ofNumber_; ///< number of a cage vertex in the file -> cage vertex, kNone without a face
};

/// Those of the mesh itself.
void addLoose(const LooseSharpList& list, std::span<const uint32_t> cageVertices, Cage& cage, Warnings& warnings) {
    SharpFeatures features;
    EntryFaults faults = list.faults;
    for (const LooseSharpList::Entry& entry : list.entries) {
        const uint32_t a = cageVertices[entry.vertices[0]], b = cageVertices[entry.vertices[1]];
        if (a == kNone || (list.vertexCount == 2 && b == kNone)) {
            faults.add(entry.index, "vertex " + std::to_string(entry.vertices[a == kNone ? 0 : 1]) + " has no face");
        } else if (list.vertexCount == 1) {
            features.addCorner(a, entry.sharpness, cage);
        } else if (a == b) {
            faults.add(entry.index, "both ends are one vertex of the cage");
        } else {
            features.addCrease({a, b, entry.sharpness, kNone}, cage);
        }
    }
    faults.report(warnings);
}

} // namespace

void addCreases(const Mesh& mesh, std::span<const uint32_t> cageVertices, Cage& cage, Leniency& leniency,
                Warnings& warnings) {
    bool creases = false;
    bool corners = false;
    PrimitiveLists lists(mesh, cageVertices, cage, leniency, warnings);
    for (const Primitive& primitive : mesh.primitives) {
        if (primitive.creases) {
            leniency.leaveOut([&] { lists.addCreasesOf(primitive); });
            creases = true;
        }
        if (primitive.corners) {
            leniency.leaveOut([&] { lists.addCornersOf(primitive); });
            corners = true;
        }
        if (primitive.scalars) {
            leniency.leaveOut([&] { lists.addScalarsOf(primitive); });
        }
    }
    if (mesh.creases && !creases) {
        addLoose(*mesh.creases, cageVertices, cage, warnings);
    }
    if (mesh.corners && !corners) {
        addLoose(*mesh.corners, cageVertices, cage, warnings);
    }
}

} // namespace supple::cage::split
