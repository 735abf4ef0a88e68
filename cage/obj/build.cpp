#include "cage/obj/build.h"

#include "cage/obj/text.h"
#include "cage/part_amount.h"
#include "cage/weld.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace supple::cage::obj {
namespace {

using Edge = std::pair<uint32_t, uint32_t>; ///< its ends, the lower first

/// The faces of a part.
struct Share {
    std::string name;
    std::string element;
    std::vector<uint32_t> faces; ///< rising
};

/// What a file says of its edges and vertices, by the file's numbers; of several on one the sharpest counts.
class Tags {
public:
    explicit Tags(const File& file) : file_(file), found_(file.creases.size(), 0) {
        for (size_t i = 0; i < file.creases.size(); ++i) {
            const TaggedCrease& tag = file.creases[i];
            creases_[std::minmax(static_cast<uint32_t>(tag.a), static_cast<uint32_t>(tag.b))].push_back(i);
        }
        for (const TaggedCorner& tag : file.sharpVertices) {
            float& sharpness = sharpVertices_[static_cast<uint32_t>(tag.vertex)];
            sharpness = std::max(sharpness, tag.sharpness);
        }
        holes_.assign(file.holes.empty() ? 0 : file.faceCount(), 0);
        for (const TaggedHole& tag : file.holes) {
            holes_[static_cast<size_t>(tag.face)] = 1;
        }
    }

    /// Lays them on a part. `vertices`: the file's numbers of corners, in the cage's order.
    void lay(const Share& share, std::span<const uint32_t> vertices, Cage& cage) {
        std::map<Edge, float> creases;
        for (uint32_t f = 0; f < cage.faceCount() && !creases_.empty(); ++f) {
            for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
                const uint32_t next = c + 1 < cage.faceStarts[f + 1] ? c + 1 : cage.faceStarts[f];
                const auto tags = creases_.find(std::minmax(vertices[c], vertices[next]));
                if (tags == creases_.end()) {
                    continue;
                }
                float& sharpness = creases[std::minmax(cage.faceVertices[c], cage.faceVertices[next])];
                for (const size_t tag : tags->second) {
                    found_[tag] = 1;
                    sharpness = std::max(sharpness, file_.creases[tag].sharpness);
                }
            }
        }
        std::map<uint32_t, float> sharpVertices;
        for (uint32_t c = 0; c < cage.cornerCount() && !sharpVertices_.empty(); ++c) {
            if (const auto tag = sharpVertices_.find(vertices[c]); tag != sharpVertices_.end()) {
                float& sharpness = sharpVertices[cage.faceVertices[c]];
                sharpness = std::max(sharpness, tag->second);
            }
        }
        for (const auto& [edge, sharpness] : creases) {
            if (sharpness > 0.0f) {
                cage.creases.push_back({edge.first, edge.second, sharpness});
            }
        }
        for (const auto& [vertex, sharpness] : sharpVertices) {
            if (sharpness > 0.0f) {
                cage.sharpVertices.push_back({vertex, sharpness});
            }
        }
        for (uint32_t f = 0; f < share.faces.size() && !holes_.empty(); ++f) {
            if (holes_[share.faces[f]] != 0) {
                cage.holes.push_back(f);
            }
        }
    }

    void reportStrays(Warnings& warnings) const {
        const auto strays = static_cast<size_t>(std::count(found_.begin(), found_.end(), uint8_t{0}));
        if (strays > 0) {
            const auto first = static_cast<size_t>(std::find(found_.begin(), found_.end(), 0) - found_.begin());
            warn(warnings, lineName(file_.creases[first].line),
                 counted(strays, "crease is not an edge", "creases are not edges, this being the first") +
                     "; left out");
        }
    }

private:
    const File& file_;
    std::map<Edge, std::vector<size_t>> creases_; ///< places in the file's list
    std::vector<uint8_t> found_;                  ///< per crease: 1 if it is an edge
    std::unordered_map<uint32_t, float> sharpVertices_;
    std::vector<uint8_t> holes_; ///< per face of the file, or empty
};

/// How many vertices were welded, in all parts.
struct WeldCounts {
    size_t vertices = 0;
    size_t places = 0;
    size_t apart = 0; ///< places that were taken apart again
};

/// Numbers the places in which the vertices lie.
std::vector<uint32_t> placesOf(std::span<const glm::vec3> positions) {
    std::vector<uint32_t> order(positions.size());
    for (uint32_t v = 0; v < order.size(); ++v) {
        order[v] = v;
    }
    const auto key = [&](uint32_t v) { return std::tuple(positions[v].x, positions[v].y, positions[v].z); };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    std::vector<uint32_t> places(positions.size(), 0);
    uint32_t place = 0;
    for (size_t i = 1; i < order.size(); ++i) {
        place += key(order[i - 1]) == key(order[i]) ? 0 : 1;
        places[order[i]] = place;
    }
    return places;
}

/// Makes vertices of a cage that lie in one place one, the first of them. Nothing else of the cage knows of vertices
/// yet. Returns how many went.
uint32_t weldCage(Cage& cage, WeldCounts& counts) {
    const std::vector<uint32_t> places = placesOf(cage.positions);
    if (places.empty() || *std::max_element(places.begin(), places.end()) + 1 == places.size()) {
        return 0;
    }
    Polygons faces;
    faces.starts = cage.faceStarts;
    faces.vertices = cage.faceVertices;
    Welding welding = weld(places, faces, [&](uint32_t face, uint32_t other) {
        return !lieBackToBack(cage.positions, faces, face, other);
    });
    counts.apart += unweldDefects(faces, welding);
    std::vector<uint32_t> sizes(places.size(), 0), vertices(places.size(), kNone);
    uint32_t kept = 0;
    for (uint32_t v = 0; v < places.size(); ++v) {
        ++sizes[welding.roots[v]];
        if (welding.roots[v] == v) {
            cage.positions[kept] = cage.positions[v];
            cage.sourceVertices[kept] = cage.sourceVertices[v];
            vertices[v] = kept++;
        }
    }
    const uint32_t gone = cage.vertexCount() - kept;
    cage.positions.resize(kept);
    cage.sourceVertices.resize(kept);
    for (uint32_t& v : cage.faceVertices) {
        v = vertices[welding.roots[v]];
    }
    for (const uint32_t size : sizes) {
        counts.vertices += size > 1 ? size : 0;
        counts.places += size > 1 ? 1 : 0;
    }
    return gone;
}

class Builder {
public:
    Builder(const File& file, const BuildOptions& options)
        : file_(file), options_(options), tags_(file), vertices_(file.positions.size(), kNone),
          used_(file.positions.size(), 0), hasColors_(hasColors(file)) {
        hasUvs_ = std::any_of(file.corners.begin(), file.corners.end(), [](const Corner& c) { return c.uv != kNone; });
        hasNormals_ =
            std::any_of(file.corners.begin(), file.corners.end(), [](const Corner& c) { return c.normal != kNone; });
    }

    PartCage build(Share&& share, bool isAlone) {
        PartCage part;
        part.element = std::move(share.element);
        part.part.name = std::move(share.name);
        part.part.polygonSource = PolygonSource::obj;
        Cage& cage = part.cage;
        const std::vector<uint32_t> corners = addFaces(share, cage);
        addVertices(corners, cage);
        part.seamVertexCount = options_.weld ? weldCage(cage, counts_) : 0;
        part.part.weldSource = part.seamVertexCount > 0 ? WeldSource::equality : WeldSource::given;
        part.namesBySource = !isAlone || part.seamVertexCount > 0;
        tags_.lay(share, corners, cage);
        return part;
    }

    void report(Warnings& warnings) const {
        tags_.reportStrays(warnings);
        const auto unused = static_cast<size_t>(std::count(used_.begin(), used_.end(), uint8_t{0}));
        if (unused > 0) {
            warn(warnings, "file", counted(unused, "vertex has", "vertices have") + " no face; left out");
        }
        if (counts_.vertices > 0) {
            warn(warnings, "file",
                 std::to_string(counts_.vertices) + " vertices lie in " + counted(counts_.places, "place", "places") +
                     "; welded");
        }
        if (counts_.apart > 0) {
            warn(warnings, "file",
                 counted(counts_.apart, "welded vertex is", "welded vertices are") +
                     " taken apart again: faces do not fit together there");
        }
        size_t uncolored = 0;
        for (size_t v = 0; v < used_.size() && hasColors_; ++v) {
            uncolored += used_[v] != 0 && file_.colors[v] == kNoColor ? 1 : 0;
        }
        if (uncolored > 0) {
            const bool tinted = std::any_of(options_.colors.begin(), options_.colors.end(),
                                            [](const glm::vec3& color) { return color != glm::vec3(1.0f); });
            warn(warnings, "file",
                 counted(uncolored, "vertex has", "vertices have") + " no color; " +
                     (tinted ? "as their material" : "white"));
        }
    }

private:
    /// Returns the file's vertex of each corner.
    std::vector<uint32_t> addFaces(const Share& share, Cage& cage) const {
        std::vector<uint32_t> corners;
        cage.faceStarts = {0};
        for (const uint32_t f : share.faces) {
            for (uint32_t c = file_.faceStarts[f]; c < file_.faceStarts[f + 1]; ++c) {
                const Corner& corner = file_.corners[c];
                corners.push_back(corner.vertex);
                if (hasUvs_) {
                    cage.cornerUvs.push_back(corner.uv == kNone ? glm::vec2(0.0f) : file_.uvs[corner.uv]);
                }
                if (hasNormals_) {
                    cage.cornerNormals.push_back(corner.normal == kNone ? glm::vec3(0.0f)
                                                                        : file_.normals[corner.normal]);
                }
                if (hasColors_) {
                    cage.cornerColors.emplace_back(colorOf(corner.vertex, file_.faceMaterials[f]), 1.0f);
                }
            }
            cage.faceStarts.push_back(static_cast<uint32_t>(corners.size()));
            cage.faceMaterials.push_back(file_.faceMaterials[f]);
        }
        return corners;
    }

    [[nodiscard]] glm::vec3 colorOf(uint32_t vertex, uint32_t material) const {
        if (file_.colors[vertex] != kNoColor) {
            return file_.colors[vertex];
        }
        return material < options_.colors.size() ? options_.colors[material] : glm::vec3(1.0f);
    }

    /// In the file's order.
    void addVertices(std::span<const uint32_t> corners, Cage& cage) {
        std::vector<uint32_t>& sources = cage.sourceVertices;
        for (const uint32_t v : corners) {
            if (vertices_[v] == kNone) {
                vertices_[v] = 0;
                used_[v] = 1;
                sources.push_back(v);
            }
        }
        std::sort(sources.begin(), sources.end());
        for (uint32_t place = 0; place < sources.size(); ++place) {
            vertices_[sources[place]] = place;
            cage.positions.push_back(file_.positions[sources[place]]);
        }
        for (const uint32_t v : corners) {
            cage.faceVertices.push_back(vertices_[v]);
        }
        for (const uint32_t v : sources) {
            vertices_[v] = kNone; // for the next part
        }
    }

    const File& file_;
    BuildOptions options_;
    Tags tags_;
    std::vector<uint32_t> vertices_; ///< per vertex of the file: its place in the part that is being built, or kNone
    std::vector<uint8_t> used_;      ///< per vertex of the file: 1 if a part has it
    WeldCounts counts_;
    bool hasUvs_ = false;
    bool hasNormals_ = false;
    bool hasColors_ = false;
};

/// Shares the whole faces out, by `selected`, which has a place in `names` or kNone for each. What has no name is one
/// part.
std::vector<Share> shareOut(const File& file, const std::vector<uint32_t>& selected,
                            const std::vector<std::string>& names, const std::string& kind) {
    std::vector<Share> shares;
    std::vector<uint32_t> ofName(names.size() + 1, kNone); // the last: no name
    for (uint32_t f = 0; f < file.faceCount(); ++f) {
        if (file.faceIsWhole[f] == 0) {
            continue;
        }
        const bool isNamed = selected[f] != kNone && !names[selected[f]].empty();
        uint32_t& share = ofName[isNamed ? selected[f] : names.size()];
        if (share == kNone) {
            share = static_cast<uint32_t>(shares.size());
            Share& made = shares.emplace_back();
            made.name = isNamed ? names[selected[f]] : "";
            made.element = isNamed ? kind + " " + shortened(made.name) : "faces without " + kind;
        }
        shares[share].faces.push_back(f);
    }
    return shares;
}

std::vector<Share> sharesOf(const File& file, Warnings& warnings) {
    bool hasObjects = false;
    for (size_t f = 0; f < file.faceCount() && !hasObjects; ++f) {
        const uint32_t object = file.faceObjects[f];
        hasObjects = file.faceIsWhole[f] != 0 && object != kNone && !file.objects[object].empty();
    }
    std::vector<Share> shares = hasObjects ? shareOut(file, file.faceObjects, file.objects, "object")
                                           : shareOut(file, file.faceGroups, file.groups, "group");
    if (shares.size() > kMaxParts) {
        warn(warnings, "file",
             std::to_string(shares.size()) + (hasObjects ? " objects" : " groups") + " are more than " +
                 std::to_string(kMaxParts) + " parts; read as one");
        shares = shareOut(file, std::vector<uint32_t>(file.faceCount(), kNone), {}, "file");
    }
    if (shares.size() == 1) {
        shares[0].element = "file";
    }
    return shares;
}

} // namespace

bool hasColors(const File& file) {
    for (size_t f = 0; f < file.faceCount() && !file.colors.empty(); ++f) {
        for (uint32_t c = file.faceStarts[f]; c < file.faceStarts[f + 1] && file.faceIsWhole[f] != 0; ++c) {
            if (file.colors[file.corners[c].vertex] != kNoColor) {
                return true;
            }
        }
    }
    return false;
}

std::vector<PartCage> buildParts(const File& file, const BuildOptions& options, Warnings& warnings) {
    std::vector<Share> shares = sharesOf(file, warnings);
    std::vector<PartCage> parts;
    Builder builder(file, options);
    PartAmount amount;
    for (Share& share : shares) {
        parts.push_back(builder.build(std::move(share), shares.size() == 1));
        amount.add(parts.back(), parts.back().element);
    }
    builder.report(warnings);
    if (!parts.empty()) {
        parts.back().sourceVertexCount = static_cast<uint32_t>(file.positions.size());
    }
    return parts;
}

} // namespace supple::cage::obj
