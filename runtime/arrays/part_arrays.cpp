#include "runtime/arrays/part_arrays.h"

#include "runtime/arrays/cage_arrays.h"
#include "runtime/arrays/node_arrays.h"
#include "runtime/arrays/primitive_arrays.h"
#include "runtime/arrays/vertex_arrays.h"

#include <string>
#include <utility>

namespace supple::runtime {

namespace {

static_assert(SUPPLE_UV_LINEAR_NONE == static_cast<int>(cage::UvMode::none) + 1 &&
              SUPPLE_UV_LINEAR_ALL == static_cast<int>(cage::UvMode::all) + 1);
static_assert(SUPPLE_MADE_FOR_CATMULL_CLARK == static_cast<int>(cage::MadeFor::catmullClark) + 1 &&
              SUPPLE_MADE_FOR_NONE == static_cast<int>(cage::MadeFor::none) + 1);

void readSkin(const SuppleSkinDesc& desc, uint32_t nodeCount, cage::Skin& skin, Faults& faults) {
    if (desc.jointCount == 0) {
        faults.add("skin: no joints");
        return;
    }
    if (!faults.present(desc.jointCount, "skin.joints", desc.joints)) {
        return;
    }
    cage::Found found;
    for (uint32_t j = 0; j < desc.jointCount; ++j) {
        if (desc.joints[j] >= nodeCount) {
            found.add([&] {
                return "node " + std::to_string(desc.joints[j]) + " of " + std::to_string(nodeCount) + " in joint " +
                       std::to_string(j);
            });
        }
    }
    faults.add(found, "joint is no node", "joints are no nodes");
    skin.joints.assign(desc.joints, desc.joints + desc.jointCount);
    skin.inverseBinds.assign(desc.jointCount, glm::mat4(1.0f));
    for (uint32_t j = 0; desc.inverseBinds != nullptr && j < desc.jointCount; ++j) {
        readMatrix(desc.inverseBinds + 16 * size_t{j}, cage::item("skin.inverseBinds", j), skin.inverseBinds[j],
                   faults);
    }
}

/// Whether the influences can be taken.
bool checkWeights(const SupplePartDesc& desc, uint32_t vertexCount, const cage::MeshBinding& binding, Faults& faults) {
    if (!binding.skinned) {
        refuseInfluences(desc.influences, faults);
        return true;
    }
    const size_t jointCount = binding.skin.joints.size();
    return jointCount > 0 && checkInfluences(desc.influences, vertexCount, jointCount, faults);
}

/// The weights of the vertices that are left.
void takeWeights(const SupplePartDesc& desc, const cage::MeshBinding& binding, const PartContext& context,
                 cage::PartCage& part) {
    cage::VertexWeights weights;
    if (!binding.skinned) {
        weights.appendUnskinned(part.cage.vertexCount());
    } else {
        appendInfluences(desc.influences, part.cage.sourceVertices, binding.skin.joints.size(), weights);
        weights.report(part.element + " influences", *context.warnings);
    }
    part.weights.starts.push_back(0);
    for (uint32_t v = 0; v < part.cage.vertexCount(); ++v) {
        const auto own = weights.of(v);
        part.weights.influences.insert(part.weights.influences.end(), own.begin(), own.end());
        part.weights.starts.push_back(static_cast<uint32_t>(part.weights.influences.size()));
    }
}

/// Names and weights. False: a fault.
bool readTargets(const SupplePartDesc& desc, cage::Morphs& morphs, Faults& faults) {
    const std::vector<SuppleMorphTargetDesc> targets = takeArray(desc.targets, desc.targetCount, "targets", faults);
    for (uint32_t t = 0; t < targets.size(); ++t) {
        if (const char* fault = cage::faultOfCoordinate(targets[t].weight)) {
            faults.add(cage::at("target", t) + ": weight is " + fault);
        }
        morphs.targets.push_back({orEmpty(targets[t].name), {}, {}});
        morphs.weights.push_back(targets[t].weight);
    }
    return targets.size() == desc.targetCount;
}

void readCageDisplacements(const SupplePartDesc& desc, uint32_t vertexCount, cage::PartCage& part, Faults& faults) {
    if (!faults.present(desc.targetCount, "displacements", desc.displacements)) {
        return;
    }
    std::vector<uint32_t> places(vertexCount, cage::kNone);
    for (uint32_t v = 0; v < part.cage.vertexCount(); ++v) {
        places[part.cage.sourceVertices[v]] = v;
    }
    for (uint32_t t = 0; t < desc.targetCount; ++t) {
        cage::MorphTarget& target = part.morphs.targets[t];
        for (const auto& [vertex, moved] : readDisplacements(desc.displacements[t], t, vertexCount, faults)) {
            if (places[vertex] != cage::kNone) {
                target.vertices.push_back(places[vertex]);
                target.deltas.push_back(moved.delta);
            }
        }
    }
}

/// A part of polygons over whole vertices.
void readCagePart(const SupplePartDesc& desc, const cage::MeshBinding& binding, const PartContext& context,
                  cage::PartCage& part, Faults& faults) {
    SuppleCageDesc cage{};
    if (!takeStruct(desc.cage, cage, "cage", faults)) {
        return;
    }
    part.namesBySource = true;
    Faults ofCage(faults.refusals(), faults.element()); // it is filled, whatever else is wrong
    readCageArrays(cage, context.materials, part, ofCage);
    if (cage.vertexCount > supple::cage::kMaxVertices) {
        return;
    }
    if (checkWeights(desc, cage.vertexCount, binding, faults) && part.cage.faceCount() > 0) {
        takeWeights(desc, binding, context, part);
    }
    readCageDisplacements(desc, cage.vertexCount, part, faults);
}

void readSurfaceRules(const SupplePartDesc& desc, cage::Part& part, Faults& faults) {
    if (rawValue(desc.uvInterpolation) > SUPPLE_UV_LINEAR_ALL || rawValue(desc.madeFor) > SUPPLE_MADE_FOR_NONE) {
        faults.add("no such uvInterpolation or madeFor", ErrorCode::range);
        return;
    }
    if (desc.uvInterpolation != SUPPLE_UV_FROM_FILE) {
        part.uvMode = static_cast<cage::UvMode>(desc.uvInterpolation - 1);
    }
    if (desc.madeFor != SUPPLE_MADE_FOR_UNKNOWN) {
        part.madeFor = static_cast<cage::MadeFor>(desc.madeFor - 1);
    }
}

} // namespace

void readPartArrays(const SupplePartDesc& desc, const PartContext& context, cage::PartCage& part,
                    cage::MeshBinding& binding, Faults& faults) {
    part.element = faults.element();
    part.part.name = orEmpty(desc.name);
    part.part.node = desc.node;
    if (desc.node >= context.nodeCount) {
        faults.add("node " + std::to_string(desc.node) + " of " + std::to_string(context.nodeCount));
    }
    readSurfaceRules(desc, part.part, faults);
    binding = cage::bindToNode(desc.node);
    SuppleSkinDesc skin{};
    if (!takeStruct(desc.skin, skin, "skin", faults)) {
        return;
    }
    if (desc.skin != nullptr) {
        binding.skinned = true;
        binding.skin = {};
        readSkin(skin, context.nodeCount, binding.skin, faults);
    }
    if ((desc.cage == nullptr) == (desc.primitiveCount == 0)) {
        faults.add(desc.cage == nullptr ? "neither cage nor primitives" : "both cage and primitives");
        return;
    }
    if (!readTargets(desc, part.morphs, faults)) {
        return;
    }
    if (desc.cage != nullptr) {
        readCagePart(desc, binding, context, part, faults);
        return;
    }
    if (desc.displacements != nullptr) {
        faults.add("displacements beside those of the primitives");
    }
    refuseInfluences(desc.influences, faults);
    readPrimitiveArrays(desc, binding, context, part, faults);
}

} // namespace supple::runtime
