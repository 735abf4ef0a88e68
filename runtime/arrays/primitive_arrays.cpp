#include "runtime/arrays/primitive_arrays.h"

#include "cage/corner_normals.h"
#include "cage/split/cage.h"
#include "cage/trim.h"
#include "runtime/arrays/cage_arrays.h"
#include "runtime/arrays/vertex_arrays.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace supple::runtime {

namespace {

using cage::Found;
using cage::kNone;

/// Reads the primitives of a part one after the other.
class PrimitiveReader {
public:
    PrimitiveReader(const SupplePartDesc& part, const cage::MeshBinding& binding, const PartContext& context,
                    cage::split::Mesh& mesh)
        : part_(part), binding_(binding), context_(context), mesh_(mesh) {}

    void read(const SupplePrimitiveDesc& desc, Faults& faults) {
        cage::split::Primitive& to = mesh_.primitives.emplace_back();
        to.element = faults.element();
        to.vertexCount = desc.vertexCount;
        to.firstVertex = static_cast<uint32_t>(mesh_.positions.size());
        to.roundCorners = part_.roundCorners != 0;
        corners_ += uint64_t{3} * desc.triangleCount;
        if (mesh_.positions.size() + desc.vertexCount > cage::kMaxVertices || corners_ > cage::kMaxCorners) {
            faults.add("more than " + std::to_string(cage::kMaxVertices) + " vertices or " +
                           std::to_string(cage::kMaxCorners) + " corners",
                       ErrorCode::limit);
            return;
        }
        if (desc.sharedVertices != 0) {
            shareVertices(desc, to, faults);
        } else {
            readVertices(desc, faults);
        }
        readMaterial(desc, to, faults);
        readTriangles(desc, to, faults);
        readPolygons(desc, to, faults);
        readAttributes(desc, to, faults);
        readSharpness(desc, to, faults);
    }

private:
    void shareVertices(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        if (desc.positions != nullptr || desc.displacements != nullptr || desc.cageVertices != nullptr) {
            faults.add("sharedVertices beside positions, displacements or cageVertices");
        }
        refuseInfluences(desc.influences, faults);
        if (desc.sharedVertices >= mesh_.primitives.size() ||
            mesh_.primitives[desc.sharedVertices - 1].vertexCount != desc.vertexCount) {
            faults.add("sharedVertices " + std::to_string(desc.sharedVertices) +
                       " is not the number + 1 of a primitive before it with as many vertices");
            return;
        }
        to.firstVertex = mesh_.primitives[desc.sharedVertices - 1].firstVertex;
    }

    void readVertices(const SupplePrimitiveDesc& desc, Faults& faults) {
        const uint32_t count = desc.vertexCount;
        if (!faults.present(1, "positions", desc.positions)) {
            return;
        }
        checkNumbers(desc.positions, count, 3, "vertex", "position is not finite or beyond 1e+09",
                     "positions are not finite or beyond 1e+09", faults);
        for (uint32_t v = 0; v < count; ++v) {
            const float* p = desc.positions + 3 * size_t{v};
            mesh_.positions.emplace_back(p[0], p[1], p[2]);
        }
        if (!binding_.skinned) {
            refuseInfluences(desc.influences, faults);
            mesh_.weights.appendUnskinned(count);
        } else if (checkInfluences(desc.influences, count, binding_.skin.joints.size(), faults)) {
            std::vector<uint32_t> all(count);
            std::iota(all.begin(), all.end(), 0u);
            appendInfluences(desc.influences, all, binding_.skin.joints.size(), mesh_.weights);
        }
        std::vector<std::pair<uint32_t, cage::split::MorphDelta>> moved;
        const bool displaced = faults.present(part_.targetCount, "displacements", desc.displacements);
        for (uint32_t t = 0; displaced && t < part_.targetCount; ++t) {
            const auto own = readDisplacements(desc.displacements[t], t, count, faults);
            moved.insert(moved.end(), own.begin(), own.end());
        }
        mesh_.morphs.append(count, moved);
        if (desc.cageVertices != nullptr) {
            mesh_.cageNumbers.insert(mesh_.cageNumbers.end(), desc.cageVertices, desc.cageVertices + count);
        }
        if (!mesh_.cageNumbers.empty() && mesh_.cageNumbers.size() != mesh_.positions.size()) {
            faults.add("cageVertices are not on all primitives");
        }
    }

    void readMaterial(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        if (desc.material == SUPPLE_NO_MATERIAL) {
            return;
        }
        if (desc.material >= context_.materials.size()) {
            faults.add("material " + std::to_string(desc.material) + " of " +
                       std::to_string(context_.materials.size()));
            return;
        }
        to.material = static_cast<int>(desc.material);
        const auto& trim = context_.materials[desc.material].trim;
        if (trim && trim->domain == cage::TrimDomain::uv &&
            (trim->texture.uvSet == 0 ? desc.uvs : desc.uvs1) == nullptr) {
            faults.add(std::string(trim->texture.uvSet == 0 ? "uvs" : "uvs1") + " is null, on which the trim of " +
                       cage::at("material", desc.material) + " lies");
        }
    }

    void readTriangles(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        if (!faults.present(desc.triangleCount, "triangles", desc.triangles)) {
            return;
        }
        Found found;
        for (size_t c = 0; c < size_t{3} * desc.triangleCount; ++c) {
            if (desc.triangles[c] >= desc.vertexCount) {
                found.add([&] {
                    return "vertex " + std::to_string(desc.triangles[c]) + " of " + std::to_string(desc.vertexCount) +
                           " in triangle " + std::to_string(c / 3);
                });
            }
            to.triangles.push_back(to.firstVertex + desc.triangles[c]);
        }
        faults.add(found, "corner names no vertex", "corners name no vertex");
    }

    void readPolygons(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        if (rawValue(desc.polygons) > SUPPLE_POLYGONS_HIDDEN_EDGES) {
            faults.add("no such polygons", ErrorCode::range);
        } else if (desc.polygons == SUPPLE_POLYGONS_FANS) {
            to.faces.source = cage::PolygonSource::ngonEncoding;
        } else if (desc.polygons == SUPPLE_POLYGONS_HIDDEN_EDGES) {
            to.faces.source = cage::PolygonSource::hiddenEdges;
            if (faults.present(1, "hiddenEdges", desc.hiddenEdges)) {
                to.faces.hidden.assign(desc.hiddenEdges, desc.hiddenEdges + size_t{3} * desc.triangleCount);
            }
        } else if (desc.polygons == SUPPLE_POLYGONS_LISTED) {
            to.faces.source = cage::PolygonSource::cageExtension;
            readListed(desc, to, faults);
        }
    }

    void readListed(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        if (!faults.present(1, "faceVertexCounts or faceVertexIndices", desc.faceVertexCounts,
                            desc.faceVertexIndices) ||
            !faults.present(desc.holeCount, "holes", desc.holes)) {
            return;
        }
        Found small;
        Found strays;
        Found repeats;
        std::vector<uint32_t> seenIn(desc.vertexCount, kNone);
        size_t corner = 0;
        for (uint32_t f = 0; f < desc.faceCount; ++f) {
            const auto face = [&] { return cage::at("face", f); };
            corners_ += desc.faceVertexCounts[f];
            if (corners_ > cage::kMaxCorners) {
                faults.add("more than " + std::to_string(cage::kMaxCorners) + " corners", ErrorCode::limit);
                return;
            }
            if (desc.faceVertexCounts[f] < 3) {
                small.add(face);
            }
            for (uint32_t k = 0; k < desc.faceVertexCounts[f]; ++k, ++corner) {
                const uint32_t v = desc.faceVertexIndices[corner];
                if (v >= desc.vertexCount) {
                    strays.add(face);
                } else if (std::exchange(seenIn[v], f) == f) {
                    repeats.add(face);
                }
                to.faces.polygons.vertices.push_back(to.firstVertex + v);
            }
            to.faces.polygons.close();
        }
        faults.add(small, "face has fewer than three corners", "faces have fewer than three corners");
        faults.add(strays, "corner of a face names no vertex", "corners of faces name no vertex");
        faults.add(repeats, "face repeats a vertex", "faces repeat a vertex");
        Found holes;
        for (uint32_t i = 0; i < desc.holeCount; ++i) {
            if (desc.holes[i] >= desc.faceCount || (i > 0 && desc.holes[i] <= desc.holes[i - 1])) {
                holes.add([&] { return cage::at("hole", i); });
            }
            to.faces.holes.push_back(desc.holes[i]);
        }
        faults.add(holes, "hole is no face, or does not rise", "holes are no faces, or do not rise");
    }

    void readAttributes(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        const uint32_t count = desc.vertexCount;
        const auto read = [&](const float* from, size_t width, const char* one, const char* many) {
            checkNumbers(from, count, width, "vertex", one, many, faults);
            return from == nullptr ? std::vector<float>() : std::vector<float>(from, from + width * count);
        };
        to.uvs = read(desc.uvs, 2, "of uvs is not finite or beyond 1e+09", "of uvs are not finite or beyond 1e+09");
        to.uvs1 = read(desc.uvs1, 2, "of uvs1 is not finite or beyond 1e+09", "of uvs1 are not finite or beyond 1e+09");
        to.colors =
            read(desc.colors, 4, "of colors is not finite or beyond 1e+09", "of colors are not finite or beyond 1e+09");
        const std::vector<float> normals = read(desc.normals, 3, "of normals is not finite or beyond 1e+09",
                                                "of normals are not finite or beyond 1e+09");
        for (size_t i = 0; i < normals.size(); i += 3) {
            to.normals.push_back(cage::unitNormal({normals[i], normals[i + 1], normals[i + 2]}));
        }
        const std::vector<float> tangents = read(desc.tangents, 4, "of tangents is not finite or beyond 1e+09",
                                                 "of tangents are not finite or beyond 1e+09");
        for (size_t i = 0; i < tangents.size() && !normals.empty(); i += 4) {
            to.tangents.push_back(cage::unitTangent({tangents[i], tangents[i + 1], tangents[i + 2], tangents[i + 3]}));
        }
        readTiles(desc, to, faults);
    }

    void readTiles(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        if (desc.trimTiles == nullptr) {
            return;
        }
        const bool ofFaces = to.material >= 0 && context_.materials[desc.material].trim &&
                             context_.materials[desc.material].trim->domain == cage::TrimDomain::face;
        const uint32_t tiles = ofFaces ? context_.materials[desc.material].trim->tiles : cage::kMaxTrimTiles;
        Found found;
        for (uint32_t v = 0; v < desc.vertexCount; ++v) {
            if (desc.trimTiles[v] != SUPPLE_NO_TRIM_TILE && desc.trimTiles[v] >= tiles) {
                found.add([&] {
                    return "tile " + std::to_string(desc.trimTiles[v]) + " of " + std::to_string(tiles) +
                           " at vertex " + std::to_string(v);
                });
            }
            to.trimTiles.push_back(desc.trimTiles[v]);
        }
        faults.add(found, "vertex has no such trim tile", "vertices have no such trim tiles");
    }

    void readSharpness(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        const auto read = [&](uint32_t count, const uint32_t* vertices, const float* sharpnesses, uint32_t width,
                              const char* what) -> std::optional<cage::split::SharpList> {
            if (count == 0 || !faults.present(count, what, vertices, sharpnesses)) {
                return std::nullopt;
            }
            cage::split::SharpList list{faults.element() + " " + what,
                                        {vertices, vertices + size_t{width} * count},
                                        {sharpnesses, sharpnesses + count}};
            Found found;
            for (uint32_t i = 0; i < count; ++i) {
                if (!(sharpnesses[i] >= 0.0f)) {
                    found.add([&] { return cage::at("entry", i); });
                }
            }
            faults.add(found, "sharpness is not 0 and more", "sharpnesses are not 0 and more");
            return list;
        };
        to.creases = read(desc.creaseCount, desc.creaseVertices, desc.creaseSharpnesses, 2, "creases");
        to.corners = read(desc.cornerCount, desc.cornerVertices, desc.cornerSharpnesses, 1, "corners");
        if (faults.present(desc.creaseSetCount, "creaseSetNames", desc.creaseSetNames) &&
            checkCreaseSets(desc.creaseSetCount, desc.creaseSetNames, desc.creaseCount, desc.creaseSets, faults)) {
            readCreaseSets(desc, to);
        }
        if (desc.creaseScalarCount > 0 && faults.present(desc.creaseScalarCount, "creaseScalars", desc.creaseScalars)) {
            readScalars(desc, to, faults);
        }
    }

    static void readCreaseSets(const SupplePrimitiveDesc& desc, cage::split::Primitive& to) {
        for (uint32_t set = 0; set < desc.creaseSetCount; ++set) {
            to.creaseSets.push_back({desc.creaseSetNames[set], {}});
        }
        for (uint32_t crease = 0; desc.creaseSets != nullptr && crease < desc.creaseCount; ++crease) {
            if (desc.creaseSets[crease] != SUPPLE_NO_CREASE_SET) {
                to.creaseSets[desc.creaseSets[crease]].creases.push_back(crease);
            }
        }
    }

    static void readScalars(const SupplePrimitiveDesc& desc, cage::split::Primitive& to, Faults& faults) {
        cage::split::SharpList list{faults.element() + " crease scalars", {}, {}};
        Found found;
        for (uint32_t i = 0; i < desc.creaseScalarCount; ++i) {
            const SuppleCreaseScalar& scalar = desc.creaseScalars[i];
            if (!(scalar.alpha >= 0.0f && scalar.alpha <= 1.0f)) {
                found.add([&] { return "crease scalar " + std::to_string(i); });
            }
            list.vertices.insert(list.vertices.end(), {scalar.vertex, scalar.toward});
            list.sharpnesses.push_back(scalar.alpha);
        }
        faults.add(found, "crease scalar has an alpha that is not in [0, 1]",
                   "crease scalars have an alpha that is not in [0, 1]");
        to.scalars = std::move(list);
    }

    const SupplePartDesc& part_;
    const cage::MeshBinding& binding_;
    const PartContext& context_;
    cage::split::Mesh& mesh_;
    uint64_t corners_ = 0;
};

/// What a file's polygons and numbers are, are here the host's.
void nameSources(cage::Part& part) {
    if (part.polygonSource == cage::PolygonSource::cageExtension) {
        part.polygonSource = cage::PolygonSource::arrays;
    }
    if (part.weldSource == cage::WeldSource::cageExtension) {
        part.weldSource = cage::WeldSource::given;
    }
}

} // namespace

void readPrimitiveArrays(const SupplePartDesc& desc, const cage::MeshBinding& binding, const PartContext& context,
                         cage::PartCage& part, Faults& faults) {
    cage::split::Mesh mesh;
    mesh.element = faults.element();
    PrimitiveReader reader(desc, binding, context, mesh);
    const std::vector<SupplePrimitiveDesc> from = takeArray(desc.primitives, desc.primitiveCount, "primitives", faults);
    bool sound = faults.none() && from.size() == desc.primitiveCount;
    for (uint32_t p = 0; p < from.size(); ++p) {
        Faults own(faults.refusals(), faults.element() + " " + cage::at("primitive", p));
        reader.read(from[p], own);
        sound = sound && own.none();
    }
    if (!sound || !faults.refusals().none()) {
        return;
    }
    mesh.weights.report(faults.element() + " influences", *context.warnings);
    faults.refusals().gather([&] {
        cage::Leniency strict(true);
        cage::split::buildCage(mesh, context.pairing, part, strict, *context.warnings);
        strict.raise();
        if (part.cage.faceCount() == 0) {
            cage::refuse(faults.element(), "no triangle is left");
        }
    });
    nameSources(part.part);
}

} // namespace supple::runtime
