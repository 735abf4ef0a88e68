#include "runtime/part_schemes.h"

#include "cage/parts.h"

#include <algorithm>
#include <string>

namespace supple::runtime {

namespace {

std::string partName(const cage::Character& character, uint32_t part) {
    const std::string& name = character.parts[part].name;
    return "part " + std::to_string(part) + (name.empty() ? "" : " (" + name + ")");
}

/// The part that says which scheme parts sewn together have, by part: the first that the host named one for, or else
/// the first. Refuses two.
Result<std::vector<uint32_t>> leaders(const cage::Character& character, const std::vector<SuppleScheme>& named) {
    const std::vector<uint32_t> first = cage::sewnTo(character.cage, character.parts.size());
    std::vector<uint32_t> leader = first; // of the first of those sewn together
    for (uint32_t part = 0; part < named.size(); ++part) {
        uint32_t& own = leader[first[part]];
        if (named[part] != SUPPLE_SCHEME_AUTO && named[own] == SUPPLE_SCHEME_AUTO) {
            own = part;
        } else if (named[part] != SUPPLE_SCHEME_AUTO && named[part] != named[own]) {
            return Error{ErrorCode::argument, character.name + ": " + partName(character, own) + " and " +
                                                  partName(character, part) + " are sewn: they need the same scheme"};
        }
    }
    for (uint32_t part = 0; part < named.size(); ++part) {
        leader[part] = leader[first[part]];
    }
    return leader;
}

} // namespace

Result<std::vector<SchemeParts>> schemesOf(const Prepared& prepared, const SuppleGroupDesc& desc) {
    const cage::Character& character = prepared.character;
    if (desc.partSchemeCount > character.parts.size()) {
        return Error{ErrorCode::range, character.name + ": " + std::to_string(desc.partSchemeCount) + " schemes for " +
                                           std::to_string(character.parts.size()) + " parts"};
    }
    std::vector<SuppleScheme> named(character.parts.size(), desc.scheme);
    for (uint32_t part = 0; part < desc.partSchemeCount; ++part) {
        named[part] = desc.partSchemes[part] != SUPPLE_SCHEME_AUTO ? desc.partSchemes[part] : named[part];
    }
    const Result<std::vector<uint32_t>> leader = leaders(character, named);
    if (!leader) {
        return leader.error();
    }
    std::vector<SchemeParts> surfaces;
    for (uint32_t part = 0; part < named.size(); ++part) {
        const uint32_t from = (*leader)[part];
        const bool chosen = named[from] == SUPPLE_SCHEME_AUTO;
        const SuppleScheme scheme = chosen ? static_cast<SuppleScheme>(prepared.choices[from].scheme) : named[from];
        auto own =
            std::find_if(surfaces.begin(), surfaces.end(), [&](const SchemeParts& s) { return s.scheme == scheme; });
        if (own == surfaces.end()) {
            own = surfaces.insert(own, {scheme, chosen, {}});
        }
        own->chosen = own->chosen && chosen;
        own->parts.push_back(part);
    }
    return surfaces;
}

} // namespace supple::runtime
