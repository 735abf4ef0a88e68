#include "surface/choice.h"

#include "cage/normal_creases.h"
#include "cage/parts.h"
#include "cage/topology.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace supple::surface {

namespace {

/// What is counted over the parts of one choice.
struct Counts {
    uint64_t polygons = 0;  ///< triangles in faces of more than three sides
    uint64_t triangles = 0; ///< faces of three sides
    cage::EdgeCounts edges;
    bool known = true;   ///< all polygons are as someone has drawn them
    bool paired = false; ///< some are quads made of triangles

    [[nodiscard]] bool mostlyTriangles() const { return triangles > polygons; }
};

/// Counts for each group, at the place of its smallest part.
std::vector<Counts> count(const cage::Character& character, const cage::Topology& topology,
                          const std::vector<uint32_t>& groups) {
    using cage::PolygonSource;
    const cage::Cage& cage = character.cage;
    std::vector<Counts> counts(groups.size());
    for (size_t part = 0; part < groups.size(); ++part) {
        const PolygonSource source = character.parts[part].polygonSource;
        Counts& group = counts[groups[part]];
        group.known = group.known && source != PolygonSource::triangles && source != PolygonSource::pairedTriangles;
        group.paired = group.paired || source == PolygonSource::pairedTriangles;
    }
    const auto countsOf = [&](uint32_t face) -> Counts& {
        return counts[groups[cage.faceParts.empty() ? 0 : cage.faceParts[face]]];
    };
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t sides = cage.sides(face);
        (sides > 3 ? countsOf(face).polygons : countsOf(face).triangles) += sides - 2;
    }
    const std::vector<cage::EdgeCounts> edges = cage::countHardEdges(cage, topology, groups);
    for (size_t group = 0; group < groups.size(); ++group) {
        counts[group].edges = edges[group];
    }
    return counts;
}

/// What the files say of all parts of each group, at the place of its smallest part.
std::vector<std::optional<cage::MadeFor>> intents(const cage::Character& character,
                                                  const std::vector<uint32_t>& groups) {
    std::vector<std::optional<cage::MadeFor>> intents(groups.size());
    for (size_t part = 0; part < groups.size(); ++part) {
        const bool first = groups[part] == part;
        const std::optional<cage::MadeFor>& own = character.parts[part].madeFor;
        std::optional<cage::MadeFor>& group = intents[groups[part]];
        group = first || group == own ? own : std::nullopt;
    }
    return intents;
}

SchemeChoice choose(cage::MadeFor madeFor) {
    const std::string reason = std::string("its file says that it was made for ") + cage::madeForName(madeFor);
    switch (madeFor) {
    case cage::MadeFor::catmullClark:
        return {SchemeId::catmullClark, reason};
    case cage::MadeFor::loop:
        return {SchemeId::loop, reason};
    case cage::MadeFor::bilinear:
        return {SchemeId::polygons, reason};
    case cage::MadeFor::none:
        break;
    }
    return {SchemeId::polygons, "its file says that it is not subdivided"};
}

SchemeChoice choose(const Counts& counts) {
    if (counts.known && !counts.mostlyTriangles()) {
        return {SchemeId::catmullClark, "its polygons are known"};
    }
    if (counts.edges.isHardEverywhere()) {
        const auto percent =
            std::lround(100.0 * static_cast<double>(counts.edges.hard) / static_cast<double>(counts.edges.bent));
        return {SchemeId::polygons, std::to_string(percent) + " % of the edges where it bends are hard"};
    }
    if (!counts.mostlyTriangles()) {
        return {SchemeId::catmullClark,
                counts.paired ? "its triangles pair into quads" : "most of its polygons are known"};
    }
    return {SchemeId::loop,
            counts.polygons > 0 ? "most of its faces are smooth triangles" : "its triangles are smooth"};
}

} // namespace

std::vector<SchemeChoice> chooseSchemes(const cage::Character& character) {
    const Result<cage::Topology> topology = cage::buildTopology(character.cage);
    if (!topology) {
        return {character.parts.size(), {SchemeId::polygons, "it is no manifold: " + topology.error().message}};
    }
    const std::vector<uint32_t> groups = cage::sewnTo(character.cage, character.parts.size());
    const std::vector<Counts> counts = count(character, *topology, groups);
    const std::vector<std::optional<cage::MadeFor>> madeFor = intents(character, groups);
    std::vector<SchemeChoice> choices;
    choices.reserve(groups.size());
    for (const uint32_t group : groups) {
        choices.push_back(madeFor[group] ? choose(*madeFor[group]) : choose(counts[group]));
    }
    return choices;
}

} // namespace supple::surface
