#include "runtime/surfaces.h"

#include "shaders/shared/bounds.h"

#include <bit>

namespace supple::runtime {

namespace {

/// The description of the surface that some of the group's parts have.
Result<TessellationDesc> describe(const TessellationDesc& group, const SchemeParts& parts) {
    TessellationDesc desc = group;
    desc.group.scheme = parts.scheme;
    desc.parts = parts.parts;
    desc.schemeChosen = parts.chosen;
    if (parts.parts.size() < group.asset->character.parts.size()) {
        Result<std::shared_ptr<AssetPiece>> piece = group.asset->pieceOf(*group.device, parts.parts);
        if (!piece) {
            return piece.error();
        }
        desc.piece = std::move(*piece);
    }
    desc.group.flags = surfaceFlags(desc.group.flags, schemeIdOf(desc.group, parts.scheme), parts.chosen);
    return desc;
}

/// The description that SUPPLE_SCHEME_CAGE has: no surface of no patches.
TessellationDesc describeCage(const TessellationDesc& group) {
    TessellationDesc desc = group;
    for (uint32_t part = 0; part < group.asset->character.parts.size(); ++part) {
        desc.parts.push_back(part);
    }
    return desc;
}

/// Whether some surface is evaluated while it is drawn, if the group asks for that.
Status checkDirect(const TessellationDesc& group, const std::vector<TessellationDesc>& surfaces) {
    const auto isDirect = [](const TessellationDesc& desc) { return (desc.group.flags & SUPPLE_GROUP_DIRECT) != 0; };
    if (!isDirect(group) || std::any_of(surfaces.begin(), surfaces.end(), isDirect)) {
        return success();
    }
    const surface::SchemeId first = schemeIdOf(surfaces.front().group, surfaces.front().group.scheme);
    return Error{ErrorCode::argument, group.asset->character.name +
                                          ": SUPPLE_GROUP_DIRECT: patches of P_m and p-rep can be evaluated while they "
                                          "are drawn, those of " +
                                          surface::schemeOf(first).name + " cannot"};
}

Result<std::vector<TessellationDesc>> describeAll(const TessellationDesc& group) {
    std::vector<TessellationDesc> all;
    if (group.group.scheme == SUPPLE_SCHEME_CAGE) {
        all.push_back(describeCage(group));
        return all;
    }
    const Result<std::vector<SchemeParts>> schemes = schemesOf(*group.asset->prepared, group.group);
    if (!schemes) {
        return schemes.error();
    }
    for (const SchemeParts& parts : *schemes) {
        Result<TessellationDesc> desc = describe(group, parts);
        if (!desc) {
            return desc.error();
        }
        desc->surface = static_cast<uint32_t>(all.size());
        all.push_back(std::move(*desc));
    }
    if (const Status direct = checkDirect(group, all); !direct) {
        return direct.error();
    }
    return all;
}

} // namespace

Result<Surfaces> Surfaces::create(const TessellationDesc& desc, const Surfaces* before, const Surfaces* leader) {
    Result<std::vector<TessellationDesc>> descs = describeAll(desc);
    if (!descs) {
        return descs.error();
    }
    Surfaces surfaces;
    surfaces.partCount_ = desc.asset->character.parts.size();
    bool counted = false;
    for (TessellationDesc& own : *descs) {
        own.group.partSchemes = nullptr; // the caller's
        own.countsHidden = !counted;
        const auto sameOf = [&](const Surfaces* all) {
            return all != nullptr && own.surface < all->size() ? &(*all)[own.surface] : nullptr;
        };
        own.before = sameOf(before);
        own.leader = sameOf(leader);
        Result<std::unique_ptr<Tessellation>> made = Tessellation::create(own);
        if (!made) {
            return made.error();
        }
        counted = counted || (*made)->kind() == SUPPLE_TESSELLATION_LEVELS;
        surfaces.all_.push_back(std::move(*made));
    }
    surfaces.setLadder();
    return surfaces;
}

void Surfaces::setLadder() {
    using Ladder = Tessellation::Ladder;
    const auto isTold = [](const Tessellation& surface) {
        return surface.ladder().count > 0 && !surface.ladder().adapts;
    };
    const bool told = any(isTold);
    uint32_t first = shared::kMaxRates, end = 0; // halvings of an edge of the cage
    for (const std::unique_ptr<Tessellation>& surface : all_) {
        const Ladder own = surface->ladder();
        if (own.count > 0 && (!told || isTold(*surface))) {
            const auto begin = static_cast<uint32_t>(std::countr_zero(own.first));
            first = std::min(first, begin);
            end = std::max(end, begin + own.count);
        }
    }
    if (end == 0) {
        return;
    }
    ladder_ = {1u << first, end - first, false};
    for (const std::unique_ptr<Tessellation>& surface : all_) {
        if (surface->ladder().count > 0) {
            surface->setLadder(ladder_);
        }
    }
}

BoundBytes Surfaces::boundBytes() const {
    BoundBytes most;
    for (const std::unique_ptr<Tessellation>& surface : all_) {
        most = most.with(surface->boundBytes());
    }
    return most;
}

Status Surfaces::cutDraws(InstanceWindows& windows, bool byWindows) const {
    Status status = success();
    for (const std::unique_ptr<Tessellation>& surface : all_) {
        status = status ? surface->cutDraws(windows, byWindows) : status;
    }
    return status;
}

std::vector<PartPatches> Surfaces::partPatches() const {
    std::vector<PartPatches> counts(partCount_);
    for (const std::unique_ptr<Tessellation>& surface : all_) {
        const bool atLevels = surface->kind() == SUPPLE_TESSELLATION_LEVELS;
        for (const surface::DrawRange& range : surface->tables().drawRanges) {
            counts[range.part].all += range.patchCount;
            counts[range.part].atLevels += atLevels ? range.patchCount : 0;
        }
    }
    return counts;
}

bool Surfaces::haveGrids() const {
    return any([](const Tessellation& surface) {
        return surface.kind() != SUPPLE_TESSELLATION_NONE && surface.kind() != SUPPLE_TESSELLATION_LEVELS;
    });
}

Status Surfaces::setRate(uint32_t rate) {
    // In a group of several, polygons go without one.
    const auto ignores = [&](const Tessellation& surface) { return size() > 1 && surface.isMesh(); };
    Status status = success();
    for (const std::unique_ptr<Tessellation>& surface : all_) {
        status = status && !ignores(*surface) ? surface->prepareRate(rate) : status;
    }
    for (const std::unique_ptr<Tessellation>& surface : all_) {
        if (status && !ignores(*surface)) {
            surface->takeRate();
        }
    }
    return status;
}

uint32_t Surfaces::leastVertices() const {
    uint32_t vertices = 0;
    for (const std::unique_ptr<Tessellation>& surface : all_) {
        vertices += surface->isBudgeted() ? surface->leastVertices() : 0;
    }
    return vertices;
}

} // namespace supple::runtime
