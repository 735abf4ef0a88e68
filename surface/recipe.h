// What a scheme's tables depend on besides the cage.
#pragma once

#include "cage/character.h"
#include "cage/materials.h"

#include <cstdint>
#include <vector>

namespace supple::surface {

// What the schemes that have options take.

namespace prep {

/// The length of the tangents at extraordinary vertices. `printed` is equation (3) of the paper as it stands.
/// `standard`, the default of the API, equals it up to valence 5 and stays close to Catmull-Clark from valence 6 on.
/// Both surfaces are G1.
enum class TangentMode { standard, printed };

/// What is done at a boundary vertex with one face: `sharp` interpolates it, `smooth` treats it as a control point of
/// the boundary B-spline like any other.
enum class CornerRule { sharp, smooth };

struct Options {
    TangentMode tangentMode = TangentMode::standard;
    CornerRule cornerRule = CornerRule::sharp;

    bool operator==(const Options&) const = default;
};

} // namespace prep

namespace blend {

/// What is done at a vertex that a crease passes.
enum class CreaseMode : uint8_t {
    cut,  ///< one chart per side: two smooth sheets that meet in the crease
    curve ///< the crease curve alone, as published: the surface forms a narrow ridge there
};

struct Options {
    CreaseMode creases = CreaseMode::cut;
    float sharpThreshold = 1.0f; ///< edges of this sharpness and more are sharp, all others smooth

    bool operator==(const Options&) const = default;
};

} // namespace blend

/// Values of SuppleScheme; but for loopFragments: fragments whose group asks for Loop's rules.
enum class SchemeId : uint32_t {
    prep = 1,
    pm = 2,
    catmullClark = 3,
    loop = 4,
    blend = 5,
    polygons = 6,
    fragments = 7,
    loopFragments = 0x100
};

struct Recipe {
    SchemeId scheme = SchemeId::pm;
    prep::Options prep;
    blend::Options blend;
    uint32_t rate = 0;      ///< segments along an edge of the cage (Scheme::tableRate); 0: tables for all rates
    bool attributes = true; ///< the tables have corner attributes
    bool tangents = false;  ///< of a mesh with attributes: vertices have tangents, and differ where these do
    /// With tangents, by material: how its normal map lies (cage::mapFramesOf).
    std::vector<cage::MapFrame> mapFrames;
    /// How texture coordinates are interpolated; all: linearly. Without attributes it does not matter.
    cage::UvMode uvMode = cage::UvMode::all;
    bool lod = false;         ///< the tables have what level of detail needs
    bool indexedMesh = false; ///< patches share the samples on their borders
    bool wide = false; ///< for the wide mapping (gpu/mapping.h), if the scheme's tables differ (Scheme::ofMapping)
    /// The pool has records of fans in the place of what patches have at their corners (shaders/shared/prep.h), if the
    /// scheme has that (Scheme::hasFanRecords). Not with lod or indexedMesh. Files never have such tables.
    bool fanRecords = false;

    bool operator==(const Recipe&) const = default;
};

} // namespace supple::surface
