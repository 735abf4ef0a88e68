#include "runtime/arrays/character_arrays.h"

#include "cage/bind_space.h"
#include "cage/part_amount.h"
#include "cage/single_joint.h"
#include "runtime/arrays/cage_arrays.h"
#include "runtime/arrays/clip_arrays.h"
#include "runtime/arrays/material_arrays.h"
#include "runtime/arrays/node_arrays.h"
#include "runtime/arrays/part_arrays.h"

#include <exception>
#include <new>
#include <utility>
#include <vector>

namespace supple::runtime {

namespace {

/// What a description's parts become, and how many morph targets each node moves.
struct ReadParts {
    std::vector<cage::PartCage> parts;
    std::vector<cage::MeshBinding> bindings;
    std::vector<size_t> targetCounts; ///< by node
};

ReadParts readParts(const SuppleCharacterDesc& desc, cage::Pairing pairing, cage::Character& character,
                    cage::Refusals& refusals) {
    ReadParts read;
    Faults all(refusals, "");
    const std::vector<SupplePartDesc> from = takeArray(desc.parts, desc.partCount, "parts", all);
    if (desc.partCount == 0) {
        all.add("parts: none, so there is no surface");
    }
    read.targetCounts.assign(character.skeleton.nodes.size(), 0);
    std::vector<uint32_t> carried(character.skeleton.nodes.size(), cage::kNone);
    cage::PartAmount amount;
    const PartContext context{static_cast<uint32_t>(character.skeleton.nodes.size()), character.materials, pairing,
                              &character.warnings};
    for (uint32_t p = 0; p < from.size(); ++p) {
        Faults faults(refusals, cage::at("part", p));
        cage::PartCage& part = read.parts.emplace_back();
        readPartArrays(from[p], context, part, read.bindings.emplace_back(), faults);
        faults.gather([&] { amount.add(part, "its mesh"); });
        if (from[p].node < carried.size()) {
            uint32_t& first = carried[from[p].node];
            if (first != cage::kNone) {
                faults.add(cage::at("node", from[p].node) + " carries " + cage::at("part", first));
            }
            first = p;
            read.targetCounts[from[p].node] = from[p].targetCount;
        }
    }
    return read;
}

/// The palette, and parts at their places.
void bindParts(ReadParts& read, cage::Character& character) {
    const cage::BindSpace bindSpace(character.skeleton, read.bindings, read.parts, read.parts.size() == 1);
    cage::PaletteBuilder palette(character.skin);
    for (size_t p = 0; p < read.parts.size(); ++p) {
        cage::PartCage& part = read.parts[p];
        if (!bindSpace.place(p, part, read.bindings[p])) {
            cage::warn(character.warnings, part.element,
                       "its place in the bind pose is beyond 1e+09; its mesh stays in the node's own space");
        }
        part.part.joints = palette.add(read.bindings[p].skin);
        for (cage::Damage& damage : part.damages) {
            character.damages.push_back(std::move(damage));
        }
    }
}

/// What is read of arrays, or why it is not.
template <class Read>
Result<cage::Character> guarded(const std::string& name, const cage::FinishOptions& options, Read&& read) {
    try {
        cage::Character character;
        character.name = name;
        cage::finishCharacter(read(character), options, character);
        return character;
    } catch (const cage::Refusal& refusal) {
        return cage::asError(refusal, name);
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::hostMemory, name + ": out of memory"};
    }
}

} // namespace

Result<cage::Character> characterFromArrays(const SuppleCharacterDesc& desc, const std::string& name,
                                            const cage::FinishOptions& options, cage::Pairing pairing) {
    return guarded(name, options, [&](cage::Character& character) {
        cage::Refusals refusals;
        character.copyright = orEmpty(desc.copyright);
        readNodeArrays(desc, character.skeleton, refusals);
        character.images = readImageArrays(desc, refusals, character.warnings);
        character.materials = readMaterialArrays(desc, character.images, refusals, character.warnings);
        if (character.skeleton.nodes.size() < desc.nodeCount || character.images.size() < desc.imageCount ||
            character.materials.size() < desc.materialCount) {
            refusals.raise(); // what refers to these would be at fault as well
        }
        ReadParts read = readParts(desc, pairing, character, refusals);
        character.clips = readClipArrays(desc, character.skeleton, read.targetCounts, refusals, character.warnings);
        refusals.raise();
        if (pairing == cage::Pairing::whereClean) {
            cage::warnOfPairs(read.parts, character.warnings);
        }
        bindParts(read, character);
        return std::move(read.parts);
    });
}

Result<cage::Character> characterFromArrays(const SuppleCageDesc& desc, const std::string& name,
                                            const cage::FinishOptions& options) {
    return guarded(name, options, [&](cage::Character& character) {
        cage::Refusals refusals;
        Faults faults(refusals, "");
        std::vector<cage::PartCage> parts(1);
        parts[0].element = "cage";
        parts[0].namesBySource = true;
        readCageArrays(desc, {}, parts[0], faults);
        refusals.raise();
        cage::bindToOneJoint(parts, character, name);
        character.damages = std::move(parts[0].damages);
        return parts;
    });
}

} // namespace supple::runtime
