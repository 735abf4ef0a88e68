// A character for drawing: Supple's asset, its clips and materials, the tables that draw its cage; and a group made of
// it.
#pragma once

#include "host/cage_mesh.h"
#include "host/camera.h"
#include "host/context.h"
#include "host/figure_materials.h"
#include "host/group_output.h"
#include "host/level_view.h"
#include "host/shaders/draw.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::host {

class Figure {
public:
    /// A run of cage triangles of one part and material.
    struct CageRange {
        uint32_t firstCorner = 0; ///< three corners a triangle
        uint32_t cornerCount = 0;
        uint32_t material = SUPPLE_NO_MATERIAL;
        uint32_t part = 0;
        glm::vec3 center{0.0f}; ///< mean of its corners in the bind pose
    };
    /// A run of cage edges of one part. What two parts have in common belongs to the first of them.
    struct EdgeRange {
        uint32_t firstEdge = 0;
        uint32_t edgeCount = 0;
        uint32_t part = 0;
    };
    struct Clip {
        std::string name;
        double duration = 0.0; ///< seconds
    };
    struct MorphTarget {
        std::string name;    ///< empty if the file has none; of several parts, several may have it
        float weight = 0.0f; ///< the file's
    };

    /// Takes the asset, also where it fails; `cage` is its cage. `path` begins the messages. The context must outlive
    /// the figure.
    [[nodiscard]] static Result<std::unique_ptr<Figure>> create(Context& context, SuppleAsset asset, CageMesh cage,
                                                                const std::string& path);
    ~Figure();
    Figure(const Figure&) = delete;
    Figure& operator=(const Figure&) = delete;

    [[nodiscard]] Context& context() const { return context_; }
    [[nodiscard]] SuppleAsset asset() const { return asset_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const CageMesh& cage() const { return cage_; }
    [[nodiscard]] const std::vector<Clip>& clips() const { return clips_; }
    [[nodiscard]] const std::vector<MorphTarget>& morphTargets() const { return morphTargets_; }
    /// The names of the expressions that a VRM file has.
    [[nodiscard]] const std::vector<std::string>& expressions() const { return expressions_; }
    /// What expressions make of the weights of all morph targets. `weights`: one per expression.
    [[nodiscard]] Result<std::vector<float>> expressionWeights(const std::vector<float>& weights) const;
    /// 0 for the bind pose.
    [[nodiscard]] double clipDuration(uint32_t clip) const;
    /// Of every part, in the asset's order; names may be empty.
    [[nodiscard]] const std::vector<std::string>& partNames() const { return partNames_; }
    [[nodiscard]] const std::vector<SupplePartInfo>& parts() const { return parts_; }
    [[nodiscard]] const FigureMaterials& materials() const { return materials_; }
    /// In the order of the file's skin.
    [[nodiscard]] const std::vector<std::string>& jointNames() const { return jointNames_; }
    /// The joint above each, or SUPPLE_NO_JOINT.
    [[nodiscard]] const std::vector<uint32_t>& jointParents() const { return jointParents_; }

    /// Luminance of the base color over the cage's faces: linear, 0..1.
    [[nodiscard]] float averageAlbedo() const { return averageAlbedo_; }
    [[nodiscard]] const std::vector<CageRange>& cageRanges() const { return cageRanges_; }
    /// CageRange::center of the faces of a part and material.
    [[nodiscard]] glm::vec3 centerOf(uint32_t part, uint32_t material) const;
    [[nodiscard]] const Buffer& cageCorners() const { return cageCorners_; }
    /// Where a face's vertices begin in cageCorners(), in words.
    [[nodiscard]] uint32_t cageFaceStart(uint32_t face) const { return cageFaceLists_ + cage_.faceStarts[face]; }
    [[nodiscard]] const Buffer& cageEdges() const { return cageEdges_; }
    [[nodiscard]] const std::vector<EdgeRange>& cageEdgeRanges() const { return cageEdgeRanges_; }

private:
    explicit Figure(Context& context) : context_(context) {}
    /// What shaders/cage_edge.vert reads; fills cageEdgeRanges_.
    [[nodiscard]] std::vector<std::array<uint32_t, 2>> cageEdgeVertices();
    /// What shaders/cage_buffers.glsl reads; fills cageRanges_ and cageFaceLists_.
    [[nodiscard]] std::vector<uint32_t> cageCornerWords();
    [[nodiscard]] Status uploadCage();
    /// Clips, morph targets, parts and joints.
    [[nodiscard]] Status readLists();
    /// Over the cage's faces by their rest area.
    [[nodiscard]] float averageLuminance() const;

    Context& context_;
    std::string path_;
    CageMesh cage_;
    SuppleAsset asset_{};
    std::vector<Clip> clips_;
    std::vector<MorphTarget> morphTargets_;
    std::vector<std::string> expressions_;
    std::vector<std::string> jointNames_;
    std::vector<uint32_t> jointParents_;
    std::vector<std::string> partNames_;
    std::vector<SupplePartInfo> parts_;
    FigureMaterials materials_;
    std::vector<CageRange> cageRanges_;
    Buffer cageCorners_;
    uint32_t cageFaceLists_ = 0;
    Buffer cageEdges_;
    std::vector<EdgeRange> cageEdgeRanges_;
    float averageAlbedo_ = 0.5f;
};

struct GroupOptions {
    uint32_t instances = 1;
    SuppleScheme scheme = SUPPLE_SCHEME_AUTO;
    uint32_t rate = 8;
    SuppleVertexFormat vertexFormat = SUPPLE_VERTEX_16;
    SuppleSkinning skinning = SUPPLE_SKINNING_LINEAR;
    SuppleCreaseMode creaseMode = SUPPLE_CREASES_CUT;
    float sharpThreshold = 1.0f;
    SuppleFragmentRules fragmentRules = SUPPLE_RULES_CATMULL_CLARK;
    SuppleUvInterpolation uvInterpolation = SUPPLE_UV_FROM_FILE;
    bool sharedSamples = false;            ///< SUPPLE_GROUP_INDEXED_MESH
    std::vector<SuppleScheme> partSchemes; ///< of the first parts, instead of `scheme`
    bool levels = false;                   ///< of detail, as the camera of setLevelCamera() chooses them
    bool plays = false;                    ///< on the device, with transitions, instead of pose()
    bool springs = false;                  ///< if it plays: joints swing, vertices jiggle
    bool traced = false;                   ///< SUPPLE_GROUP_RAY_TRACING; not with levels
};

/// A draw command of a surface.
struct SurfaceDraw {
    shared::DrawPush push{}; ///< what shaders have to know of it
    uint32_t material = SUPPLE_NO_MATERIAL;
    uint32_t part = 0;
};
/// SurfaceDraw::part of draws of several parts: the device leaves out those that are hidden.
inline constexpr uint32_t kManyParts = 0xFFFFFFFFu;

/// A surface of a group with what drawing it needs besides Supple's buffers. If instances have one of several rates, a
/// surface at one of them.
struct FigureSurface {
    GroupOutput output{};
    std::vector<SurfaceDraw> draws; ///< one for each command of the output's indirect buffer
    /// Segments along an edge of the cage: the rate asked for, which subdivision rounds up to a power of two and has
    /// more than one patch to (SuppleGridOutput::rate counts along a patch).
    uint32_t edgeRate = 0;
    Buffer patches;            ///< shared::kPatchWords per patch
    uint32_t patchClasses = 0; ///< a bit for each SupplePatchClass that it has
    /// Coarser grids over the same samples, by SuppleDomain: shadows need no more.
    struct CoarseGrid {
        uint32_t firstIndex = 0, indexCount = 0;
    };
    std::array<CoarseGrid, 4> coarseGrids;
    uint32_t coarseEdgeRate = 0; ///< edgeRate of these
    Buffer coarseIndices;
    Buffer
        values; ///< a float per vertex of an instance, for the views from kViewWeights on but kViewLevels; may be none

    /// SUPPLE_SCHEME_POLYGONS.
    [[nodiscard]] bool isMesh() const { return output.surface.scheme == SUPPLE_SCHEME_POLYGONS; }
};

/// A Supple group with what drawing it needs besides Supple's buffers. May be destroyed only when no pending frame uses
/// it.
class FigureGroup {
public:
    [[nodiscard]] static Result<std::unique_ptr<FigureGroup>> create(Figure& figure, const GroupOptions& options);
    ~FigureGroup();
    FigureGroup(const FigureGroup&) = delete;
    FigureGroup& operator=(const FigureGroup&) = delete;

    [[nodiscard]] Figure& figure() const { return figure_; }
    [[nodiscard]] SuppleGroup handle() const { return group_; }
    /// All of them are there; an instance's number is its slot.
    [[nodiscard]] SuppleInstance instance(uint32_t index) const { return instances_[index]; }
    /// One or more.
    [[nodiscard]] const std::vector<FigureSurface>& surfaces() const { return surfaces_; }
    [[nodiscard]] bool hasLevels() const { return levels_ != nullptr; }
    /// GroupOptions::plays.
    [[nodiscard]] bool plays() const { return plays_; }
    /// GroupOptions::springs.
    [[nodiscard]] bool swings() const { return swings_; }
    /// Groups with levels, before they are recorded: levels are chosen for a picture of this height from this camera,
    /// so that edges lie within `chordError` pixels of their curves.
    [[nodiscard]] Status setLevelCamera(const Camera& camera, uint32_t height, float chordError);
    /// What was drawn last; only groups with levels know it.
    [[nodiscard]] std::optional<SuppleViewStatistics> levelStatistics() const;
    /// The most segments that a surface has along an edge of the cage.
    [[nodiscard]] uint32_t edgeRate() const;
    /// The scheme of the surface that has the part.
    [[nodiscard]] SuppleScheme schemeOfPart(uint32_t part) const;
    [[nodiscard]] bool isMeshPart(uint32_t part) const { return schemeOfPart(part) == SUPPLE_SCHEME_POLYGONS; }

    /// Destroys Supple's group at once; its memory goes when the frames that used it are completed. The tables stay.
    void release();

    [[nodiscard]] Status pose(uint32_t instance, uint32_t clip, double time);
    /// A weight a target of the figure, instead of those of all poses; none: those of the poses.
    [[nodiscard]] Status setMorphWeights(uint32_t instance, std::span<const float> weights);
    /// From the next frame that is recorded.
    [[nodiscard]] Status setVisible(uint32_t instance, bool visible);
    [[nodiscard]] uint32_t visibleCount() const;
    /// Of all instances, from the next frame that is recorded.
    [[nodiscard]] Status setPartVisible(uint32_t part, bool visible);
    [[nodiscard]] bool isPartVisible(uint32_t part) const { return part == kManyParts || visibleParts_[part]; }
    /// Positions of the vertices of all surfaces (which have no levels), or of the deformed cage, as last evaluated,
    /// surface after surface and instance after instance; waits for the device.
    [[nodiscard]] Result<std::vector<glm::vec3>> readSurface() const;
    [[nodiscard]] Result<std::vector<glm::vec3>> readCage() const;
    /// Per joint of the first instance, what takes the bind pose to where it was posed last, with what swings; waits
    /// for the device.
    [[nodiscard]] Result<std::vector<glm::mat4>> readPalette() const;
    /// How much a joint moves each vertex of the surfaces, 0 to 1, as FigureSurface::values: the device evaluates the
    /// bind pose with the joint moved aside, and that is measured. Of a group of one instance whose poses are set;
    /// poses and frames are to be set anew. No frame may be pending.
    [[nodiscard]] Status showWeights(uint32_t joint);
    /// FigureSurface::values of all vertices in the order of readSurface(), for groups of one instance. No frame may be
    /// pending; bindings are to be made anew.
    [[nodiscard]] Status setValues(std::span<const float> values);
    /// The largest of those that were set; 0 without any.
    [[nodiscard]] float largestValue() const { return largestValue_; }

private:
    explicit FigureGroup(Figure& figure) : figure_(figure) {}
    [[nodiscard]] Status readSurfaces();
    /// Adds a surface of the group, or one for each of its rates.
    [[nodiscard]] Status addSurface(const GroupOutput& output, uint32_t index);
    [[nodiscard]] Status uploadTables(FigureSurface& surface, uint32_t index) const;
    [[nodiscard]] Status uploadCoarseGrids(FigureSurface& surface) const;

    Figure& figure_;
    std::unique_ptr<LevelView> levels_;
    SuppleGroup group_{};
    std::vector<SuppleInstance> instances_;
    bool plays_ = false;
    bool swings_ = false;
    std::vector<bool> visible_; ///< per instance
    std::vector<bool> visibleParts_;
    std::vector<FigureSurface> surfaces_;
    float largestValue_ = 0.0f;
};

} // namespace supple::host
