// The scheme polygons on the device: against the file read a second way and skinned plainly, against its own frames in
// double, and its contract.
#include "cage/tangents.h"
#include "cage/triangulation.h"
#include "surface/polygons/frames.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/plain_gltf.h"
#include "tests/support/prep_surface.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/shared_assets.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/tangent_word.h"
#include "tests/support/test_view.h"
#include "tests/support/worst.h"
#include "tools/common/procedural.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <string>

namespace supple::test {
namespace {

GpuOptions polygonsOptions(SuppleMapping mapping = SUPPLE_MAPPING_NARROW, uint32_t flags = 0) {
    GpuOptions options;
    options.mapping = mapping;
    options.scheme = SUPPLE_SCHEME_POLYGONS;
    options.flags = flags;
    return options;
}

/// Once a frame has run: it uploads them.
std::vector<uint32_t> indicesOf(const host::GroupOutput& output) {
    const Result<std::vector<std::byte>> bytes = testDevice()->readBuffer(output.grid.indices);
    EXPECT_TRUE(bytes.ok());
    EXPECT_EQ(output.grid.indices.stride, sizeof(uint32_t));
    std::vector<uint32_t> indices(bytes->size() / sizeof(uint32_t));
    std::memcpy(indices.data(), bytes->data(), bytes->size());
    return indices;
}

/// The corners of the cage that the triangles are drawn over, in the order of the index buffer: by material, without
/// holes.
std::vector<uint32_t> drawnCorners(const cage::Cage& cage) {
    const std::vector<uint32_t> all = cage::triangulate(cage);
    std::vector<uint32_t> faces(cage.faceCount()), corners;
    std::iota(faces.begin(), faces.end(), 0u);
    std::stable_sort(faces.begin(), faces.end(), [&](uint32_t a, uint32_t b) {
        return !cage.faceMaterials.empty() && cage.faceMaterials[a] < cage.faceMaterials[b];
    });
    for (const uint32_t face : faces) {
        if (!std::binary_search(cage.holes.begin(), cage.holes.end(), face)) {
            const auto first = all.begin() + 3 * (cage.faceStarts[face] - 2 * ptrdiff_t{face});
            corners.insert(corners.end(), first, first + 3 * (cage.sides(face) - 2));
        }
    }
    return corners;
}

/// Twice the area vector.
glm::dvec3 areaOf(const cage::Cage& cage, uint32_t face, const std::vector<glm::vec3>& positions) {
    const auto at = [&](uint32_t k) { return glm::dvec3(positions[cage.faceVertices[cage.faceStarts[face] + k]]); };
    glm::dvec3 area(0.0);
    for (uint32_t k = 1; k + 1 < cage.sides(face); ++k) {
        area += glm::cross(at(k) - at(0), at(k + 1) - at(0));
    }
    return area;
}

/// What the normal of a corner is in a deformed cage, in double.
class NormalReference {
public:
    explicit NormalReference(const cage::Cage& cage) : cage_(cage), frames_(surface::polygons::makeFrames(cage)) {}

    /// Zero where float cannot tell: the faces are needles or next to nothing.
    [[nodiscard]] glm::dvec3 at(uint32_t corner, const std::vector<glm::vec3>& positions) const {
        const surface::polygons::Frame& frame = frames_.frames[frames_.cornerFrames[corner]];
        glm::dvec3 own(0.0, 0.0, 1.0);
        if (!cage_.cornerNormals.empty() && cage_.cornerNormals[corner] != glm::vec3(0.0f)) {
            own = glm::transpose(frame.axes) * glm::dvec3(cage_.cornerNormals[corner]);
        }
        if (frame.faceCount == 0) {
            return own;
        }
        glm::dvec3 area(0.0);
        double longest = 0.0;
        for (uint32_t i = frame.firstFace; i < frame.firstFace + frame.faceCount; ++i) {
            const uint32_t face = frames_.faces[i];
            area += areaOf(cage_, face, positions);
            for (uint32_t c = cage_.faceStarts[face]; c < cage_.faceStarts[face + 1]; ++c) {
                longest = std::max(longest, glm::distance(glm::dvec3(positions[cage_.faceVertices[c]]),
                                                          glm::dvec3(positions[frame.vertex])));
            }
        }
        const glm::dvec3 normal = glm::normalize(area);
        const glm::dvec3 edge = glm::dvec3(positions[frame.toward]) - glm::dvec3(positions[frame.vertex]);
        const glm::dvec3 across = edge - glm::dot(edge, normal) * normal;
        const bool known =
            glm::length(area) > 1e-4 * longest * longest && glm::length(across) > 1e-3 * glm::length(edge);
        const glm::dvec3 tangent = glm::normalize(across);
        return known ? own.x * tangent + own.y * glm::cross(normal, tangent) + own.z * normal : glm::dvec3(0.0);
    }

private:
    const cage::Cage& cage_;
    surface::polygons::Frames frames_;
};

struct Worst {
    uint64_t count = 0, unknown = 0;
    double degrees = 0.0;

    void add(const glm::dvec3& a, const glm::dvec3& b) {
        if (glm::length(b) == 0.0) {
            ++unknown;
            return;
        }
        ++count;
        raise(degrees, angleDegrees(a, b));
    }
};

Worst compareNormals(const GpuSurface& gpu, const cage::Cage& cage, uint32_t instance = 0) {
    const std::vector<glm::vec3> positions = gpu.deformedCage(instance);
    const NormalReference reference(cage);
    const std::vector<uint32_t> corners = drawnCorners(cage), indices = indicesOf(gpu.output());
    EXPECT_EQ(corners.size(), indices.size());
    Worst worst;
    ComparedBits bits;
    for (size_t i = 0; i < std::min(corners.size(), indices.size()); ++i) {
        const GpuSurface::Vertex& vertex = gpu.sharedVertex(instance, indices[i]);
        bits.compare(vertex.position, positions[cage.faceVertices[corners[i]]]);
        worst.add(vertex.normal, reference.at(corners[i], positions));
    }
    EXPECT_GT(bits.samples, 0u);
    EXPECT_EQ(bits.different, 0u) << "positions are the deformed cage's";
    return worst;
}

// ------------------------------------------------------------------------------------------------- characters

/// Three positions as bits, the smallest first.
using TriangleKey = std::array<std::array<float, 3>, 3>;
TriangleKey keyOf(const std::array<glm::vec3, 3>& corners, uint32_t& first) {
    const auto bits = [](const glm::vec3& p) { return std::array<float, 3>{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; };
    const auto from = [&](uint32_t k) {
        return TriangleKey{bits(corners[k]), bits(corners[(k + 1) % 3]), bits(corners[(k + 2) % 3])};
    };
    first = 0; // the least of the three: two corners may be in one place
    for (uint32_t k = 1; k < 3; ++k) {
        first = from(k) < from(first) ? k : first;
    }
    return from(first);
}

/// What the file has where triangles are drawn.
struct DrawnOfFile {
    std::vector<uint32_t> vertices; ///< per index of the index buffer
    std::vector<uint8_t> isKnown;   ///< per triangle drawn: the file has it
    size_t lost = 0; ///< triangles of the file that are not drawn, but for those with two corners in one place

    [[nodiscard]] size_t unknown() const {
        return static_cast<size_t>(std::count(isKnown.begin(), isKnown.end(), uint8_t{0}));
    }
};

using Place = std::array<float, 3>;
Place placeOf(const glm::vec3& p) {
    return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
}

/// Triangles that the file has not get its vertices at their corners.
DrawnOfFile drawnOfFile(const GpuSurface& gpu, const cage::Cage& cage, const PlainMesh& plain) {
    std::multimap<TriangleKey, std::array<uint32_t, 3>> known;
    std::map<Place, uint32_t> places;
    for (const std::array<uint32_t, 3>& triangle : plain.triangles) {
        std::array<glm::vec3, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = plain.vertices[triangle[k]].position;
            places[placeOf(corners[k])] = triangle[k];
        }
        uint32_t first = 0;
        const TriangleKey key = keyOf(corners, first);
        known.insert({key, {triangle[first], triangle[(first + 1) % 3], triangle[(first + 2) % 3]}});
    }
    DrawnOfFile drawn;
    for (const SupplePatchInfo& patch : gpu.patches()) {
        EXPECT_EQ(patch.patchClass, SUPPLE_PATCH_TRIANGLE);
        EXPECT_EQ(patch.cornerCount, 3u);
        std::array<glm::vec3, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = cage.positions[patch.corners[k]];
        }
        uint32_t first = 0;
        const auto found = known.find(keyOf(corners, first));
        drawn.isKnown.push_back(found != known.end() ? 1 : 0);
        for (uint32_t k = 0; k < 3; ++k) {
            if (found != known.end()) {
                drawn.vertices.push_back(found->second[(k + 3 - first) % 3]);
            } else if (const auto place = places.find(placeOf(corners[k])); place != places.end()) {
                drawn.vertices.push_back(place->second);
            }
        }
        if (found != known.end()) {
            known.erase(found);
        }
    }
    for (const auto& [key, triangle] : known) {
        drawn.lost += key[0] == key[1] || key[1] == key[2] || key[2] == key[0] ? 0 : 1;
    }
    return drawn;
}

/// Every triangle of the file is drawn once. But repair takes inner vertices away that two faces have, and with each
/// two triangles, or cuts one of the faces; what is left of those faces is cut anew.
void expectFileTriangles(const DrawnOfFile& drawn, const cage::Character& character) {
    size_t dissolved = 0;
    bool cut = false;
    for (const cage::Damage& damage : character.damages) {
        if (damage.repair == "dissolved") {
            dissolved += std::stoul(damage.found.substr(damage.found.find(": ") + 2)); // "mesh 0: 4 inner vertices .."
        }
        cut = cut || damage.repair == "kept, and a face cut by an edge to it";
    }
    EXPECT_EQ(drawn.lost, drawn.unknown() + 2 * dissolved);
    EXPECT_TRUE(dissolved > 0 || cut || drawn.unknown() == 0) << drawn.unknown() << " triangles that the file has not";
}

/// At the bind pose: the file's normals, or the triangles' own.
double compareBindNormals(const GpuSurface& gpu, const PlainMesh& plain, const DrawnOfFile& drawn,
                          const std::vector<uint32_t>& indices) {
    const std::vector<uint32_t>& files = drawn.vertices;
    double worst = 0.0;
    for (size_t i = 0; i < indices.size(); ++i) {
        if (drawn.isKnown[i / 3] == 0) {
            continue;
        }
        const GpuSurface::Vertex& vertex = gpu.sharedVertex(0, indices[i]);
        glm::dvec3 wanted = plain.vertices[files[i]].normal;
        const auto at = [&](size_t k) { return plain.vertices[files[i / 3 * 3 + k]].position; };
        const double longest =
            std::max({glm::length(at(1) - at(0)), glm::length(at(2) - at(1)), glm::length(at(0) - at(2))});
        if (glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) <= 1e-4 * longest * longest) {
            continue; // a needle, in which float knows no side
        }
        if (glm::length(wanted) == 0.0) {
            const glm::dvec3 area = glm::cross(at(1) - at(0), at(2) - at(0));
            if (glm::length(area) < 1e-6 * glm::length(at(1) - at(0)) * glm::length(at(2) - at(0))) {
                continue;
            }
            wanted = area;
        }
        raise(worst, angleDegrees(vertex.normal, glm::normalize(wanted)));
    }
    return worst;
}

struct PoseErrors {
    double position = 0.0;              ///< of the extent
    Worst reference;                    ///< against the frames in double
    std::vector<double> skinnedDegrees; ///< against plainly skinned normals
};

void comparePose(GpuSurface& gpu, const cage::Character& character, const PlainMesh& plain, const DrawnOfFile& drawn,
                 uint32_t clip, double time, PoseErrors& errors) {
    ASSERT_EQ(suppleSetClipPose(gpu.context().handle(), gpu.instance(0), clip, time), SUPPLE_OK);
    gpu.evaluate();
    const std::vector<uint32_t> indices = indicesOf(gpu.output());
    skinning::Pose pose;
    skinning::restPose(character, pose);
    skinning::sampleClip(character, character.clips[clip], time, pose);
    std::vector<glm::mat4> nodes(character.skeleton.nodes.size());
    std::vector<skinning::Affine> palette(character.skin.joints.size());
    skinning::posePalette(character, pose, nodes, palette);
    std::vector<PlainMesh::Posed> posed;
    std::vector<glm::dvec3> positions;
    for (uint32_t v = 0; v < plain.vertices.size(); ++v) {
        posed.push_back(plain.pose(v, pose.morphWeights, palette));
        positions.push_back(posed.back().position);
    }
    const double size = extent(positions);
    for (size_t i = 0; i < indices.size(); ++i) {
        const GpuSurface::Vertex& vertex = gpu.sharedVertex(0, indices[i]);
        const PlainMesh::Posed& wanted = posed[drawn.vertices[i]];
        raise(errors.position, glm::length(glm::dvec3(vertex.position) - wanted.position) / size);
        if (glm::length(wanted.normal) > 0.0 && drawn.isKnown[i / 3] != 0) {
            errors.skinnedDegrees.push_back(angleDegrees(vertex.normal, wanted.normal));
        }
    }
    const Worst reference = compareNormals(gpu, character.cage);
    errors.reference.count += reference.count;
    errors.reference.unknown += reference.unknown;
    raise(errors.reference.degrees, reference.degrees);
}

std::vector<std::string> characterFiles() {
    std::vector<std::string> paths = allCharacters();
    for (const char* folder : {"whole", "khronos"}) {
        const std::vector<std::string> more = filesBelow(sharedFolder() + folder, {".glb"});
        paths.insert(paths.end(), more.begin(), more.end());
    }
    return paths;
}

void compareCharacter(const std::string& path, const cage::Character& character, const PlainMesh& plain) {
    GpuSurface gpu(*testDevice(), path, polygonsOptions());
    ASSERT_TRUE(gpu.valid());
    EXPECT_EQ(gpu.output().surface.tessellation, SUPPLE_TESSELLATION_INDEXED_MESH);
    gpu.evaluate();
    const DrawnOfFile drawn = drawnOfFile(gpu, character.cage, plain);
    const std::vector<uint32_t> indices = indicesOf(gpu.output());
    ASSERT_EQ(drawn.vertices.size(), indices.size());
    expectFileTriangles(drawn, character);
    const double bind = compareBindNormals(gpu, plain, drawn, indices);
    EXPECT_LE(bind, 0.05);
    PoseErrors errors;
    for (uint32_t clip = 0; clip < std::min<size_t>(character.clips.size(), 3); ++clip) {
        for (const double part : {0.21, 0.5, 0.83}) {
            comparePose(gpu, character, plain, drawn, clip, part * character.clips[clip].duration, errors);
        }
    }
    EXPECT_LE(errors.position, 1e-5);
    EXPECT_LE(errors.reference.degrees, 0.01);
    EXPECT_LE(errors.reference.unknown, errors.reference.count / 100);
    std::sort(errors.skinnedDegrees.begin(), errors.skinnedDegrees.end());
    const auto quantile = [&](double q) {
        const std::vector<double>& all = errors.skinnedDegrees;
        return all.empty() ? 0.0 : all[static_cast<size_t>(q * static_cast<double>(all.size() - 1))];
    };
    std::printf("%s: %zu triangles, %zu of them not the file's; bind %.4f deg; posed: positions %.1e, frames %.4f deg "
                "(%llu unknown of %llu), "
                "skinned normals median %.2f, 95%% %.2f deg\n",
                path.substr(path.find_last_of('/') + 1).c_str(), indices.size() / 3, drawn.unknown(), bind,
                errors.position, errors.reference.degrees, static_cast<unsigned long long>(errors.reference.unknown),
                static_cast<unsigned long long>(errors.reference.count), quantile(0.5), quantile(0.95));
    EXPECT_LE(quantile(0.5), 3.0) << "beside plainly skinned normals";
}

TEST(Polygons, CharactersArePlainlySkinned) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    for (const std::string& path : characterFiles()) {
        SCOPED_TRACE(path);
        const Result<cage::Character> character = cage::readGltfFile(path);
        const std::optional<PlainMesh> plain = character ? readPlainMesh(path, *character) : std::optional<PlainMesh>();
        if (!plain) {
            std::printf("left out: %s: %s\n", path.c_str(),
                        character ? "accessors that are not plain" : character.error().message.c_str());
            continue;
        }
        ASSERT_NO_FATAL_FAILURE(compareCharacter(path, *character, *plain));
    }
}

TEST(Polygons, MappingsAndFormatsAgree) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    for (const char* name : {"pip.glb", "pip_quads.glb", "helmet.glb"}) {
        SCOPED_TRACE(name);
        const std::string path = std::string(SUPPLE_SAMPLE_ASSETS) + "/" + name;
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok());
        GpuOptions options = polygonsOptions();
        GpuSurface narrow(*testDevice(), path, options);
        options.mapping = SUPPLE_MAPPING_WIDE;
        GpuSurface wide(*testDevice(), path, options);
        options.format = SUPPLE_VERTEX_16;
        GpuSurface packed(*testDevice(), path, options);
        ASSERT_TRUE(narrow.valid() && wide.valid() && packed.valid());
        for (GpuSurface* gpu : {&narrow, &wide, &packed}) {
            evaluateInAPose(*gpu, *character);
        }
        EXPECT_TRUE(indicesOf(narrow.output()) == indicesOf(wide.output()));
        ComparedBits bits;
        double worst = 0.0;
        for (uint32_t v = 0; v < narrow.output().grid.vertexCount; ++v) {
            const GpuSurface::Vertex &a = narrow.sharedVertex(0, v), &b = wide.sharedVertex(0, v);
            bits.compare(a.position, b.position);
            bits.compare(a.normal, b.normal);
            bits.compare(a.position, packed.sharedVertex(0, v).position);
            raise(worst, angleDegrees(a.normal, packed.sharedVertex(0, v).normal));
        }
        EXPECT_GT(bits.samples, 0u);
        EXPECT_EQ(bits.different, 0u);
        EXPECT_LE(worst, 0.005);
    }
}

// ------------------------------------------------------------------------------------------------- hard edges

cage::Cage withCreases(cage::Cage cage, float sharpness) {
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        for (uint32_t c = cage.faceStarts[face]; c < cage.faceStarts[face + 1]; ++c) {
            const uint32_t a = cage.faceVertices[c], b = cage.faceVertices[cage::nextCorner(cage, face, c)];
            if (a < b) {
                cage.creases.push_back({a, b, sharpness});
            }
        }
    }
    return cage;
}

TEST(Polygons, CreasesOfInfiniteSharpnessCutNormals) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        for (const auto& [sharpness, vertices] : {std::pair(0.0f, 8u), {3.0f, 8u}, {10.0f, 24u}}) {
            const cage::Cage cage = withCreases(cube(), sharpness);
            GpuSurface gpu(*testDevice(), cage, polygonsOptions(mapping));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            ASSERT_EQ(gpu.output().grid.vertexCount, vertices);
            EXPECT_EQ(gpu.output().surface.patchCount, 12u);
            for (uint32_t v = 0; v < vertices; ++v) {
                const GpuSurface::Vertex& vertex = gpu.sharedVertex(0, v);
                const glm::vec3 along = glm::abs(vertex.normal);
                if (vertices == 24) {
                    EXPECT_EQ(std::max({along.x, along.y, along.z}), 1.0f);
                    EXPECT_EQ(along.x + along.y + along.z, 1.0f);
                    EXPECT_GT(glm::dot(vertex.normal, vertex.position), 0.0f);
                } else {
                    EXPECT_LE(angleDegrees(vertex.normal, glm::normalize(glm::dvec3(vertex.position))), 1e-3);
                }
            }
            EXPECT_LE(compareNormals(gpu, cage).degrees, 0.001);
        }
    }
}

/// A cage that the host writes, as a cloth solver does: what its normals are. The character goes through a file.
struct WrittenCage {
    WrittenCage(CrowdContext& context, const cage::Character& character)
        : glb(cage::writeGlb(character)), cage(cage::readGltf(glb->bytes, "written.glb", "")->cage),
          crowd(context, [&] {
              SuppleGroupDesc desc{};
              desc.asset = context.createAsset(glb->bytes, "written");
              desc.capacity = 1;
              desc.scheme = SUPPLE_SCHEME_POLYGONS;
              desc.vertexFormat = SUPPLE_VERTEX_24;
              desc.poseSource = SUPPLE_POSES_CAGE_BUFFER;
              return desc;
          }()) {
        if (crowd.valid()) {
            static_cast<void>(crowd.spawn());
        }
    }

    void write(const std::vector<glm::vec3>& positions) {
        std::vector<glm::vec4> cage;
        for (const glm::vec3& p : positions) {
            cage.emplace_back(p, 1.0f);
        }
        const SuppleBufferRange to = crowd.output().info.deformedCage;
        const Result<host::Buffer> staging = crowd.context().device().uploadBuffer(
            cage.data(), cage.size() * sizeof(cage[0]), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
        ASSERT_TRUE(staging.ok());
        crowd.run([&](VkCommandBuffer commands) {
            const VkBufferCopy region{0, to.offset, cage.size() * sizeof(cage[0])};
            vkCmdCopyBuffer(commands, staging->handle(), to.buffer, 1, &region);
        });
    }
    /// By index of the index buffer.
    [[nodiscard]] std::vector<GpuSurface::Vertex> corners() const {
        const host::GroupOutput output = crowd.output();
        const std::vector<std::byte> bytes = crowd.read(output.streams.vertices);
        std::vector<GpuSurface::Vertex> result;
        for (const uint32_t index : indicesOf(output)) {
            std::memcpy(&result.emplace_back(), bytes.data() + size_t{index} * 24, 24);
        }
        return result;
    }

    Result<cage::GlbFile> glb;
    cage::Cage cage; ///< as it is read
    Crowd crowd;
};

using WrittenCages = CrowdContexts;

cage::Character characterOf(cage::Cage cage) {
    cage::Character character = riggedTube({.segments = 1, .sides = 3, .joints = 1});
    character.cage = std::move(cage);
    character.weights = {};
    character.weights.starts.push_back(0);
    for (uint32_t v = 0; v < character.cage.vertexCount(); ++v) {
        character.cage.sourceVertices.push_back(v);
        character.weights.influences.push_back({0, 1.0f});
        character.weights.starts.push_back(v + 1);
    }
    character.cage.sourceVertices.resize(character.cage.vertexCount());
    return character;
}

/// The cube with the normals of its faces.
cage::Cage cubeWithNormals() {
    cage::Cage cage = cube();
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const glm::dvec3 normal = glm::normalize(areaOf(cage, face, cage.positions));
        cage.cornerNormals.insert(cage.cornerNormals.end(), 4, glm::vec3(normal));
    }
    return cage;
}

TEST_F(WrittenCages, HardEdgesStayAndFlatFacesStayFlat) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        WrittenCage cloth(context(mapping), characterOf(cubeWithNormals()));
        ASSERT_TRUE(cloth.crowd.valid());
        EXPECT_EQ(cloth.crowd.output().grid.vertexCount, 24u);
        const glm::mat4 shear =
            glm::rotate(glm::mat4(1.0f), 0.7f, glm::normalize(glm::vec3(1.0f, 2.0f, -1.0f))) *
            glm::mat4(1.3f, 0.2f, 0.0f, 0.0f, 0.1f, 0.8f, 0.3f, 0.0f, 0.0f, -0.2f, 1.1f, 0.0f, 3.0f, 0.0f, 1.0f, 1.0f);
        std::vector<glm::vec3> positions;
        for (const glm::vec3& p : cube().positions) {
            positions.emplace_back(shear * glm::vec4(p, 1.0f));
        }
        cloth.write(positions);
        const std::vector<GpuSurface::Vertex> corners = cloth.corners();
        ASSERT_EQ(corners.size(), 36u);
        for (size_t t = 0; t < corners.size(); t += 3) {
            const glm::dvec3 a = corners[t].position, b = corners[t + 1].position, c = corners[t + 2].position;
            const glm::dvec3 own = glm::normalize(glm::cross(b - a, c - a));
            for (size_t k = 0; k < 3; ++k) {
                EXPECT_LE(angleDegrees(corners[t + k].normal, own), 0.001) << "triangle " << t / 3;
            }
        }
    }
}

/// A sheet with normals that are not its own, and a wave in it.
TEST_F(WrittenCages, AuthoredNormalsTurnWithTheCloth) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        cage::Cage made = grid(9, 7);
        for (uint32_t c = 0; c < made.cornerCount(); ++c) {
            const glm::vec3 p = made.positions[made.faceVertices[c]];
            made.cornerNormals.push_back(
                glm::normalize(glm::vec3(0.3f * std::sin(p.x), 0.3f * std::cos(1.7f * p.y), 1.0f)));
        }
        WrittenCage cloth(context(mapping), characterOf(made));
        ASSERT_TRUE(cloth.crowd.valid());
        const cage::Cage& sheet = cloth.cage;
        ASSERT_EQ(sheet.cornerNormals, made.cornerNormals) << "the file has them";
        EXPECT_EQ(cloth.crowd.output().grid.vertexCount, sheet.vertexCount()) << "one normal per vertex";
        cloth.write(sheet.positions);
        const std::vector<uint32_t> drawn = drawnCorners(sheet);
        std::vector<GpuSurface::Vertex> corners = cloth.corners();
        ASSERT_EQ(corners.size(), drawn.size());
        for (size_t i = 0; i < drawn.size(); ++i) {
            EXPECT_LE(angleDegrees(corners[i].normal, sheet.cornerNormals[drawn[i]]), 0.001);
        }
        // Turned as a whole, they turn along.
        const glm::mat3 turn(glm::rotate(glm::mat4(1.0f), 2.1f, glm::normalize(glm::vec3(-1.0f, 0.4f, 0.8f))));
        std::vector<glm::vec3> positions;
        for (const glm::vec3& p : sheet.positions) {
            positions.push_back(turn * p + glm::vec3(5.0f, 0.0f, 2.0f));
        }
        cloth.write(positions);
        corners = cloth.corners();
        for (size_t i = 0; i < drawn.size(); ++i) {
            EXPECT_LE(angleDegrees(corners[i].normal, turn * sheet.cornerNormals[drawn[i]]), 0.01);
        }
        // Bent, they are as the frames say.
        Noise noise(3);
        for (glm::vec3& p : positions) {
            p += 0.4f * noise.vector();
        }
        cloth.write(positions);
        corners = cloth.corners();
        const NormalReference reference(sheet);
        for (size_t i = 0; i < drawn.size(); ++i) {
            EXPECT_EQ(std::memcmp(&corners[i].position, &positions[sheet.faceVertices[drawn[i]]], 12), 0);
            EXPECT_LE(angleDegrees(corners[i].normal, reference.at(drawn[i], positions)), 0.01);
        }
        // A cage that has fallen into one point has no normals, and no NaN.
        cloth.write(std::vector<glm::vec3>(positions.size(), glm::vec3(1.0f, 2.0f, 3.0f)));
        for (const GpuSurface::Vertex& corner : cloth.corners()) {
            EXPECT_TRUE(corner.normal == glm::vec3(0.0f));
        }
    }
}

TEST(Polygons, MorphsMoveNormals) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    const cage::Character tube = riggedTube({.segments = 9, .sides = 7, .joints = 2, .morphTargets = 4});
    const Result<cage::GlbFile> glb = cage::writeGlb(tube);
    ASSERT_TRUE(glb.ok());
    const Result<cage::Character> character = cage::readGltf(glb->bytes, "tube.glb", "");
    ASSERT_TRUE(character.ok());
    ASSERT_FALSE(character->cage.cornerNormals.empty()) << "the writer writes NORMAL";
    CrowdContext context(*testDevice());
    ASSERT_TRUE(context.valid());
    SuppleGroupDesc desc{};
    desc.asset = context.createAsset(glb->bytes, "tube");
    desc.capacity = 2;
    desc.scheme = SUPPLE_SCHEME_POLYGONS;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    Crowd crowd(context, desc);
    ASSERT_TRUE(crowd.valid());
    const SuppleInstance plain = crowd.spawn(), morphed = crowd.spawn();
    const float weights[] = {0.8f, 1.0f, 0.0f, 0.7f};
    ASSERT_EQ(suppleSetMorphWeights(context.handle(), morphed, weights, 4), SUPPLE_OK);
    static_cast<void>(plain);
    crowd.run();
    const host::GroupOutput output = crowd.output();
    const std::vector<uint32_t> indices = indicesOf(output), drawn = drawnCorners(character->cage);
    ASSERT_EQ(indices.size(), drawn.size());
    const NormalReference reference(character->cage);
    std::vector<glm::vec3> normals[2];
    for (uint32_t slot = 0; slot < 2; ++slot) {
        const std::vector<std::byte> cages = crowd.slotBytes(output.info.deformedCage, slot);
        std::vector<glm::vec3> positions(output.info.cageVertexCount);
        for (size_t v = 0; v < positions.size(); ++v) {
            std::memcpy(&positions[v], cages.data() + 16 * v, 12);
        }
        const std::vector<std::byte> bytes = crowd.slotBytes(output.streams.vertices, slot);
        for (size_t i = 0; i < indices.size(); ++i) {
            std::memcpy(&normals[slot].emplace_back(), bytes.data() + size_t{indices[i]} * 24 + 12, 12);
            EXPECT_LE(angleDegrees(normals[slot][i], reference.at(drawn[i], positions)), 0.01);
            if (slot == 0) {
                EXPECT_LE(angleDegrees(normals[0][i], character->cage.cornerNormals[drawn[i]]), 0.05);
            }
        }
    }
    size_t moved = 0;
    for (size_t i = 0; i < indices.size(); ++i) {
        moved += angleDegrees(normals[0][i], normals[1][i]) > 1.0 ? 1 : 0;
    }
    EXPECT_GT(moved, indices.size() / 10);
}

// ------------------------------------------------------------------------------------------------- tangents

/// A tube with texture coordinates of both hands, and, if `authored`, tangents that nothing else would give.
cage::Character wornTube(bool authored) {
    cage::Character tube = riggedTube({.segments = 6, .sides = 7, .joints = 2, .morphTargets = 1});
    cage::Cage& cage = tube.cage;
    Noise noise(3);
    cage.cornerUvs.clear();
    for (uint32_t corner = 0; corner < cage.cornerCount(); ++corner) {
        const glm::vec3 p = cage.positions[cage.faceVertices[corner]];
        cage.cornerUvs.emplace_back(std::abs(p.x) + 0.2f * p.z, p.y + 0.1f * p.x);
        if (authored) {
            cage.cornerTangents.emplace_back(glm::normalize(noise.vector()), corner % 3 == 0 ? -1.0f : 1.0f);
        }
    }
    return tube;
}

struct TangentErrors {
    double degrees = 0.0, fromPlane = 0.0;
    uint32_t signs = 0, negative = 0, samples = 0;
};

/// `turn`: how the instance is turned. `wanted`: of the corners that are drawn.
TangentErrors compareTangents(const Crowd& crowd, const std::vector<glm::vec4>& wanted, const glm::dmat3& turn) {
    const host::GroupOutput output = crowd.output();
    const std::vector<uint32_t> indices = indicesOf(output), words = as<uint32_t>(crowd.read(output.streams.tangents));
    const std::vector<float> vertices = as<float>(crowd.read(output.streams.vertices));
    EXPECT_EQ(indices.size(), wanted.size());
    TangentErrors errors;
    for (size_t i = 0; i < std::min(indices.size(), wanted.size()); ++i) {
        const float* v = &vertices[6 * size_t{indices[i]}];
        const glm::dvec3 normal = glm::normalize(glm::dvec3(v[3], v[4], v[5])), t = turn * glm::dvec3(wanted[i]);
        const glm::dvec4 tangent = decodeTangent(words[indices[i]]);
        const glm::dvec3 across = t - glm::dot(t, normal) * normal;
        ++errors.samples;
        raise(errors.fromPlane, std::abs(90.0 - angleDegrees(glm::dvec3(tangent), normal)));
        errors.signs += tangent.w != wanted[i].w ? 1 : 0;
        errors.negative += tangent.w < 0.0 ? 1 : 0;
        if (glm::length(across) > 0.05) { // what is left of it on the surface is a direction
            raise(errors.degrees, angleDegrees(glm::dvec3(tangent), glm::normalize(across)));
        }
    }
    return errors;
}

TEST(Polygons, HaveTheFilesTangentsOrThoseOfMikktspace) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    for (const bool authored : {false, true}) {
        const Result<cage::GlbFile> glb = cage::writeGlb(wornTube(authored));
        ASSERT_TRUE(glb.ok());
        EXPECT_TRUE(glb->warnings.empty());
        const Result<cage::Character> character = cage::readGltf(glb->bytes, "tube.glb", "");
        ASSERT_TRUE(character.ok());
        const cage::Cage& cage = character->cage;
        ASSERT_EQ(cage.cornerTangents.empty(), !authored) << "TANGENT comes back";
        const std::vector<glm::vec4> wanted =
            cage::triangleTangents(cage, drawnCorners(cage), cage.cornerNormals, cage.cornerUvs);
        for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
            SCOPED_TRACE(std::string(mappingName(mapping)) + (authored ? ", of the file" : ", of MikkTSpace"));
            CrowdContext context(*testDevice(), mapping);
            ASSERT_TRUE(context.valid());
            SuppleGroupDesc desc{};
            desc.asset = context.createAsset(glb->bytes, "tube");
            desc.capacity = 1;
            desc.scheme = SUPPLE_SCHEME_POLYGONS;
            desc.vertexFormat = SUPPLE_VERTEX_24;
            desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS | SUPPLE_GROUP_MOTION;
            Crowd crowd(context, desc);
            ASSERT_TRUE(crowd.valid());
            const SuppleInstance instance = crowd.spawn();
            for (const float angle : {0.0f, 1.1f}) {
                const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), angle, glm::normalize(glm::vec3(1, 2, 3)));
                crowd.pose(instance, SUPPLE_BIND_POSE, 0.0, turn);
                crowd.run();
                const TangentErrors errors = compareTangents(crowd, wanted, glm::dmat3(glm::mat3(turn)));
                std::printf("tangents of %s: %u samples, up to %.4f degrees, out of the plane by %.4f, %u negative\n",
                            authored ? "the file" : "MikkTSpace", errors.samples, errors.degrees, errors.fromPlane,
                            errors.negative);
                EXPECT_LE(errors.degrees, 0.02);
                EXPECT_LE(errors.fromPlane, 0.02);
                EXPECT_EQ(errors.signs, 0u);
                EXPECT_GT(errors.negative, errors.samples / 5);
                EXPECT_LT(errors.negative, errors.samples * 4 / 5);
            }
        }
    }
}

// ------------------------------------------------------------------------------------------------- any cage

TEST(Polygons, ConcaveFacesAreCutInside) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    // An L, a star, and a spiral of many sides.
    std::vector<std::vector<glm::vec3>> outlines = {
        {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, {}, {}};
    for (int k = 0; k < 10; ++k) {
        const float angle = 0.6283185f * static_cast<float>(k), radius = k % 2 == 0 ? 2.0f : 0.7f;
        outlines[1].emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0f);
    }
    for (int k = 0; k <= 40; ++k) {
        const float angle = 0.25f * static_cast<float>(k);
        outlines[2].emplace_back((1.0f + angle) * std::cos(angle), (1.0f + angle) * std::sin(angle), 0.0f);
    }
    for (int k = 40; k >= 0; --k) {
        const float angle = 0.25f * static_cast<float>(k);
        outlines[2].emplace_back((0.5f + angle) * std::cos(angle), (0.5f + angle) * std::sin(angle), 0.0f);
    }
    std::reverse(outlines[2].begin(), outlines[2].end());
    for (const std::vector<glm::vec3>& outline : outlines) {
        std::vector<uint32_t> face(outline.size());
        std::iota(face.begin(), face.end(), 0u);
        const cage::Cage cage = makeCage(outline, {face});
        GpuSurface gpu(*testDevice(), cage, polygonsOptions());
        ASSERT_TRUE(gpu.valid());
        gpu.evaluate();
        const glm::dvec3 whole = areaOf(cage, 0, cage.positions);
        const std::vector<uint32_t> indices = indicesOf(gpu.output());
        EXPECT_EQ(indices.size(), 3 * (outline.size() - 2));
        double sum = 0.0;
        for (size_t t = 0; t < indices.size(); t += 3) {
            const auto at = [&](size_t k) { return glm::dvec3(gpu.sharedVertex(0, indices[t + k]).position); };
            const double area = glm::cross(at(1) - at(0), at(2) - at(0)).z * (whole.z > 0.0 ? 1.0 : -1.0);
            EXPECT_GE(area, 0.0) << "triangle " << t / 3 << " of " << outline.size() << " sides lies outside";
            sum += area;
        }
        EXPECT_NEAR(sum, std::abs(whole.z), 1e-5 * std::abs(whole.z));
        for (uint32_t v = 0; v < gpu.output().grid.vertexCount; ++v) {
            EXPECT_LE(angleDegrees(gpu.sharedVertex(0, v).normal, glm::normalize(whole)), 1e-3);
        }
    }
}

TEST(Polygons, TakesWhatIsNoManifold) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    // Three faces round one edge, two of them one way; a face that repeats a vertex; one of no area; a bow tie.
    const cage::Cage cages[] = {
        makeCage({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}),
        makeCage({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 0}, {0, 2, 3}}),
        makeCage({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}),
        makeCage({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}),
    };
    for (const cage::Cage& cage : cages) {
        EXPECT_FALSE(cage::buildTopology(cage).ok() && &cage < cages + 2);
        for (const SuppleMapping mapping : kMappings) {
            GpuSurface gpu(*testDevice(), cage, polygonsOptions(mapping, SUPPLE_GROUP_ATTRIBUTES));
            ASSERT_TRUE(gpu.valid());
            gpu.evaluate();
            // The repair leaves the repeated vertex out.
            EXPECT_EQ(gpu.output().surface.patchCount, &cage == cages ? 3u : 2u);
            for (uint32_t v = 0; v < gpu.output().grid.vertexCount; ++v) {
                const glm::vec3 normal = gpu.sharedVertex(0, v).normal;
                EXPECT_TRUE(normal == normal) << "NaN";
                EXPECT_NEAR(glm::length(normal), 1.0f, 1e-5f);
            }
        }
    }
}

TEST(Polygons, HolesMaterialsAndSeams) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    cage::Cage cage = perturbed(cage::makeCubeSphere(3), 0.02f, 4);
    cage.holes = {3, 17};
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) { // every face has its own corner of the texture
        cage.cornerUvs.emplace_back(static_cast<float>(c / 4) / 64.0f, static_cast<float>(c % 4) / 4.0f);
    }
    for (const SuppleMapping mapping : kMappings) {
        GpuSurface plain(*testDevice(), cage, polygonsOptions(mapping));
        GpuSurface seams(*testDevice(), cage, polygonsOptions(mapping, SUPPLE_GROUP_ATTRIBUTES));
        ASSERT_TRUE(plain.valid() && seams.valid());
        plain.evaluate();
        seams.evaluate();
        EXPECT_EQ(plain.output().grid.vertexCount, cage.vertexCount());
        EXPECT_EQ(seams.output().grid.vertexCount, 4 * (cage.faceCount() - 2));
        EXPECT_EQ(seams.output().surface.patchCount, 2 * (cage.faceCount() - 2));
        for (const SupplePatchInfo& patch : seams.patches()) {
            EXPECT_TRUE(patch.face != 3 && patch.face != 17) << "a hole is drawn";
        }
        EXPECT_LE(compareNormals(plain, cage).degrees, 0.01);
        EXPECT_LE(compareNormals(seams, cage).degrees, 0.01);
        const std::vector<uint32_t> indices = indicesOf(seams.output()), drawn = drawnCorners(cage);
        const SuppleBufferRange& view = seams.output().streams.attributes;
        const Result<std::vector<std::byte>> attributes = testDevice()->readBuffer(view);
        ASSERT_TRUE(attributes.ok());
        ASSERT_EQ(indices.size(), drawn.size());
        for (size_t i = 0; i < indices.size(); ++i) {
            glm::vec2 uv;
            std::memcpy(&uv, attributes->data() + size_t{indices[i]} * view.stride, sizeof(uv));
            EXPECT_TRUE(uv == cage.cornerUvs[drawn[i]]);
        }
    }
}

TEST(Polygons, RefusesWhatItHasNot) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    CrowdContext context(*testDevice());
    ASSERT_TRUE(context.valid());
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.asset = context.createAsset(cube());
    desc.capacity = 1;
    desc.scheme = SUPPLE_SCHEME_POLYGONS;
    desc.flags = SUPPLE_GROUP_PATCHES;
    SuppleGroup group{};
    EXPECT_EQ(suppleCreateGroup(context.handle(), &desc, &group), SUPPLE_ERROR_ARGUMENT);
    desc.flags = SUPPLE_GROUP_INDEXED_MESH; // which it has in any case
    ASSERT_EQ(suppleCreateGroup(context.handle(), &desc, &group), SUPPLE_OK);
    EXPECT_EQ(suppleSetRate(context.handle(), group, 8), SUPPLE_OK);
    EXPECT_EQ(suppleSetRate(context.handle(), group, 4), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleDestroyGroup(context.handle(), group), SUPPLE_OK);
    cage::Cage gone = cube();
    gone.holes = {0, 1, 2, 3, 4, 5};
    desc.asset = context.createAsset(gone);
    EXPECT_EQ(suppleCreateGroup(context.handle(), &desc, &group), SUPPLE_ERROR_ASSET);
}

// ------------------------------------------------------------------------------------------------- views

TEST_F(WrittenCages, InAViewItIsDrawnAsItIs) {
    const ValidationGuard guard;
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        const std::string pip = std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb";
        TestView view(own, 100000, SUPPLE_VIEW_CULL | SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES);
        const glm::mat4 seen = glm::perspectiveRH_ZO(0.9f, 1.0f, 0.5f, 1000.0f) *
                               glm::lookAt(glm::vec3(0.0f, 1.0f, 10.0f), glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
        std::memcpy(view.camera.viewProjection, &seen, sizeof(seen));
        view.look({0.0f, 1.0f, 10.0f});
        SuppleGroupDesc desc{};
        desc.asset = own.asset(pip);
        desc.capacity = 3;
        desc.scheme = SUPPLE_SCHEME_POLYGONS;
        desc.vertexFormat = SUPPLE_VERTEX_24;
        desc.flags = SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES;
        Crowd alone(own, desc);
        desc.view = view.handle();
        desc.flags = 0;
        Crowd viewed(own, desc);
        ASSERT_TRUE(alone.valid() && viewed.valid());
        EXPECT_EQ(viewed.output().surface.tessellation, SUPPLE_TESSELLATION_RATES);
        EXPECT_EQ(viewed.output().grid.rateCount, 1u);
        EXPECT_EQ(viewed.output().grid.vertexCount, alone.output().grid.vertexCount);
        std::vector<SuppleInstance> a, v;
        for (uint32_t i = 0; i < 3; ++i) {
            a.push_back(alone.spawn());
            v.push_back(viewed.spawn());
        }
        for (uint32_t frame = 0; frame < 3; ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            for (uint32_t i = 0; i < 3; ++i) {
                // The last one stands behind the camera in frame 1.
                const glm::mat4 place = glm::translate(
                    glm::mat4(1.0f), {1.5f * static_cast<float>(i) - 1.5f, 0.0f, i == 2 && frame == 1 ? 50.0f : 0.0f});
                alone.pose(a[i], 0, 0.2 + 0.1 * frame + 0.2 * i, place);
                viewed.pose(v[i], 0, 0.2 + 0.1 * frame + 0.2 * i, place);
            }
            alone.run();
            viewed.run();
            EXPECT_TRUE(indicesOf(viewed.output()) == indicesOf(alone.output()));
            const uint32_t shown = frame == 1 ? 2 : 3;
            const std::vector<VkDrawIndexedIndirectCommand> draws = viewed.draws();
            ASSERT_EQ(draws.size(), alone.draws().size());
            for (size_t d = 0; d < draws.size(); ++d) {
                EXPECT_EQ(draws[d].instanceCount, shown);
                EXPECT_EQ(draws[d].indexCount, alone.draws()[d].indexCount);
                EXPECT_EQ(draws[d].firstIndex, alone.draws()[d].firstIndex);
            }
            for (uint32_t slot = 0; slot < shown; ++slot) {
                EXPECT_EQ(differences(viewed.positions(slot), alone.positions(slot)), 0u);
                const bool isNew = frame == 0 || (slot == 2 && frame == 2);
                EXPECT_EQ(differences(viewed.previous(slot), isNew ? alone.positions(slot) : alone.previous(slot)), 0u)
                    << "slot " << slot;
                const auto vertices = [&](const Crowd& crowd) {
                    std::vector<std::byte> bytes = crowd.slotBytes(crowd.output().streams.vertices, slot);
                    bytes.resize(size_t{24} * crowd.output().grid.vertexCount); // without padding
                    return bytes;
                };
                EXPECT_TRUE(vertices(viewed) == vertices(alone)) << "normals";
            }
            EXPECT_TRUE(viewed.read(viewed.output().streams.attributes) ==
                        alone.read(alone.output().streams.attributes));
        }
    }
}

} // namespace
} // namespace supple::test
