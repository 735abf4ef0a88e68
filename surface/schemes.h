// The surface schemes, one row each. A new one is a folder beside prep/ and pm/, one in shaders/, its kernels in
// CMakeLists.txt, and a row here.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "surface/patch_edges.h"
#include "surface/recipe.h"
#include "surface/scheme.h"
#include "surface/table_check.h"

#include <span>
#include <string>

namespace supple::surface {

/// Which rates one set of tables serves.
enum class RateRule : uint32_t {
    any,      ///< all rates
    one,      ///< one rate. It is even if the scheme subdivides the cage first
    upTo,     ///< as `one`, and all below it
    doubling, ///< one rate, which is a power of two
    none      ///< there is nothing to tessellate: the rate is 1, whatever a group asks for
};

constexpr uint32_t uvModeBit(cage::UvMode mode) {
    return 1u << static_cast<uint32_t>(mode);
}
inline constexpr uint32_t kLinearUvs = uvModeBit(cage::UvMode::all);
inline constexpr uint32_t kAllUvModes = 2 * kLinearUvs - 1;

struct Scheme {
    SchemeId id = SchemeId::pm;
    RateRule rates = RateRule::any;
    const char* name = "";
    /// Builds the tables, or says why the scheme cannot take the cage. Recipe::attributes, lod and indexedMesh are not
    /// its business, except that tables for lod need no rate. If levels or an indexed mesh ask, `edges` is not null,
    /// and takes which sides of patches are one edge.
    Result<Tables> (*build)(const Recipe& recipe, const cage::Cage& cage, PatchEdges* edges) = nullptr;
    const char* ratesInWords = ""; ///< for messages: how many segments an edge of the cage can have
    bool hasLevels = false;        ///< a view can draw its patches at real-valued levels. If not, see hasRates()
    bool hasIndexedMesh = false;   ///< patches can share the samples on their borders, or the scheme is a mesh
    bool ofMapping = false;        ///< its tables differ by mapping (Recipe::wide)
    bool hasFanRecords = false;    ///< see Recipe::fanRecords
    bool hasDirect = false;        ///< hosts' shaders can evaluate its patches (surface/direct_tables.h)
    uint32_t uvModes = kLinearUvs; ///< how it interpolates texture coordinates: a bit per cage::UvMode
    /// How far the surface can reach beyond the box of its cage, as a fraction of the box's size. This is the largest
    /// sum of the negative weights of a sample.
    float (*boundsMargin)(const cage::Cage& cage) = nullptr;
    /// Checks what is the scheme's own in tables that come from a file (surface/table_check.h).
    void (*check)(TableCheck& check) = nullptr;

    /// Its tables list the triangles of a mesh (Tables::triangles): it is an indexed mesh in any case.
    [[nodiscard]] bool isMesh() const { return rates == RateRule::none; }
    /// A view can draw each instance at one of several rates. Without this and without levels it draws none.
    [[nodiscard]] bool hasRates() const { return rates == RateRule::doubling || isMesh(); }
    [[nodiscard]] bool interpolates(cage::UvMode mode) const { return (uvModes & uvModeBit(mode)) != 0; }
    /// Recipe::rate for a group that asks for `rate` segments along an edge of the cage.
    [[nodiscard]] uint32_t tableRate(uint32_t rate, bool lod) const;
};

/// Whether tables of the recipe `own` serve another as well as its own would: it is the same, or differs in nothing but
/// a lower rate (RateRule::upTo) for which the same coefficients are made. Those of much higher rates would serve, too,
/// but make points in every frame that nobody asks for.
[[nodiscard]] bool serves(const Recipe& own, const Tables& tables, const Recipe& recipe);

/// Those that hosts can name.
[[nodiscard]] std::span<const Scheme> schemes();
[[nodiscard]] const Scheme& schemeOf(SchemeId id);

/// Builds the tables, or says why it cannot: "face 12 has 5 sides: p-rep takes quads only".
[[nodiscard]] Result<Tables> buildTables(const Recipe& recipe, const cage::Cage& cage);

} // namespace supple::surface
