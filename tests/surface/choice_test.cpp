// Which scheme `auto` takes for each part, and why.
#include "surface/choice.h"

#include "cage/corner_normals.h"
#include "cage/gltf/reader.h"
#include "tests/support/meshes.h"
#include "tests/support/shared_assets.h"

#include <gtest/gtest.h>

namespace supple::surface {
namespace {

using cage::Character;
using cage::PolygonSource;

Character characterOf(cage::Cage cage, PolygonSource source) {
    Character character;
    character.cage = std::move(cage);
    character.parts[0].polygonSource = source;
    return character;
}

/// Every corner has the normal of its face.
cage::Cage flatShaded(cage::Cage cage) {
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const auto at = [&](uint32_t i) { return cage.positions[cage.faceVertices[cage.faceStarts[face] + i]]; };
        cage.cornerNormals.resize(cage.faceStarts[face + 1], glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0))));
    }
    return cage;
}

cage::Cage smoothShaded(cage::Cage cage) {
    cage.cornerNormals = cage::cornerNormals(cage);
    return cage;
}

/// All quads cut in two.
cage::Cage triangulated(const cage::Cage& cage) {
    return test::withCutQuads(cage, 1.0, 1);
}

void expectChoice(const Character& character, SchemeId scheme, const std::string& reason) {
    const std::vector<SchemeChoice> choices = chooseSchemes(character);
    ASSERT_EQ(choices.size(), character.parts.size());
    for (const SchemeChoice& choice : choices) {
        EXPECT_EQ(choice.scheme, scheme);
        EXPECT_EQ(choice.reason, reason);
    }
}

TEST(SchemeChoice, PolygonsAsDrawnAreSmoothedWhateverTheirNormals) {
    const std::string reason = "its polygons are known";
    for (const PolygonSource source :
         {PolygonSource::cageExtension, PolygonSource::meshPolygon, PolygonSource::ngonEncoding,
          PolygonSource::hiddenEdges, PolygonSource::obj, PolygonSource::arrays}) {
        expectChoice(characterOf(test::cube(), source), SchemeId::catmullClark, reason);
        expectChoice(characterOf(flatShaded(test::cube()), source), SchemeId::catmullClark, reason);
        expectChoice(characterOf(test::dodecahedron(), source), SchemeId::catmullClark, reason);
    }
}

TEST(SchemeChoice, TheFileSaysWhatItWasMadeFor) {
    using cage::MadeFor;
    const std::string reason = "its file says that it was made for ";
    Character drawn = characterOf(test::cube(), PolygonSource::cageExtension);
    drawn.parts[0].madeFor = MadeFor::none;
    expectChoice(drawn, SchemeId::polygons, "its file says that it is not subdivided");
    drawn.parts[0].madeFor = MadeFor::bilinear;
    expectChoice(drawn, SchemeId::polygons, reason + "bilinear");
    drawn.parts[0].madeFor = MadeFor::loop;
    expectChoice(drawn, SchemeId::loop, reason + "loop");
    Character triangles = characterOf(triangulated(test::cube()), PolygonSource::triangles);
    triangles.parts[0].madeFor = MadeFor::catmullClark;
    expectChoice(triangles, SchemeId::catmullClark, reason + "catmullClark");
}

TEST(SchemeChoice, TrianglesAreTrianglesWhoeverSaysSo) {
    for (const PolygonSource source : {PolygonSource::triangles, PolygonSource::obj, PolygonSource::cageExtension}) {
        const cage::Cage cage = triangulated(test::torus(8, 6));
        expectChoice(characterOf(cage, source), SchemeId::loop, "its triangles are smooth");
        expectChoice(characterOf(smoothShaded(cage), source), SchemeId::loop, "its triangles are smooth");
        expectChoice(characterOf(flatShaded(cage), source), SchemeId::polygons,
                     "100 % of the edges where it bends are hard");
    }
}

TEST(SchemeChoice, PairsAreQuadsUnlessTheyAreHard) {
    const cage::Cage cage = test::torus(8, 6);
    expectChoice(characterOf(smoothShaded(cage), PolygonSource::pairedTriangles), SchemeId::catmullClark,
                 "its triangles pair into quads");
    expectChoice(characterOf(flatShaded(cage), PolygonSource::pairedTriangles), SchemeId::polygons,
                 "100 % of the edges where it bends are hard");
}

TEST(SchemeChoice, EdgesWithinFlatFacesDoNotCount) {
    // 12 hard edges, and 6 within the squares.
    const cage::Cage box = flatShaded(triangulated(test::cube()));
    expectChoice(characterOf(box, PolygonSource::triangles), SchemeId::polygons,
                 "100 % of the edges where it bends are hard");
    // Nothing bends, so nothing is hard.
    const cage::Cage plane = flatShaded(triangulated(test::grid(4, 4)));
    expectChoice(characterOf(plane, PolygonSource::triangles), SchemeId::loop, "its triangles are smooth");
}

TEST(SchemeChoice, CornersWithoutNormalsAreNotHard) {
    cage::Cage cage = flatShaded(triangulated(test::torus(8, 6)));
    cage.cornerNormals.assign(cage.cornerCount(), glm::vec3(0.0f));
    expectChoice(characterOf(cage, PolygonSource::triangles), SchemeId::loop, "its triangles are smooth");
}

TEST(SchemeChoice, HalfOfTheEdgesAreEverywhere) {
    // A box whose upper and lower edges are hard: 8 of 12. Without the lower ones: 4 of 12.
    cage::Cage box = smoothShaded(triangulated(test::cube()));
    const auto flatten = [&](float side) {
        for (uint32_t face = 0; face < box.faceCount(); ++face) {
            bool flat = true;
            for (uint32_t c = box.faceStarts[face]; c < box.faceStarts[face + 1]; ++c) {
                flat = flat && box.positions[box.faceVertices[c]].z == side;
            }
            for (uint32_t c = box.faceStarts[face]; c < box.faceStarts[face + 1] && flat; ++c) {
                box.cornerNormals[c] = {0.0f, 0.0f, side};
            }
        }
    };
    flatten(1.0f);
    expectChoice(characterOf(box, PolygonSource::triangles), SchemeId::loop, "its triangles are smooth");
    flatten(-1.0f);
    expectChoice(characterOf(box, PolygonSource::triangles), SchemeId::polygons,
                 "67 % of the edges where it bends are hard");
}

TEST(SchemeChoice, MixedFacesGoWithTheLargerHalf) {
    // Of 16 quads.
    const auto withCut = [](double share) { return test::withCutQuads(test::grid(4, 4), share, 3); };
    const cage::Cage few = withCut(0.25);
    const cage::Cage many = withCut(0.75);
    ASSERT_LT(few.faceCount(), 24u);
    ASSERT_GT(many.faceCount(), 24u);
    ASSERT_LT(many.faceCount(), 32u);
    expectChoice(characterOf(few, PolygonSource::ngonEncoding), SchemeId::catmullClark, "its polygons are known");
    expectChoice(characterOf(few, PolygonSource::pairedTriangles), SchemeId::catmullClark,
                 "its triangles pair into quads");
    expectChoice(characterOf(many, PolygonSource::ngonEncoding), SchemeId::loop,
                 "most of its faces are smooth triangles");
}

/// Two parts: a torus of triangles, and a torus of quads. If they are sewn, half of the triangles are in the other
/// part.
Character twoParts(bool sewn) {
    const cage::Cage triangles = triangulated(test::torus(8, 6));
    const cage::Cage quads = test::torus(8, 6);
    Character character;
    cage::Cage& cage = character.cage;
    cage = triangles;
    cage.faceParts.assign(triangles.faceCount(), 0);
    cage.faceParts.resize(triangles.faceCount() + quads.faceCount(), 1);
    if (sewn) {
        std::fill(cage.faceParts.begin() + triangles.faceCount() / 2, cage.faceParts.end(), 1u);
    }
    for (uint32_t face = 0; face < quads.faceCount(); ++face) {
        for (uint32_t c = quads.faceStarts[face]; c < quads.faceStarts[face + 1]; ++c) {
            cage.faceVertices.push_back(triangles.vertexCount() + quads.faceVertices[c]);
        }
        cage.faceStarts.push_back(static_cast<uint32_t>(cage.faceVertices.size()));
    }
    cage.positions.insert(cage.positions.end(), quads.positions.begin(), quads.positions.end());
    character.parts.resize(2);
    character.parts[0].polygonSource = PolygonSource::triangles;
    character.parts[1].polygonSource = PolygonSource::arrays;
    return character;
}

TEST(SchemeChoice, EveryPartChooses) {
    const std::vector<SchemeChoice> choices = chooseSchemes(twoParts(false));
    ASSERT_EQ(choices.size(), 2u);
    EXPECT_EQ(choices[0].scheme, SchemeId::loop);
    EXPECT_EQ(choices[1].scheme, SchemeId::catmullClark);
}

TEST(SchemeChoice, SewnPartsChooseTogether) {
    Character character = twoParts(true);
    expectChoice(character, SchemeId::catmullClark, "most of its polygons are known");
    // One quad less, and triangles are the larger half.
    cage::Cage& cage = character.cage;
    cage.faceStarts.pop_back();
    cage.faceParts.pop_back();
    cage.faceVertices.resize(cage.faceStarts.back());
    expectChoice(character, SchemeId::loop, "most of its faces are smooth triangles");
}

TEST(SchemeChoice, NoManifoldIsDrawnAsPolygons) {
    cage::Cage cage = test::cube();
    const std::vector<uint32_t> again(cage.faceVertices.begin(), cage.faceVertices.begin() + 4);
    cage.faceVertices.insert(cage.faceVertices.end(), again.begin(), again.end());
    cage.faceStarts.push_back(cage.cornerCount());
    const std::vector<SchemeChoice> choices = chooseSchemes(characterOf(cage, PolygonSource::arrays));
    ASSERT_EQ(choices.size(), 1u);
    EXPECT_EQ(choices[0].scheme, SchemeId::polygons);
    EXPECT_TRUE(choices[0].reason.starts_with("it is no manifold: ")) << choices[0].reason;
}

TEST(SchemeChoice, CharactersModelledForSubdivisionAreSmoothed) {
    for (const std::string& path : test::allCharacters()) {
        const Result<Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character) << character.error().message;
        expectChoice(*character, SchemeId::catmullClark, "its polygons are known");
    }
}

TEST(SchemeChoice, SharedTrianglesAsTheyLook) {
    const std::vector<std::pair<std::string, SchemeId>> cases{
        {"khronos/Fox.glb", SchemeId::loop},
        {"khronos/AnimatedMorphCube/AnimatedMorphCube.gltf", SchemeId::polygons},
        {"khronos/RiggedFigure_2017_unnormalised_weights.glb", SchemeId::polygons},
        {"whole/RobotExpressive.glb", SchemeId::polygons},
        {"whole/studio_goblin.glb", SchemeId::polygons}};
    for (const auto& [name, scheme] : cases) {
        for (const std::string& path : test::sharedAssets({name})) {
            const Result<Character> character = cage::readGltfFile(path);
            ASSERT_TRUE(character) << character.error().message;
            for (const SchemeChoice& choice : chooseSchemes(*character)) {
                EXPECT_EQ(choice.scheme, scheme) << path << ": " << choice.reason;
            }
        }
    }
}

} // namespace
} // namespace supple::surface
