#include "surface/choice.h"

#include "cage/corner_normals.h"
#include "cage/parts.h"
#include "cage/topology.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace supple::surface {

namespace {

/// From this share on, hard edges are everywhere: of the edges where the surface bends, since an edge within a flat
/// face is never hard. Measured: boxes have 92 to 100 %, box-like robots and flat-shaded characters 73 to 100 %, a
/// figure of blocks 70 %, a sword and a shield with spikes 57 and 54 %; armour and other props, which have smooth faces
/// between their hard edges, 0 to 45 %; cages modelled for subdivision 0 to 3 %.
constexpr double kHardShare = 0.5;

/// What is counted over the parts of one choice.
struct Counts {
    uint64_t polygons = 0;  ///< triangles in faces of more than three sides
    uint64_t triangles = 0; ///< faces of three sides
    uint64_t bent = 0;      ///< edges between faces that do not lie in one plane
    uint64_t hard = 0;      ///< of these, edges whose normals are split
    bool known = true;      ///< all polygons are as someone has drawn them
    bool paired = false;    ///< some are quads made of triangles

    [[nodiscard]] bool mostlyTriangles() const { return triangles > polygons; }
};

std::vector<glm::dvec3> faceNormals(const cage::Cage& cage) {
    std::vector<glm::dvec3> normals;
    normals.reserve(cage.faceCount());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t first = cage.faceStarts[face];
        const auto fromFirst = [&](uint32_t corner) {
            return glm::dvec3(cage.positions[cage.faceVertices[corner]]) -
                   glm::dvec3(cage.positions[cage.faceVertices[first]]);
        };
        glm::dvec3 area(0.0);
        for (uint32_t corner = first + 1; corner + 1 < cage.faceStarts[face + 1]; ++corner) {
            area += glm::cross(fromFirst(corner), fromFirst(corner + 1));
        }
        const double length = glm::length(area);
        normals.push_back(length > 0.0 ? area / length : glm::dvec3(0.0));
    }
    return normals;
}

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
    if (cage.cornerNormals.empty()) {
        return counts;
    }
    const std::vector<glm::dvec3> normals = faceNormals(cage);
    for (const cage::Topology::Edge& edge : topology.edges) {
        if (edge.twin == cage::kNone) {
            continue;
        }
        const uint32_t face = topology.cornerFaces[edge.corner];
        const uint32_t other = topology.cornerFaces[edge.twin];
        if (!cage::normalsAgree(glm::vec3(normals[face]), glm::vec3(normals[other]))) {
            ++countsOf(face).bent;
            countsOf(face).hard += cage::hasSplitNormals(cage, topology, edge) ? 1 : 0;
        }
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
    if (counts.hard > 0 && static_cast<double>(counts.hard) >= kHardShare * static_cast<double>(counts.bent)) {
        const auto percent = std::lround(100.0 * static_cast<double>(counts.hard) / static_cast<double>(counts.bent));
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
