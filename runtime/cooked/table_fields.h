// The members of prepared tables in the order of a cooked file (cooked/archive.h).
#pragma once

#include "runtime/cooked/archive.h"
#include "runtime/cooked/character_fields.h"
#include "runtime/prepared.h"

namespace supple::runtime {

template <>
inline constexpr auto kLast<surface::prep::TangentMode> = surface::prep::TangentMode::printed;
template <>
inline constexpr auto kLast<surface::prep::CornerRule> = surface::prep::CornerRule::smooth;
template <>
inline constexpr auto kLast<surface::blend::CreaseMode> = surface::blend::CreaseMode::curve;
template <>
inline constexpr auto kLast<surface::Stage> = surface::Stage::deepen;
template <>
inline constexpr auto kLast<surface::PatchClass> =
    static_cast<surface::PatchClass>(std::size(surface::kPatchClasses) - 1);
template <>
inline constexpr auto kLast<surface::Domain> = static_cast<surface::Domain>(surface::kDomainCount - 1);
template <>
inline constexpr auto kLast<surface::Borders> = surface::Borders::charts;
/// It begins with 1, and one stands apart.
template <>
constexpr bool isEnumerator<surface::SchemeId>(uint32_t number) {
    using surface::SchemeId;
    return (number >= static_cast<uint32_t>(SchemeId::prep) && number <= static_cast<uint32_t>(SchemeId::fragments)) ||
           number == static_cast<uint32_t>(SchemeId::loopFragments);
}

} // namespace supple::runtime

namespace supple::surface {

using runtime::Is;

template <class A, Is<Recipe> T>
void fields(A& a, T& recipe) {
    a(recipe.scheme, recipe.prep.tangentMode, recipe.prep.cornerRule, recipe.blend.creases, recipe.blend.sharpThreshold,
      recipe.rate, recipe.attributes, recipe.tangents, recipe.mapFrames, recipe.uvMode, recipe.lod, recipe.indexedMesh,
      recipe.wide);
}
template <class A, Is<SchemeChoice> T>
void fields(A& a, T& choice) {
    a(choice.scheme, choice.reason);
}
template <class A, Is<Section> T>
void fields(A& a, T& section) {
    a(section.table, section.count);
}
/// A kernel is called by its name: its number changes with the list of kernels. What debuggers call it, the scheme
/// knows.
inline void fields(runtime::Writer& a, const KindOfKernel& kernel) {
    a(std::string(nameOf(kernel.kernel)), kernel.kind);
}
inline void fields(runtime::Reader& a, KindOfKernel& kernel) {
    std::string name;
    a(name, kernel.kind);
    uint32_t number = 0;
    while (number < static_cast<uint32_t>(Kernel::count) && name != nameOf(static_cast<Kernel>(number))) {
        ++number;
    }
    if (number == static_cast<uint32_t>(Kernel::count)) {
        a.refuse("no such kernel");
    }
    kernel.kernel = static_cast<Kernel>(number);
}
template <class A, Is<Construction> T>
void fields(A& a, T& c) {
    a(c.stage, c.kernel, c.section, c.coefficients, c.readsPool, c.from, c.to);
}
template <class A, Is<PatchRange> T>
void fields(A& a, T& range) {
    a(range.patchClass, range.section, range.firstPatch, range.attributes, range.smoothUvs);
}
template <class A, Is<DrawRange> T>
void fields(A& a, T& range) {
    a(range.domain, range.firstPatch, range.patchCount, range.part, range.material);
}
template <class A, Is<LodTables::Edges> T>
void fields(A& a, T& edges) {
    a(edges.borders, edges.first, edges.section);
}
template <class A, Is<LodTables::PatchRun> T>
void fields(A& a, T& run) {
    a(run.patchClass, run.material, run.patchCount);
}
template <class A, Is<LodTables> T>
void fields(A& a, T& lod) {
    a(lod.borders, lod.edges, lod.edgeCount, lod.patches, lod.runs, lod.depth, lod.depthLanes);
}
template <class A, Is<MeshTables::Edges> T>
void fields(A& a, T& edges) {
    a(edges.kind, edges.section);
}
template <class A, Is<MeshTables::Patch> T>
void fields(A& a, T& patch) {
    a(patch.edges, patch.corners, patch.reversed);
}
template <class A, Is<MeshTables> T>
void fields(A& a, T& mesh) {
    a(mesh.edges, mesh.attributes, mesh.tangents, mesh.edgeCount, mesh.cornerCount, mesh.patches);
}
template <class A, Is<Triangles> T>
void fields(A& a, T& triangles) {
    a(triangles.vertices, triangles.directions, triangles.indices);
}
template <class A, Is<Fragments::Class> T>
void fields(A& a, T& own) {
    a(own.sharedPoints, own.fragments, own.blocks);
}
template <class A, Is<Fragments> T>
void fields(A& a, T& fragments) {
    a(fragments.steps, fragments.loop, fragments.scratchStride, fragments.classes);
}
template <class A, Is<Tables> T>
void fields(A& a, T& tables) {
    a(tables.words, tables.cageStride, tables.poolStride, tables.meshVertices, tables.tangents, tables.faces,
      tables.inner, tables.frames, tables.ring, tables.edgeClasses, tables.coordinates, tables.uvSets, tables.uvMode,
      tables.uvLeaves, tables.faceUvs, tables.colors, tables.mapFrames, tables.attributes, tables.attributeHalves,
      tables.isolationSteps, tables.rate, tables.fragments, tables.triangles, tables.cornerNormals,
      tables.constructions, tables.ranges, tables.patches, tables.drawRanges, tables.lod, tables.mesh, tables.notes);
}

} // namespace supple::surface

namespace supple::cage {

template <class A, Is<CagePiece> T>
void fields(A& a, T& piece) {
    a(piece.cage, piece.faces, piece.vertices);
}

} // namespace supple::cage

namespace supple::runtime {

template <class A, Is<PartSummary> T>
void fields(A& a, T& part) {
    a(part.materials, part.joint, part.low, part.high);
}

// Their enumerators and truth values are checked with the tables (surface/table_check.h).
template <>
inline constexpr bool kIsPlain<surface::PatchInfo> = true;
static_assert(sizeof(surface::PatchInfo) == 40);
template <>
inline constexpr bool kIsPlain<cage::MapFrame> = true;
static_assert(sizeof(cage::MapFrame) == 16);

} // namespace supple::runtime
