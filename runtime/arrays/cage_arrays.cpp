#include "runtime/arrays/cage_arrays.h"

#include "cage/corner_normals.h"
#include "cage/sharp_features.h"
#include "cage/trim.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace supple::runtime {

namespace {

using cage::Found;
using cage::kNone;
using std::to_string;

static_assert(SUPPLE_NO_TRIM_TILE == kNone && SUPPLE_NO_MATERIAL == kNone && SUPPLE_NO_CREASE_SET == kNone);

/// Gathers what is wrong with the arrays, one line for each kind of fault.
class CageCheck {
public:
    CageCheck(const SuppleCageDesc& desc, std::span<const cage::Material> materials, Faults& faults)
        : desc_(desc), materials_(materials), faults_(faults) {}

    void run() {
        if (!checkPointers()) {
            return;
        }
        checkNumbers(desc_.positions, desc_.vertexCount, 3, "vertex", "position is not finite or beyond 1e+09",
                     "positions are not finite or beyond 1e+09", faults_);
        if (!checkFaces()) {
            return;
        }
        checkCorners();
        checkTriangles();
        checkMaterials();
        checkTiles();
        checkSharpness();
        checkLists();
    }

private:
    bool checkPointers() {
        if (desc_.positions == nullptr || (desc_.faceCount > 0 && desc_.faceVertexCounts == nullptr) ||
            (desc_.faceCount > 0 && desc_.faceVertexIndices == nullptr)) {
            faults_.add("positions, faceVertexCounts or faceVertexIndices is null", ErrorCode::nullPointer);
            return false;
        }
        if (desc_.vertexCount == 0 || desc_.faceCount == 0) {
            faults_.add(desc_.vertexCount == 0 ? "empty: no vertices, so there is no surface"
                                               : "nothing but points: no faces, so there is no surface");
            return false;
        }
        if (desc_.vertexCount > cage::kMaxVertices) {
            faults_.add("more than " + to_string(cage::kMaxVertices) + " vertices", ErrorCode::limit);
            return false;
        }
        bool fine = faults_.present(desc_.creaseCount, "creaseVertices or creaseSharpnesses", desc_.creaseVertices,
                                    desc_.creaseSharpnesses);
        fine = faults_.present(desc_.cornerCount, "cornerVertices or cornerSharpnesses", desc_.cornerVertices,
                               desc_.cornerSharpnesses) &&
               fine;
        fine = faults_.present(desc_.creaseScalarCount, "creaseScalars", desc_.creaseScalars) && fine;
        fine = faults_.present(desc_.creaseSetCount, "creaseSetNames", desc_.creaseSetNames) && fine;
        fine = faults_.present(desc_.roundCornerCount, "roundCorners", desc_.roundCorners) && fine;
        return faults_.present(desc_.holeCount, "holes", desc_.holes) && fine;
    }

    /// False if corners cannot be counted.
    bool checkFaces() {
        Found found;
        for (uint32_t f = 0; f < desc_.faceCount; ++f) {
            const uint64_t first = corners_;
            corners_ += desc_.faceVertexCounts[f];
            if (corners_ > cage::kMaxCorners) {
                faults_.add("face " + to_string(f) + ": more than " + to_string(cage::kMaxCorners) + " corners",
                            ErrorCode::limit);
                return false;
            }
            for (uint64_t c = first; c < corners_; ++c) {
                if (desc_.faceVertexIndices[c] >= desc_.vertexCount) {
                    found.add([&] {
                        return "vertex " + to_string(desc_.faceVertexIndices[c]) + " of " +
                               to_string(desc_.vertexCount) + " in face " + to_string(f);
                    });
                }
            }
        }
        faults_.add(found, "corner names no vertex", "corners name no vertex");
        return true;
    }

    void checkCorners() {
        const auto check = [&](const float* values, size_t width, const char* one, const char* many) {
            checkNumbers(values, corners_, width, "corner", one, many, faults_);
        };
        check(desc_.cornerUvs, 2, "of cornerUvs is not finite or beyond 1e+09",
              "of cornerUvs are not finite or beyond 1e+09");
        check(desc_.cornerUvs1, 2, "of cornerUvs1 is not finite or beyond 1e+09",
              "of cornerUvs1 are not finite or beyond 1e+09");
        check(desc_.cornerColors, 4, "of cornerColors is not finite or beyond 1e+09",
              "of cornerColors are not finite or beyond 1e+09");
        check(desc_.cornerNormals, 3, "of cornerNormals is not finite or beyond 1e+09",
              "of cornerNormals are not finite or beyond 1e+09");
        check(desc_.cornerTangents, 4, "of cornerTangents is not finite or beyond 1e+09",
              "of cornerTangents are not finite or beyond 1e+09");
    }

    void checkTriangles() {
        Found found;
        uint64_t start = 0;
        size_t corner = 0;
        for (uint32_t f = 0; f < desc_.faceCount && desc_.faceTriangles != nullptr; ++f) {
            const uint32_t sides = desc_.faceVertexCounts[f];
            for (uint32_t k = 0; sides > 2 && k < 3 * (sides - 2); ++k, ++corner) {
                const uint32_t named = desc_.faceTriangles[corner];
                if (named < start || named - start >= sides) {
                    found.add([&] { return "corner " + to_string(named) + " of face " + to_string(f); });
                }
            }
            start += sides;
        }
        faults_.add(found, "of faceTriangles is no corner of its face",
                    "of faceTriangles are no corners of their face");
    }

    void checkMaterials() {
        Found found;
        for (uint32_t f = 0; f < desc_.faceCount && desc_.faceMaterials != nullptr; ++f) {
            const uint32_t material = desc_.faceMaterials[f];
            if (material != SUPPLE_NO_MATERIAL && material >= materials_.size()) {
                found.add([&] {
                    return "material " + to_string(material) + " of " + to_string(materials_.size()) + " at face " +
                           to_string(f);
                });
            }
        }
        faults_.add(found, "face has no such material", "faces have no such material");
    }

    /// How many tiles a face can choose from.
    [[nodiscard]] uint32_t tilesAt(uint32_t face) const {
        const uint32_t material = desc_.faceMaterials != nullptr ? desc_.faceMaterials[face] : kNone;
        const bool ofFaces = material < materials_.size() && materials_[material].trim &&
                             materials_[material].trim->domain == cage::TrimDomain::face;
        return ofFaces ? materials_[material].trim->tiles : cage::kMaxTrimTiles;
    }

    void checkTiles() {
        Found found;
        for (uint32_t f = 0; f < desc_.faceCount && desc_.faceTrimTiles != nullptr; ++f) {
            const uint32_t tile = desc_.faceTrimTiles[f];
            if (tile != SUPPLE_NO_TRIM_TILE && tile >= tilesAt(f)) {
                found.add([&] {
                    return "tile " + to_string(tile) + " of " + to_string(tilesAt(f)) + " at face " + to_string(f);
                });
            }
        }
        faults_.add(found, "face has no such trim tile", "faces have no such trim tiles");
        for (uint32_t f = 0; f < desc_.faceCount && desc_.faceMaterials != nullptr; ++f) {
            const uint32_t material = desc_.faceMaterials[f];
            if (material >= materials_.size() || !materials_[material].trim ||
                materials_[material].trim->domain != cage::TrimDomain::uv) {
                continue;
            }
            const uint32_t uvSet = materials_[material].trim->texture.uvSet;
            if ((uvSet == 0 ? desc_.cornerUvs : desc_.cornerUvs1) == nullptr) {
                faults_.add(std::string(uvSet == 0 ? "cornerUvs" : "cornerUvs1") +
                            " is null, on which the trim of material " + to_string(material) + " lies");
                return;
            }
        }
    }

    void checkSharpness() {
        const auto isVertex = [&](uint32_t v) { return v < desc_.vertexCount; };
        Found creases;
        Found loops;
        for (uint32_t i = 0; i < desc_.creaseCount; ++i) {
            const uint32_t a = desc_.creaseVertices[2 * size_t{i}], b = desc_.creaseVertices[2 * size_t{i} + 1];
            if (!isVertex(a) || !isVertex(b) || !(desc_.creaseSharpnesses[i] >= 0.0f)) {
                creases.add([&] { return "crease " + to_string(i); });
            } else if (a == b) {
                loops.add([&] { return "crease " + to_string(i); });
            }
        }
        faults_.add(creases, "crease has no such vertices, or no sharpness of 0 and more",
                    "creases have no such vertices, or no sharpness of 0 and more");
        faults_.add(loops, "crease has one vertex at both ends", "creases have one vertex at both ends");
        Found corners;
        for (uint32_t i = 0; i < desc_.cornerCount; ++i) {
            if (!isVertex(desc_.cornerVertices[i]) || !(desc_.cornerSharpnesses[i] >= 0.0f)) {
                corners.add([&] { return "corner " + to_string(i); });
            }
        }
        faults_.add(corners, "corner has no such vertex, or no sharpness of 0 and more",
                    "corners have no such vertex, or no sharpness of 0 and more");
        Found scalars;
        for (uint32_t i = 0; i < desc_.creaseScalarCount; ++i) {
            const SuppleCreaseScalar& scalar = desc_.creaseScalars[i];
            if (!isVertex(scalar.vertex) || !isVertex(scalar.toward) ||
                !(scalar.alpha >= 0.0f && scalar.alpha <= 1.0f)) {
                scalars.add([&] { return "crease scalar " + to_string(i); });
            }
        }
        faults_.add(scalars, "crease scalar has no such vertices, or an alpha that is not in [0, 1]",
                    "crease scalars have no such vertices, or an alpha that is not in [0, 1]");
        (void)checkCreaseSets(desc_.creaseSetCount, desc_.creaseSetNames, desc_.creaseCount, desc_.creaseSets, faults_);
    }

    void checkLists() {
        Found holes;
        for (uint32_t i = 0; i < desc_.holeCount; ++i) {
            if (desc_.holes[i] >= desc_.faceCount) {
                holes.add([&] {
                    return "hole " + to_string(i) + ", face " + to_string(desc_.holes[i]) + " of " +
                           to_string(desc_.faceCount);
                });
            }
        }
        faults_.add(holes, "hole is no face", "holes are no faces");
        Found round;
        for (uint32_t i = 0; i < desc_.roundCornerCount; ++i) {
            if (desc_.roundCorners[i] >= desc_.vertexCount ||
                (i > 0 && desc_.roundCorners[i] <= desc_.roundCorners[i - 1])) {
                round.add([&] { return "round corner " + to_string(i); });
            }
        }
        faults_.add(round, "round corner is no vertex, or does not rise",
                    "round corners are no vertices, or do not rise");
    }

    const SuppleCageDesc& desc_;
    std::span<const cage::Material> materials_;
    Faults& faults_;
    uint64_t corners_ = 0;
};

/// Copies sound arrays into a cage.
class CageCopy {
public:
    CageCopy(const SuppleCageDesc& desc, cage::PartCage& part, Faults& faults)
        : desc_(desc), part_(part), cage_(part.cage), faults_(faults) {}

    void run() {
        findFaces();
        if (cage_.faceCount() == 0) {
            faults_.add("no face is left: all have fewer than three different vertices or bound nothing");
            return;
        }
        findVertices();
        copyCorners();
        copyFaces();
        copySharpness();
        part_.sourceVertexCount = desc_.vertexCount;
    }

private:
    void tell(const Found& found, const char* one, const char* many) {
        if (found.count > 0) {
            part_.damages.push_back({part_.element + ": " + found.told(one, many), "left out"});
        }
    }

    /// Those that have three corners and more.
    void findFaces() {
        Found found;
        uint32_t first = 0;
        cage_.faceStarts.push_back(0);
        for (uint32_t f = 0; f < desc_.faceCount; ++f) {
            const uint32_t sides = desc_.faceVertexCounts[f];
            facePlaces_.push_back(sides < 3 ? kNone : cage_.faceCount());
            if (sides < 3) {
                found.add([&] { return "face " + to_string(f); });
            } else {
                faces_.push_back({f, first});
                cage_.faceStarts.push_back(cage_.faceStarts.back() + sides);
            }
            first += sides;
        }
        tell(found, "face has fewer than three corners", "faces have fewer than three corners");
    }

    /// Those that have a face.
    void findVertices() {
        places_.assign(desc_.vertexCount, kNone);
        forEachCorner([&](uint32_t c) { places_[desc_.faceVertexIndices[c]] = 0; });
        Found loose;
        for (uint32_t v = 0; v < desc_.vertexCount; ++v) {
            if (places_[v] == kNone) {
                loose.add([&] { return "vertex " + to_string(v); });
                continue;
            }
            places_[v] = cage_.vertexCount();
            const float* p = desc_.positions + 3 * size_t{v};
            cage_.positions.emplace_back(p[0], p[1], p[2]);
            cage_.sourceVertices.push_back(v);
        }
        tell(loose, "vertex has no face", "vertices have no face");
    }

    template <class Take>
    void forEachCorner(Take&& take) const {
        for (const Face& face : faces_) {
            for (uint32_t c = face.firstCorner; c < face.firstCorner + desc_.faceVertexCounts[face.face]; ++c) {
                take(c);
            }
        }
    }

    void copyCorners() {
        forEachCorner([&](uint32_t corner) {
            const size_t c = corner;
            cage_.faceVertices.push_back(places_[desc_.faceVertexIndices[c]]);
            if (desc_.cornerUvs != nullptr) {
                cage_.cornerUvs.emplace_back(desc_.cornerUvs[2 * c], desc_.cornerUvs[2 * c + 1]);
            }
            if (desc_.cornerUvs1 != nullptr) {
                cage_.cornerUvs1.emplace_back(desc_.cornerUvs1[2 * c], desc_.cornerUvs1[2 * c + 1]);
            }
            if (const float* color = desc_.cornerColors; color != nullptr) {
                cage_.cornerColors.emplace_back(color[4 * c], color[4 * c + 1], color[4 * c + 2], color[4 * c + 3]);
            }
            if (const float* normals = desc_.cornerNormals; normals != nullptr) {
                cage_.cornerNormals.push_back(
                    cage::unitNormal({normals[3 * c], normals[3 * c + 1], normals[3 * c + 2]}));
            }
            if (const float* t = desc_.cornerTangents; t != nullptr && desc_.cornerNormals != nullptr) {
                cage_.cornerTangents.push_back(cage::unitTangent({t[4 * c], t[4 * c + 1], t[4 * c + 2], t[4 * c + 3]}));
            }
        });
    }

    void copyFaces() {
        size_t triangle = 0;
        for (uint32_t f = 0; f < faces_.size(); ++f) {
            const Face& from = faces_[f];
            if (desc_.faceMaterials != nullptr) {
                cage_.faceMaterials.push_back(desc_.faceMaterials[from.face]);
            }
            if (desc_.faceTrimTiles != nullptr) {
                cage_.faceTrimTiles.push_back(desc_.faceTrimTiles[from.face]);
            }
            for (uint32_t k = 0; desc_.faceTriangles != nullptr && k < 3 * (cage_.sides(f) - 2); ++k) {
                cage_.faceTriangles.push_back(cage_.faceStarts[f] + desc_.faceTriangles[triangle++] - from.firstCorner);
            }
        }
        for (uint32_t i = 0; i < desc_.holeCount; ++i) {
            if (const uint32_t place = facePlaces_[desc_.holes[i]]; place != kNone) {
                cage_.holes.push_back(place);
            }
        }
        std::sort(cage_.holes.begin(), cage_.holes.end());
        cage_.holes.erase(std::unique(cage_.holes.begin(), cage_.holes.end()), cage_.holes.end());
    }

    /// What is at a vertex without a face is left out with it.
    void copySharpness() {
        cage::SharpFeatures features;
        std::vector<uint32_t> sets; // as the names come, whether or not they have creases
        for (uint32_t i = 0; i < desc_.creaseSetCount; ++i) {
            sets.push_back(cage::creaseSetOf(desc_.creaseSetNames[i], cage_));
        }
        for (uint32_t i = 0; i < desc_.creaseCount; ++i) {
            const uint32_t a = places_[desc_.creaseVertices[2 * size_t{i}]],
                           b = places_[desc_.creaseVertices[2 * size_t{i} + 1]];
            if (a != kNone && b != kNone) {
                const bool inSet = desc_.creaseSets != nullptr && desc_.creaseSets[i] != SUPPLE_NO_CREASE_SET;
                features.addCrease({a, b, desc_.creaseSharpnesses[i], inSet ? sets[desc_.creaseSets[i]] : kNone},
                                   cage_);
            }
        }
        for (uint32_t i = 0; i < desc_.cornerCount; ++i) {
            if (const uint32_t v = places_[desc_.cornerVertices[i]]; v != kNone) {
                features.addCorner(v, desc_.cornerSharpnesses[i], cage_);
            }
        }
        for (uint32_t i = 0; i < desc_.creaseScalarCount; ++i) {
            const SuppleCreaseScalar& from = desc_.creaseScalars[i];
            if (places_[from.vertex] != kNone && places_[from.toward] != kNone) {
                cage_.creaseScalars.push_back({places_[from.vertex], places_[from.toward], from.alpha});
            }
        }
        for (uint32_t i = 0; i < desc_.roundCornerCount; ++i) {
            if (const uint32_t v = places_[desc_.roundCorners[i]]; v != kNone) {
                cage_.roundCorners.push_back(v);
            }
        }
    }

    struct Face {
        uint32_t face = 0; ///< in the arrays
        uint32_t firstCorner = 0;
    };

    const SuppleCageDesc& desc_;
    cage::PartCage& part_;
    cage::Cage& cage_;
    Faults& faults_;
    std::vector<Face> faces_;          ///< that are kept
    std::vector<uint32_t> facePlaces_; ///< in the cage, kNone for those that are not
    std::vector<uint32_t> places_;     ///< of vertices
};

} // namespace

bool checkCreaseSets(uint32_t setCount, const char* const* names, uint32_t creaseCount, const uint32_t* sets,
                     Faults& faults) {
    Found nameless, wrong;
    for (uint32_t set = 0; set < setCount; ++set) {
        if (names[set] == nullptr || names[set][0] == '\0') {
            nameless.add([&] { return "crease set " + to_string(set); });
        }
    }
    for (uint32_t crease = 0; sets != nullptr && crease < creaseCount; ++crease) {
        if (sets[crease] != SUPPLE_NO_CREASE_SET && sets[crease] >= setCount) {
            wrong.add([&] {
                return "set " + to_string(sets[crease]) + " of " + to_string(setCount) + ", of crease " +
                       to_string(crease);
            });
        }
    }
    faults.add(nameless, "crease set has no name", "crease sets have no names");
    faults.add(wrong, "crease is in no such set", "creases are in no such sets");
    return nameless.count == 0 && wrong.count == 0;
}

void readCageArrays(const SuppleCageDesc& desc, std::span<const cage::Material> materials, cage::PartCage& part,
                    Faults& faults) {
    CageCheck(desc, materials, faults).run();
    if (faults.none()) {
        CageCopy(desc, part, faults).run();
    }
}

} // namespace supple::runtime
