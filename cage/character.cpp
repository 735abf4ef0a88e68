#include "cage/character.h"

#include <algorithm>

namespace supple::cage {

uint32_t Cage::faceOf(uint32_t corner) const {
    const auto next = std::upper_bound(faceStarts.begin(), faceStarts.end(), corner);
    return static_cast<uint32_t>(next - faceStarts.begin() - 1);
}

const char* polygonSourceName(PolygonSource source) {
    switch (source) {
    case PolygonSource::cageExtension:
        return "SUPPLE_mesh_cage";
    case PolygonSource::meshPolygon:
        return "EXT_mesh_polygon";
    case PolygonSource::ngonEncoding:
        return "FB_ngon_encoding";
    case PolygonSource::hiddenEdges:
        return "EXT_mesh_primitive_edge_visibility";
    case PolygonSource::pairedTriangles:
        return "paired triangles";
    case PolygonSource::triangles:
        return "triangles";
    case PolygonSource::obj:
        return "OBJ";
    case PolygonSource::arrays:
        return "arrays";
    }
    return "unknown";
}

const char* weldSourceName(WeldSource source) {
    switch (source) {
    case WeldSource::cageExtension:
        return "SUPPLE_mesh_cage";
    case WeldSource::vertexAttribute:
        return "_CAGE_VERTEX";
    case WeldSource::meshManifold:
        return "EXT_mesh_manifold";
    case WeldSource::equality:
        return "equal position, skin and morphs";
    case WeldSource::given:
        return "as given";
    }
    return "unknown";
}

const char* uvModeName(UvMode mode) {
    constexpr const char* kNames[] = {"none", "cornersOnly", "cornersPlus1", "cornersPlus2", "boundaries", "all"};
    return kNames[static_cast<size_t>(mode)];
}

const char* skinningModeName(SkinningMode mode) {
    constexpr const char* kNames[] = {"linear", "dualQuaternion", "centersOfRotation", "deltaMush", "deltaMushLight"};
    return kNames[static_cast<size_t>(mode)];
}

const char* turnPartName(TurnPart part) {
    constexpr const char* kNames[] = {"rotation", "swing", "twist"};
    return kNames[static_cast<size_t>(part)];
}

const char* madeForName(MadeFor scheme) {
    constexpr const char* kNames[] = {"catmullClark", "loop", "bilinear", "none"};
    return kNames[static_cast<size_t>(scheme)];
}

uint32_t endFace(const Character& character, size_t part) {
    return part + 1 < character.parts.size() ? character.parts[part + 1].firstFace : character.cage.faceCount();
}

} // namespace supple::cage
